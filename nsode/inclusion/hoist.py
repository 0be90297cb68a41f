"""Every ``dio(psi)`` and ``chi*sgn(theta)`` becomes a term of its own, with chi as written.

chi is the innermost unbracketed product that holds sgn: everything to its left,
divisions included, and each ``*`` factor to its right up to the first ``/``. This is
read off the text, before anything is multiplied out, since ``F*sgn(v)/M`` and
``F/M*sgn(v)`` are one product in algebra and two friction laws in the paper.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from typing import Literal, NamedTuple

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.expr import FUNCTIONS, Call, Expr, If, Name, Number, rebuild
from nsode.inclusion.symbols import CALLABLE, unknown_function
from nsode.source import Span
from nsode.syntax.ast import (
    Bracket,
    Component,
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


class _Item(NamedTuple):
    operator: str
    operand: Expr


@dataclass(slots=True)
class Hoister:
    """Takes set-valued terms out of expressions and keeps them in ``terms``."""

    terms: list[RawTerm] = field(default_factory=list)
    _range: RangeSyntax | None = None
    _force: Identifier | None = None
    _outermost: list[int] = field(default_factory=list)
    _inside: int = 0

    def hoist(self, expr: Expr, range: RangeSyntax | None) -> Expr:
        """Return ``expr`` with a name in the place of each set-valued term."""
        self._range, self._force, self._inside = range, None, 0
        with self._all_or_none():
            return self._visit(expr)

    def hoist_force(self, name: Identifier, expr: Expr, range: RangeSyntax | None) -> Expr | None:
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
        self._range, self._force, self._inside = range, name, 0
        self._outermost = []
        with self._all_or_none():
            rest = self._visit(expr)
        if not self._outermost:
            for call in _calls(expr):
                if call.function not in CALLABLE and call.function not in FUNCTIONS:
                    raise unknown_function(call)
            raise refuse(
                "NS205",
                f"the force `{name.text}` holds no set-valued term",
                expr.span,
                "neither `dio` nor `sgn` stands here",
                help=f"write `let {name.text} = ...`",
            )
        at = self._outermost[0]
        term = self.terms[at]
        if _bare(rest) == self._place(term):
            self.terms[at] = replace(term, multiplier=name.text)
            return None
        return rest

    @contextmanager
    def _all_or_none(self) -> Iterator[None]:
        """Take no term out of an expression that is refused."""
        before = len(self.terms)
        try:
            yield
        except ModelError:
            del self.terms[before:]
            raise

    def _visit(self, expr: Expr) -> Expr:
        match expr:
            case Call("dio", _):
                return self._dio(expr)
            case Call("*" | "/", _):
                return self._product(expr)
            case _ if _sgn(expr) is not None:
                return self._product(expr)
            case Call():
                return rebuild(expr, self._visit)
            case Group(inner):
                return replace(expr, inner=self._visit(inner))
            case Bracket(items):
                return replace(expr, items=tuple(self._visit(item) for item in items))
            case If(condition, then, otherwise):
                return replace(
                    expr,
                    condition=self._visit(condition),
                    then=self._visit(then),
                    otherwise=self._visit(otherwise),
                )
            case Subscript(base):
                return replace(expr, base=self._visit(base))
            case Component(base):
                return replace(expr, base=self._visit(base))
            case Reduction():
                return self._reduction(expr)
        return expr

    def _reduction(self, expr: Reduction) -> Expr:
        outer, self._range = self._range, expr.range
        before = len(self.terms)
        body = self._visit(expr.body)
        self._range = outer
        if outer is not None and len(self.terms) > before:
            raise refuse(
                "NS105",
                "a set-valued term cannot have two indices",
                self.terms[before].span,
                f"inside both `{outer.variable.text}` and `{expr.range.variable.text}`",
                help="name it: `force N[i in 1..n] = ...`, then sum over `N[i]`",
            )
        return replace(expr, body=body)

    def _dio(self, expr: Call) -> Expr:
        return self._place(self._take("dio", expr, None, expr.span))

    def _product(self, expr: Expr) -> Expr:
        items = _flatten(expr)
        at = next(
            (k for k, item in enumerate(items) if item.operator != "/" and _sgn(item.operand)), None
        )
        if at is None:
            visited = [_Item(op, self._visit(operand)) for op, operand in items]
            changed = any(
                new.operand is not old.operand for new, old in zip(visited, items, strict=True)
            )
            return _fold(visited) if changed else expr
        found = _sgn(items[at].operand)
        assert found is not None
        call, wrappers, sign = found
        end = at + 1
        while end < len(items) and items[end].operator == "*":
            end += 1
        factors = items[:at] + items[at + 1 : end]
        span = items[0].operand.span.to(items[end - 1].operand.span)
        factor: Expr = Number(1.0, span=call.span)
        if factors:
            stripped = [_strip(item) for item in factors]
            sign *= _sign(stripped)
            factor = _fold([item for item, _ in stripped])
        place = self._place(self._take("sgn", call, factor, span))
        for wrapper in wrappers:
            place = replace(wrapper, base=place)
        if sign < 0:
            place = Call("neg", (place,), span=span)
        rest = [_Item(op, self._visit(operand)) for op, operand in items[end:]]
        return _fold([_Item("", place), *rest])

    def _take(
        self, kind: Literal["dio", "sgn"], call: Call, factor: Expr | None, span: Span
    ) -> RawTerm:
        if len(call.args) != 1:
            raise refuse(
                "NS110", f"`{kind}` takes one argument", call.span, f"here it has {len(call.args)}"
            )
        argument = call.args[0]
        with self._deeper():
            before = len(self.terms)
            self._visit(argument)
            if len(self.terms) > before:
                inner = self.terms[before]
                raise refuse(
                    "NS204",
                    f"`{inner.kind}` stands inside the argument of `{kind}`",
                    inner.span,
                    "the argument must be continuous",
                    help="the gap or the sliding velocity is a function of the states alone",
                )
            if factor is not None:
                factor = self._visit(factor)
        outermost = self._force is not None and self._inside == 0
        if outermost and self._outermost:
            raise self._second(span)
        name = multiplier = f"{kind}@{call.span.start}"
        if outermost and self._force is not None:
            name, multiplier = self._force.text, f"{self._force.text}.lambda"
        term = RawTerm(name, kind, argument, factor, multiplier, self._range, span, not outermost)
        self.terms.append(term)
        if outermost:
            self._outermost.append(len(self.terms) - 1)
        return term

    def _second(self, span: Span) -> ModelError:
        assert self._force is not None
        first = self.terms[self._outermost[0]]
        return ModelError(
            [
                Diagnostic(
                    "NS205",
                    f"the force `{self._force.text}` holds more than one set-valued term",
                    (Label(span, "a second one"), Label(first.span, "the first")),
                    help="give each a `force` of its own and add them in a `let`",
                )
            ]
        )

    @contextmanager
    def _deeper(self) -> Iterator[None]:
        self._inside += 1
        try:
            yield
        finally:
            self._inside -= 1

    def _place(self, term: RawTerm) -> Expr:
        name = Name(term.multiplier, span=term.span)
        if term.range is None:
            return name
        variable = term.range.variable
        return Subscript(name, Name(variable.text, span=variable.span), span=term.span)


def _flatten(expr: Expr) -> list[_Item]:
    """Return the factors of an unbracketed product from left to right."""
    items: list[_Item] = []
    while isinstance(expr, Call) and expr.function in {"*", "/"}:
        left, right = expr.args
        items.append(_Item(expr.function, right))
        expr = left
    items.append(_Item("", expr))
    return items[::-1]


def _fold(items: list[_Item]) -> Expr:
    result = items[0].operand
    for operator, operand in items[1:]:
        result = Call(operator, (result, operand), span=result.span.to(operand.span))
    return result


def _sgn(expr: Expr) -> tuple[Call, list[Component | Subscript], int] | None:
    """Return the sgn that a factor is, with the components taken of it and its sign."""
    wrappers: list[Component | Subscript] = []
    sign = 1
    while True:
        match expr:
            case Call("neg", (inner,)):
                sign = -sign
                expr = inner
            case Component(base) | Subscript(base):
                wrappers.append(expr)
                expr = base
            case Call("sgn", _):
                return expr, wrappers[::-1], sign
            case _:
                return None


def _strip(item: _Item) -> tuple[_Item, int]:
    """Return a factor without the signs in front of it, and what they amount to."""
    operand, sign = item.operand, 1
    while True:
        match operand:
            case Call("neg", (inner,)) | Group(Call("neg", (inner,))):
                operand, sign = inner, -sign
            case _:
                return _Item(item.operator, operand), sign


def _sign(stripped: list[tuple[_Item, int]]) -> int:
    sign = 1
    for _, one in stripped:
        sign *= one
    return sign


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
