"""Declarations: parameters, constants, inputs and states become items of the system."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.evaluate import apply, evaluate
from nsode.expr import Call, Expr, Index, IndexRange, Name, Number, names, walk
from nsode.inclusion.definitions import written_names
from nsode.inclusion.elaborate import elaborate
from nsode.inclusion.fitting import declared_shape, fitted
from nsode.inclusion.indices import index_range, integer
from nsode.inclusion.kinds import number
from nsode.inclusion.order import loop, order
from nsode.inclusion.report import Report, in_a_circle
from nsode.inclusion.review import Review, in_words
from nsode.inclusion.settings import constant
from nsode.inclusion.symbols import Scope, Symbol, Symbols
from nsode.inclusion.units import in_si
from nsode.inclusion.values import (
    Shape,
    Value,
    each,
    scalars,
    shape,
    suffixes,
)
from nsode.ode import Check, Input, Parameter, State, element_names
from nsode.syntax.ast import (
    Bound,
    ConstantDeclaration,
    Declarator,
    InputDeclaration,
    Model,
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
            spans = {name: known[name].name.span for name in circle}
            error = in_a_circle(circle, spans, "give one of them a number")
            report.found.extend(error.diagnostics)

    def _constant(self, declaration: ConstantDeclaration) -> None:
        value = integer(declaration.value, self.scope, f"`{declaration.name.text}`")
        span = declaration.name.span
        self.symbols.define(
            Symbol(declaration.name.text, "constant", (), None, span, value=Number(float(value)))
        )

    def parameter(self, declaration: ParameterDeclaration) -> None:
        """``parameter M = 1 {kg} > 0``: numbers alone."""
        declarator = declaration.declarator
        name = declarator.name.text
        over = index_range(declarator.range, self.scope)
        self._check_numbers(declaration.value, f"the value of `{name}`", over)
        value = self._elaborated(declaration.value, self.scope.with_index(over))
        value = fitted(value, over, self._sizes(declarator), declarator)
        unit = None if declaration.unit is None else declaration.unit.text
        of, span = shape(value), declarator.name.span
        self.symbols.define(Symbol(name, "parameter", of, over, span, unit))
        for suffix, part in zip(suffixes(of), scalars(value), strict=True):
            found = _elements(part, over, declaration.unit, f"the value of `{name}`")
            self.parameters.append(Parameter(name + suffix, found, over, unit, span=span))
            self._bounds(self.parameters[-1], found, declaration.bounds, declaration.unit)

    def input(self, declaration: InputDeclaration) -> None:
        """``input fe = 0 {N}``."""
        over = index_range(declaration.declarator.range, self.scope)
        declared = self._sizes(declaration.declarator)
        default: Value | None = None
        if declaration.default is not None:
            what = f"the default of `{declaration.declarator.name.text}`"
            self._check_numbers(declaration.default, what, over)
            default = self._elaborated(declaration.default, self.scope.with_index(over))
            default = fitted(default, None, declared, declaration.declarator)
            _check_one_default(default)
        of = declared if declared is not None else () if default is None else shape(default)
        name = declaration.declarator.name
        unit = None if declaration.unit is None else declaration.unit.text
        self.symbols.define(Symbol(name.text, "input", of, over, name.span, unit))
        parts = scalars(default) if default is not None else (None,) * len(suffixes(of))
        for suffix, part in zip(suffixes(of), parts, strict=True):
            number = None
            if part is not None:
                number = constant(in_si(part, declaration.unit), f"the default of `{name.text}`")
            self.inputs.append(Input(name.text + suffix, number, over, unit, span=name.span))
            default_values = () if number is None else (number,)
            self._bounds(self.inputs[-1], default_values, declaration.bounds, declaration.unit)

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
        value = fitted(value, symbol.range, symbol.shape, declaration.declarator)
        for suffix, part in zip(suffixes(symbol.shape), scalars(value), strict=True):
            k = self._places[symbol.name + suffix]
            converted = in_si(part, declaration.unit)
            self.states[k] = replace(self.states[k], initial=converted)

    def _check_numbers(self, expr: Expr, what: str, over: IndexRange | None) -> None:
        """Refuse a name that is declared and no constant: its value is not known yet."""
        for name in written_names(expr):
            known = self.symbols.known.get(name)
            is_index = over is not None and name == over.variable
            if is_index or name not in self.symbols.declared or (known and known.value is not None):
                continue
            raise refuse(
                "NS111",
                f"{what} must be made of numbers alone",
                expr.span,
                f"reads `{name}`",
                help="write the number; what follows from other quantities is a `let`",
            )

    def _elaborated(self, expr: Expr, scope: Scope) -> Value:
        value = each(number, elaborate(expr, scope))
        self.review.check(value)
        return value

    def _sizes(self, declarator: Declarator) -> Shape | None:
        """Return the declared shape; an element of a family is a scalar unless declared."""
        found = declared_shape(declarator, self.scope)
        return () if found is None and declarator.range is not None else found

    def _bounds(
        self,
        item: Parameter | Input,
        values: Sequence[float],
        bounds: Sequence[Bound],
        unit: Unit | None,
    ) -> None:
        """Keep the bounds of a declaration; its own values must respect them."""
        for bound in bounds:
            value = self._elaborated(bound.value, self.scope)
            if not isinstance(value, Expr):
                raise refuse("NS105", "a bound is a scalar", bound.span)
            limit = Number(constant(in_si(value, unit), "a bound"), span=bound.span)
            at = None if item.range is None else Index(item.range.variable)
            held = Call(
                bound.relation, (Name(item.name, at, span=bound.span), limit), span=bound.span
            )
            for name, own in zip(element_names([item]), values, strict=False):
                if not apply(bound.relation, own, limit.value):
                    raise _out_of_bounds(item, name, own, bound)
            self.checks.append(Check("bound", held, item.range, "declared", span=bound.span))


def declare(model: Model, symbols: Symbols, review: Review, report: Report) -> Declarations:
    """Return the items of a model that need no other names than constants."""
    declared = Declarations(symbols, review)
    declared.constants(model.all(ConstantDeclaration), report)
    report.each(declared.parameter, model.all(ParameterDeclaration))
    report.each(declared.input, model.all(InputDeclaration))
    report.each(declared.state, model.all(StateDeclaration))
    return declared


def _check_one_default(default: Value) -> None:
    for part in scalars(default):
        if any(isinstance(node, Index) for node in walk(part)):
            raise refuse(
                "NS111",
                "the elements of an input have one default",
                part.span,
                "this depends on the index",
                help="give one number; what an input is in a run comes from data",
            )


def _out_of_bounds(item: Parameter | Input, name: str, value: float, bound: Bound) -> ModelError:
    labels = (Label(bound.span, "the bound"), Label(item.span, f"is {value:g}"))
    message = f"the value {value:g} of `{name}` breaks its own bound"
    return ModelError([Diagnostic("NS307", message, labels, help="change the value or the bound")])


def _elements(
    value: Expr, over: IndexRange | None, unit: Unit | None, what: str
) -> tuple[float, ...]:
    """Return the value of a parameter, or that of each of its elements, in SI."""
    if over is None:
        return (constant(in_si(value, unit), what),)
    if any(True for _ in names(value)):
        return (constant(value, what),)
    found: list[float] = []
    for k in range(over.first, over.last + 1):
        element = evaluate(value, _no_names, {over.variable: k})
        if not math.isfinite(element):
            where = f"for `{over.variable} = {k}`"
            raise refuse("NS116", f"{what} is {in_words(element)} {where}", value.span)
        if unit is not None:
            element = constant(in_si(Number(element, span=value.span), unit), what)
        found.append(element)
    return tuple(found)


def _no_names(name: str, at: int | None) -> float:
    raise AssertionError(name)
