"""Lets, forces and set-valued terms, elaborated in an order in which shapes are known."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields, replace

from nsode.diagnostics import ModelError, refuse
from nsode.expr import Expr, Name, Number
from nsode.inclusion.elaborate import elaborate
from nsode.inclusion.fitting import declared_shape, fitted
from nsode.inclusion.functions_of_time import FunctionsOfTime
from nsode.inclusion.hoist import Hoister, RawTerm
from nsode.inclusion.indices import index_range
from nsode.inclusion.kinds import number
from nsode.inclusion.order import loop, order
from nsode.inclusion.report import Report, in_a_circle
from nsode.inclusion.review import Review
from nsode.inclusion.symbols import Kind, Scope, Symbol, Symbols
from nsode.inclusion.units import in_si
from nsode.inclusion.values import (
    Value,
    describe,
    each,
    scalars,
    shape,
    suffixes,
)
from nsode.ode import Binding, Role, SetValuedTerm
from nsode.syntax import ast
from nsode.syntax.ast import Declarator, Unit


@dataclass(frozen=True, slots=True)
class _Pending:
    """A let or force whose set-valued terms have been taken out."""

    declarator: Declarator
    value: Expr
    unit: Unit | None
    kind: Kind


@dataclass(slots=True)
class Definitions:
    """What lets, forces and terms stand for."""

    symbols: Symbols
    review: Review
    report: Report
    hoister: Hoister = field(init=False)
    in_time: FunctionsOfTime = field(init=False)
    bindings: dict[str, Binding] = field(default_factory=dict)
    terms: list[SetValuedTerm] = field(default_factory=list)
    inline: set[str] = field(default_factory=set)
    forces: list[str] = field(default_factory=list)
    _pending: dict[str, _Pending] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.hoister = Hoister(self.report.source)
        self.in_time = FunctionsOfTime(self.symbols, self.review, self.bindings)

    @property
    def scope(self) -> Scope:
        """Where expressions of the model stand."""
        return Scope(self.symbols, derivative=self.in_time.der)

    def let(self, declaration: ast.LetDeclaration) -> None:
        """Take in ``let``, with its inline terms hoisted."""
        declarator = declaration.declarator
        value = self.hoister.hoist(declaration.value, declarator.range)
        self._pending[declarator.name.text] = _Pending(declarator, value, declaration.unit, "let")

    def force(self, declaration: ast.ForceDeclaration) -> None:
        """Take in ``force``: its outermost term gets its name."""
        declarator = declaration.declarator
        name = declarator.name
        rest = self.hoister.hoist_force(declaration)
        self.forces.append(name.text)
        if rest is not None:
            self._pending[name.text] = _Pending(declarator, rest, declaration.unit, "force")

    def hoisted(self, output: ast.OutputDeclaration) -> ast.OutputDeclaration:
        """Return an output with its inline terms hoisted."""
        value = self.hoister.hoist(output.value, output.declarator.range)
        return replace(output, value=value)

    def elaborate(self) -> None:
        """Elaborate everything, each behind what it reads; loops are reported."""
        raw = {term.multiplier: term for term in self.hoister.terms}
        for name, term in raw.items():
            self.symbols.declared.setdefault(name, term.span)
        keys = sorted({*self._pending, *raw}, key=lambda key: self._start(key, raw))
        reads = {key: list(self._reads(key, raw)) for key in keys}
        ordered = order(keys, reads)
        if len(ordered) < len(keys):
            with self.report.collecting():
                raise self._loop(loop(keys, reads), raw)
        for key in ordered:
            with self.report.collecting():
                if key in raw:
                    self._term(raw[key])
                else:
                    self._let(self._pending[key])

    def _start(self, key: str, raw: dict[str, RawTerm]) -> int:
        return raw[key].span.start if key in raw else self._pending[key].declarator.span.start

    def _reads(self, key: str, raw: dict[str, RawTerm]) -> Iterator[str]:
        if key not in raw:
            yield from written_names(self._pending[key].value)
            return
        yield from written_names(raw[key].argument)
        factor = raw[key].factor
        if factor is not None:
            yield from written_names(factor)

    def _loop(self, keys: list[str], raw: dict[str, RawTerm]) -> ModelError:
        named = [key for key in keys if "@" not in key]
        spans = {
            key: raw[key].span if key in raw else self._pending[key].declarator.name.span
            for key in keys
        }
        shown = [key.removesuffix(".lambda") for key in named] or ["sgn"]
        way_out = "solve the loop by hand, or make one of them a state"
        return in_a_circle(shown, spans, way_out)

    def _let(self, pending: _Pending) -> None:
        declarator, name = pending.declarator, pending.declarator.name
        over = index_range(declarator.range, self.scope)
        value = each(number, elaborate(pending.value, self.scope.with_index(over)))
        value = fitted(value, over, declared_shape(declarator, self.scope), declarator)
        value = each(lambda part: in_si(part, pending.unit), value)
        self.review.check(value)
        of = shape(value)
        unit = None if pending.unit is None else pending.unit.text
        self.symbols.define(Symbol(name.text, pending.kind, of, over, name.span, unit))
        role: Role = "force" if pending.kind == "force" else "let"
        for suffix, part in zip(suffixes(of), scalars(value), strict=True):
            whole = name.text + suffix
            self.bindings[whole] = Binding(whole, part, over, role, unit, span=name.span)

    def _term(self, raw: RawTerm) -> None:
        over = index_range(raw.range, self.scope)
        scope = self.scope.with_index(over)
        argument = each(number, elaborate(raw.argument, scope))
        self._check_argument(raw, argument)
        factor: Expr | None = None
        if raw.factor is not None:
            factor = self._factor(raw, elaborate(raw.factor, scope))
        self.review.check(argument)
        of = shape(argument)
        kind: Kind = "term" if raw.inline else "force"
        self.symbols.define(Symbol(raw.multiplier, kind, of, over, raw.span))
        if raw.name != raw.multiplier:
            self.symbols.declared.setdefault(raw.name, raw.span)
        if raw.inline:
            self.inline.add(raw.name)
        self.terms.append(
            SetValuedTerm(
                raw.name,
                raw.kind,
                scalars(argument),
                factor,
                tuple(raw.multiplier + suffix for suffix in suffixes(of)),
                over,
                written=raw.written,
                span=raw.span,
            )
        )

    def _check_argument(self, raw: RawTerm, argument: Value) -> None:
        of = shape(argument)
        if raw.kind == "dio" and of != ():
            raise refuse(
                "NS105", "`dio` takes a scalar gap", raw.argument.span, f"this is {describe(of)}"
            )
        if raw.kind == "sgn" and of not in {(), (2,), (3,)}:
            raise refuse(
                "NS105",
                "`sgn` takes a scalar or a vector of 2 or 3",
                raw.argument.span,
                f"this is {describe(of)}",
            )

    def _factor(self, raw: RawTerm, factor: Value) -> Expr:
        if not isinstance(factor, Expr):
            raise refuse(
                "NS206",
                f"the factor of `sgn` must be a scalar, not {describe(shape(factor))}",
                raw.span,
                "everything left of `sgn` in this product is its factor",
                help="name the term: `force F = mu*N*sgn(...)`, then multiply `F`",
            )
        self.review.check(factor)
        return number(factor, "the factor of `sgn`")


def written_names(expr: Expr) -> Iterator[str]:
    """Yield the names that an expression of the syntax tree reads."""
    stack: list[object] = [expr]
    while stack:
        node = stack.pop()
        match node:
            case Name(id):
                yield id
            case Number():
                pass
            case Expr() | ast.RangeSyntax():
                stack.extend(getattr(node, item.name) for item in fields(node))
            case tuple():
                stack.extend(node)
