"""Every ``dio(psi)`` and ``chi*sgn(theta)`` becomes a term of its own, with chi as written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Literal

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.expr import FUNCTIONS, Call, Expr, If, Name, rebuild
from nsode.inclusion.functions import ARITY, check_call, unknown_function
from nsode.inclusion.products import Friction, Item, flatten, fold, friction, is_sgn
from nsode.source import Source, Span
from nsode.syntax.ast import (
    Bracket,
    Component,
    ForceDeclaration,
    Group,
    Identifier,
    RangeSyntax,
    Reduction,
    Subscript,
)


@dataclass(frozen=True, slots=True)
class RawTerm:
    """A set-valued term as written; ``multiplier`` is the name that took its place.

    A named force that is nothing but its term is its own multiplier.
    """

    name: str
    kind: Literal["dio", "sgn"]
    argument: Expr
    factor: Expr | None
    multiplier: str
    range: RangeSyntax | None
    span: Span
    inline: bool
    written: tuple[Span, ...] = ()


@dataclass(slots=True)
class Hoister:
    """Takes set-valued terms out of expressions and keeps them in ``terms``."""

    source: Source
    terms: list[RawTerm] = field(default_factory=list)

    def hoist(self, expr: Expr, range: RangeSyntax | None) -> Expr:
        """Return ``expr`` with a name in the place of each set-valued term."""
        walk = _Walk(range)
        rest = walk.visit(expr)
        self.terms.extend(walk.terms)
        return rest

    def hoist_force(self, declaration: ForceDeclaration) -> Expr | None:
        """Take the one outermost term out of a named force; it gets the force's name.

        Returns
        -------
        The force in terms of its multiplier ``NAME.lambda``, or None where the force is
        nothing but its term.

        Raises
        ------
        ModelError
            NS205 unless there is exactly one outermost set-valued term.
        """
        walk = _Walk(declaration.declarator.range, declaration.declarator.name)
        rest = walk.visit(declaration.value)
        if not walk.named:
            raise self._no_term(declaration)
        [term] = walk.named
        bare = _bare(rest) == _place(term)
        self.terms.extend(walk.terms)
        self.terms.append(replace(term, multiplier=term.name) if bare else term)
        return None if bare else rest

    def _no_term(self, force: ForceDeclaration) -> ModelError:
        for call in _calls(force.value):
            if call.function not in ARITY and call.function not in FUNCTIONS:
                return unknown_function(call)
        text = self.source.on_one_line(Span(force.declarator.span.start, force.span.end))
        return refuse(
            "NS205",
            f"the force `{force.declarator.name.text}` holds no set-valued term",
            force.value.span,
            "neither `dio` nor `sgn` stands here",
            help=f"write `let {text}`",
        )


@dataclass(frozen=True, slots=True)
class _Walk:
    """The way through an expression: the terms found, and apart the outermost of a ``force``."""

    range: RangeSyntax | None
    force: Identifier | None = None
    terms: list[RawTerm] = field(default_factory=list)
    named: list[RawTerm] = field(default_factory=list)

    def visit(self, expr: Expr) -> Expr:
        """Return ``expr`` with a name in the place of each set-valued term."""
        match expr:
            case Call("dio", _):
                return self._take("dio", expr, None, expr.span)
            case Call("*" | "/", _):
                return self._product(expr)
            case _ if is_sgn(expr):
                return self._product(expr)
            case Call():
                return rebuild(expr, self.visit)
            case Group(inner):
                return replace(expr, inner=self.visit(inner))
            case Bracket(items):
                return replace(expr, items=tuple(self.visit(item) for item in items))
            case If(condition, then, otherwise):
                return replace(
                    expr,
                    condition=self.visit(condition),
                    then=self.visit(then),
                    otherwise=self.visit(otherwise),
                )
            case Subscript(base):
                return replace(expr, base=self.visit(base))
            case Component(base):
                return replace(expr, base=self.visit(base))
            case Reduction():
                return self._reduction(expr)
        return expr

    def _reduction(self, expr: Reduction) -> Expr:
        inside = _Walk(expr.range, self.force)
        body = inside.visit(expr.body)
        found = [*inside.terms, *inside.named]
        if self.range is not None and found:
            raise refuse(
                "NS105",
                "a set-valued term cannot have two indices",
                found[0].span,
                f"inside both `{self.range.variable.text}` and `{expr.range.variable.text}`",
                help="name it: `force N[i in 1..n] = ...`, then sum over `N[i]`",
            )
        self.terms.extend(inside.terms)
        for term in inside.named:
            self._name(term)
        return replace(expr, body=body)

    def _product(self, expr: Expr) -> Expr:
        items = flatten(expr)
        found = friction(items)
        if found is not None:
            return fold([Item("", self._sgn(found)), *self._visited(found.behind)])
        visited = self._visited(items)
        same = all(new.operand is old.operand for new, old in zip(visited, items, strict=True))
        return expr if same else fold(visited)

    def _visited(self, items: Sequence[Item]) -> list[Item]:
        return [Item(operator, self.visit(operand)) for operator, operand in items]

    def _sgn(self, found: Friction) -> Expr:
        place = self._take("sgn", found.sgn, found.chi, found.span, found.written)
        for part in found.taken:
            place = replace(part, base=place)
        return place if found.sign > 0 else Call("neg", (place,), span=found.span)

    def _take(
        self,
        kind: Literal["dio", "sgn"],
        call: Call,
        factor: Expr | None,
        span: Span,
        written: tuple[Span, ...] = (),
    ) -> Expr:
        """Keep a term; return what takes its place."""
        check_call(call)
        argument = call.args[0]
        inside = _Walk(self.range)
        inside.visit(argument)
        if inside.terms:
            raise _nested(kind, inside.terms[0])
        factor = None if factor is None else inside.visit(factor)
        self.terms.extend(inside.terms)
        name = multiplier = f"{kind}@{call.span.start}"
        if self.force is not None:
            name, multiplier = self.force.text, f"{self.force.text}.lambda"
        inline = self.force is None
        term = RawTerm(name, kind, argument, factor, multiplier, self.range, span, inline, written)
        self.terms.append(term) if inline else self._name(term)
        return _place(term)

    def _name(self, term: RawTerm) -> None:
        """Let a term have the name of the force."""
        if self.named:
            labels = (Label(term.span, "a second one"), Label(self.named[0].span, "the first"))
            message = f"the force `{term.name}` holds more than one set-valued term"
            way_out = "give each a `force` of its own and add them in a `let`"
            raise ModelError([Diagnostic("NS205", message, labels, help=way_out)])
        self.named.append(term)


def _nested(kind: str, inner: RawTerm) -> ModelError:
    return refuse(
        "NS204",
        f"`{inner.kind}` stands inside the argument of `{kind}`",
        inner.span,
        "the argument must be continuous",
        help="the gap or the sliding velocity is a function of the states alone",
    )


def _place(term: RawTerm) -> Expr:
    name = Name(term.multiplier, span=term.span)
    if term.range is None:
        return name
    variable = term.range.variable
    return Subscript(name, Name(variable.text, span=variable.span), span=term.span)


def _calls(expr: Expr) -> Iterator[Call]:
    stack: list[object] = [expr]
    while stack:
        node = stack.pop()
        if isinstance(node, tuple):
            stack.extend(node)
        elif isinstance(node, Expr):
            if isinstance(node, Call):
                yield node
            stack.extend(getattr(node, item.name) for item in fields(node))


def _bare(expr: Expr) -> Expr:
    while isinstance(expr, Group):
        expr = expr.inner
    return expr
