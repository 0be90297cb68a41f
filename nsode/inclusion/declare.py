"""Declarations: parameters, constants, inputs and states become items of the system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from nsode.diagnostics import refuse
from nsode.evaluate import evaluate
from nsode.expr import Call, Expr, Index, IndexRange, Name, Number, names
from nsode.inclusion.definitions import written_names
from nsode.inclusion.elaborate import elaborate, number
from nsode.inclusion.families import choose
from nsode.inclusion.indices import check_size, index_range, integer
from nsode.inclusion.order import loop, order
from nsode.inclusion.report import Report, in_a_circle
from nsode.inclusion.review import Review
from nsode.inclusion.settings import constant
from nsode.inclusion.symbols import Kind, Scope, Symbol, Symbols
from nsode.inclusion.units import in_si
from nsode.inclusion.values import (
    Shape,
    Value,
    describe,
    each,
    from_scalars,
    scalars,
    shape,
    suffixes,
)
from nsode.ode import Check, Input, Parameter, State
from nsode.syntax.ast import (
    Bound,
    ConstantDeclaration,
    Declarator,
    InputDeclaration,
    ParameterDeclaration,
    StateDeclaration,
    Unit,
)


@dataclass(slots=True)
class Declarations:
    """The items that declarations make, in order."""

    symbols: Symbols
    review: Review
    parameters: list[Parameter] = field(default_factory=list)
    inputs: list[Input] = field(default_factory=list)
    states: list[State] = field(default_factory=list)
    checks: list[Check] = field(default_factory=list)
    _places: dict[str, int] = field(default_factory=dict)

    @property
    def scope(self) -> Scope:
        """Where values of declarations stand."""
        return Scope(self.symbols)

    def constants(self, declarations: Sequence[ConstantDeclaration], report: Report) -> None:
        """``constant n = 10``, each behind those that it reads."""
        known = {declaration.name.text: declaration for declaration in reversed(declarations)}
        reads = {name: list(written_names(one.value)) for name, one in known.items()}
        ordered = order(list(reads), reads)
        for name in ordered:
            with report.collecting():
                self._constant(known[name])
        if len(ordered) < len(known):
            circle = loop(list(reads), reads)
            report.found.extend(
                in_a_circle(circle, {name: known[name].name.span for name in circle}).diagnostics
            )

    def _constant(self, declaration: ConstantDeclaration) -> None:
        value = integer(declaration.value, self.scope, f"`{declaration.name.text}`")
        span = declaration.name.span
        self.symbols.define(
            Symbol(declaration.name.text, "constant", (), None, span, value=Number(float(value)))
        )

    def parameter(self, declaration: ParameterDeclaration) -> None:
        """``parameter M = 1 {kg} > 0``: numbers alone."""
        declarator, over, value = self._value(declaration.declarator, declaration.value)
        name = declarator.name.text
        of = self._define(declarator, "parameter", over, value, declaration.unit)
        columns = self._columns(value, of, over, declarator)
        for suffix, column in zip(suffixes(of), columns, strict=True):
            found = tuple(
                constant(in_si(part, declaration.unit), f"the value of `{name}`") for part in column
            )
            unit = None if declaration.unit is None else declaration.unit.text
            self.parameters.append(
                Parameter(name + suffix, found, over, unit, span=declarator.name.span)
            )
            self._bounds(name + suffix, over, declaration.bounds, declaration.unit)

    def input(self, declaration: InputDeclaration) -> None:
        """``input fe = 0 {N}``."""
        over = index_range(declaration.declarator.range, self.scope)
        declared = self._sizes(declaration.declarator)
        default: Value | None = None
        if declaration.default is not None:
            default = self._elaborated(declaration.default, self.scope.with_index(over))
        of = declared if declared is not None else () if default is None else shape(default)
        self._fits(default, of, declaration.declarator)
        name = declaration.declarator.name
        unit = None if declaration.unit is None else declaration.unit.text
        self.symbols.define(Symbol(name.text, "input", of, over, name.span, unit))
        parts = scalars(default) if default is not None else (None,) * len(suffixes(of))
        for suffix, part in zip(suffixes(of), parts, strict=True):
            number = None
            if part is not None:
                number = constant(in_si(part, declaration.unit), f"the default of `{name.text}`")
            self.inputs.append(Input(name.text + suffix, number, over, unit, span=name.span))
            self._bounds(name.text + suffix, over, declaration.bounds, declaration.unit)

    def state(self, declaration: StateDeclaration) -> None:
        """``state p[3] = [0, 0, 2*R] {m}``; the shape now, the value with :meth:`initial`."""
        over = index_range(declaration.declarator.range, self.scope)
        of = self._sizes(declaration.declarator) or ()
        name = declaration.declarator.name
        unit = None if declaration.unit is None else declaration.unit.text
        self.symbols.define(Symbol(name.text, "state", of, over, name.span, unit))
        zero = Number(0.0, span=declaration.initial.span)
        for suffix in suffixes(of):
            self._places[name.text + suffix] = len(self.states)
            self.states.append(State(name.text + suffix, zero, over, unit, span=name.span))

    def initial(self, declaration: StateDeclaration, scope: Scope) -> None:
        """Give a state its value at the start, once every name is known."""
        symbol = self.symbols.find(declaration.declarator.name.text, declaration.span)
        inner = replace(scope.with_index(symbol.range), constants=True)
        value = self._elaborated(declaration.initial, inner)
        if symbol.range is not None and shape(value) == (len(symbol.range), *symbol.shape):
            value = _listed(value, symbol)
        self._fits(value, symbol.shape, declaration.declarator)
        for suffix, part in zip(suffixes(symbol.shape), scalars(value), strict=True):
            k = self._places[symbol.name + suffix]
            converted = in_si(part, declaration.unit)
            self.states[k] = replace(self.states[k], initial=converted)

    def _elaborated(self, expr: Expr, scope: Scope) -> Value:
        value = each(number, elaborate(expr, scope))
        self.review.check(value)
        return value

    def _value(
        self, declarator: Declarator, expr: Expr
    ) -> tuple[Declarator, IndexRange | None, Value]:
        over = index_range(declarator.range, self.scope)
        return declarator, over, self._elaborated(expr, self.scope.with_index(over))

    def _sizes(self, declarator: Declarator) -> Shape | None:
        if not declarator.sizes:
            return None if declarator.range is None else ()
        found = tuple(integer(size, self.scope, "the size") for size in declarator.sizes)
        for size, written in zip(found, declarator.sizes, strict=True):
            if size < 1:
                raise refuse("NS105", "a size must be at least 1", written.span)
            check_size(size, written.span)
            if size > 16:
                raise refuse(
                    "NS105",
                    f"a vector of {size} is larger than 16",
                    written.span,
                    help="declare a family: `state x[i in 1..n] = ...`",
                )
        return found

    def _fits(self, value: Value | None, of: Shape, declarator: Declarator) -> None:
        if value is not None and shape(value) != of:
            name, found = declarator.name.text, describe(shape(value))
            raise refuse(
                "NS105",
                f"`{name}` is {describe(of)}, but its value is {found}",
                declarator.span,
                help="give one value for each component, for example `[0, 0, 0]`",
            )

    def _define(
        self,
        declarator: Declarator,
        kind: Kind,
        over: IndexRange | None,
        value: Value,
        unit: Unit | None,
    ) -> Shape:
        declared = self._sizes(declarator) or ()
        of = shape(value)
        if over is not None and of == (len(over), *declared):
            of = declared
        elif declarator.sizes or over is not None:
            self._fits(value, declared, declarator)
        name = declarator.name
        self.symbols.define(
            Symbol(name.text, kind, of, over, name.span, None if unit is None else unit.text)
        )
        return of

    def _columns(
        self, value: Value, of: Shape, over: IndexRange | None, declarator: Declarator
    ) -> list[list[Expr]]:
        """Return, for each component, its values over the range."""
        if over is None:
            return [[part] for part in scalars(value)]
        if shape(value) != of and isinstance(value, tuple):
            return [list(column) for column in zip(*(scalars(row) for row in value), strict=True)]
        return [
            [
                Number(evaluate(part, _no_names, {over.variable: k}), span=part.span)
                for k in range(over.first, over.last + 1)
            ]
            if not any(True for _ in names(part))
            else [part]
            for part in scalars(value)
        ]

    def _bounds(
        self, name: str, over: IndexRange | None, bounds: Sequence[Bound], unit: Unit | None
    ) -> None:
        for bound in bounds:
            value = self._elaborated(bound.value, self.scope)
            if not isinstance(value, Expr):
                raise refuse("NS105", "a bound is a scalar", bound.span)
            limit = Number(constant(in_si(value, unit), "a bound"), span=bound.span)
            at = None
            if over is not None:
                at = Index(over.variable)
            condition = Call(
                bound.relation, (Name(name, at, span=bound.span), limit), span=bound.span
            )
            self.checks.append(Check("bound", condition, over, "declared", span=bound.span))


def _listed(value: Value, symbol: Symbol) -> Value:
    """Return a list of one value for each element as a choice by index."""
    assert isinstance(value, tuple)
    assert symbol.range is not None
    rows = [scalars(row) for row in value]
    chosen = tuple(choose(list(column), symbol.range) for column in zip(*rows, strict=True))
    return from_scalars(chosen, symbol.shape)


def _no_names(name: str, at: int | None) -> float:
    raise AssertionError(name)
