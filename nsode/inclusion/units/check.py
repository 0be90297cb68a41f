"""A differential inclusion whose units are checked, item by item."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import reduce

from nsode.diagnostics import Diagnostic
from nsode.dimension import ONE, SECOND
from nsode.expr import TIME, Expr
from nsode.inclusion.equations import derivative_name
from nsode.inclusion.units import messages
from nsode.inclusion.units.declared import Declared, any_unit, declared_units, stated_in_si
from nsode.inclusion.units.elements import check_element
from nsode.inclusion.units.inference import Inference, head
from nsode.inclusion.units.quantity import CLOCK, UNKNOWN, Quantity, over, times
from nsode.inclusion.units.values import check_value
from nsode.inclusion.values import is_zero
from nsode.ode import (
    DOT_SUFFIX,
    Binding,
    DifferentialInclusion,
    LinearSolve,
    Output,
    Placed,
    SetValuedTerm,
)
from nsode.source import Span
from nsode.syntax import ast

_SECONDS = Quantity(SECOND)


def check_units(
    model: ast.Model, inclusion: DifferentialInclusion
) -> tuple[DifferentialInclusion, tuple[Diagnostic, ...]]:
    """Check the units of a model as far as it declares any.

    Returns
    -------
    inclusion
        With the unit of every declared item, forces included, in which its values
        stand: SI, in the declared words where these are SI. An output without one has
        that of its value.
    problems
        NS115 for units that do not fit, NS114 for unknown ones.
    """
    if not any_unit(model):
        return inclusion, ()
    declared = declared_units(model)
    states = {derivative_name(state.name): state.name for state in inclusion.states}
    check = _Check(declared, _inference(inclusion, declared), states)
    check.whole(inclusion)
    problems = (*declared.unknown, *check.inference.found.values())
    stated = stated_in_si(inclusion, declared)
    outputs = tuple(_with_unit(output, check.inference) for output in stated.outputs)
    return replace(stated, outputs=outputs), problems


def _with_unit(output: Output, inference: Inference) -> Output:
    """Give an output without a unit that of its value, as far as it is known."""
    found = inference.of(output.value).rigid
    if output.unit is not None or found in (None, ONE):
        return output
    return replace(output, unit=str(found))


def _inference(inclusion: DifferentialInclusion, declared: Declared) -> Inference:
    known = {TIME: CLOCK}
    items: list[Placed] = [*inclusion.parameters, *inclusion.inputs, *inclusion.states]
    for item in items:
        unit = declared.of(item.name)
        if unit is not None:
            known[item.name] = unit.quantity
    for state in inclusion.states:
        quantity = known.get(state.name)
        if quantity is not None:
            known[derivative_name(state.name)] = over(quantity, _SECONDS)
    places = {name: unit.written.span for name, unit in declared.names.items()}
    return Inference(known, places)


@dataclass(slots=True)
class _Check:
    """The course of a check; ``states`` maps the name of each rate to its state."""

    declared: Declared
    inference: Inference
    states: Mapping[str, str]

    def whole(self, inclusion: DifferentialInclusion) -> None:
        """Check everything, definitions before what reads them."""
        for item in inclusion.bindings:
            match item:
                case Binding():
                    self._binding(item)
                case SetValuedTerm():
                    found = check_element(item, self.declared, self.inference)
                    self.declared.elements[item.name] = found
                case LinearSolve():
                    self._solve(item)
        for rate in inclusion.rates:
            self._rate(rate.state, rate.value, rate.span)
        for output in inclusion.outputs:
            self._value(output.name, output.value)
        for state in inclusion.states:
            self._value(state.name, state.initial)
        for check in inclusion.checks:
            if check.kind == "assume":
                self.inference.of(check.condition)
        for setting in self.declared.run:
            self._time(setting)

    def _binding(self, item: Binding) -> None:
        if item.role in ("let", "force"):
            quantity = self._value(item.name, item.value)
        elif item.name in self.states:
            self._rate(self.states[item.name], item.value, item.span)
            return
        else:
            quantity = self._part(item)
        self.inference.known[item.name] = UNKNOWN if quantity.flexible else quantity

    def _part(self, item: Binding) -> Quantity:
        """Return the unit of a part; that of a derivative follows from what it derives."""
        found = self.inference.of(item.value)
        name, *derived = item.name.split(DOT_SUFFIX)
        unit = self.declared.of(name)
        of = self.inference.known.get(name, UNKNOWN) if unit is None else unit.quantity
        if not derived or of.rigid is None:
            return found
        return reduce(over, [_SECONDS] * len(derived), of)

    def _value(self, name: str, value: Expr) -> Quantity:
        """Check a value against the unit of its name; return the unit that counts."""
        unit = self.declared.of(name)
        if unit is None:
            return self.inference.of(value)
        return check_value(f"`{head(name)}`", value, unit, self.inference)

    def _rate(self, state: str, value: Expr, equation: Span) -> None:
        wanted = self.inference.known.get(derivative_name(state), UNKNOWN)
        found = self.inference.of(value)
        unit = self.declared.of(state)
        if unit is not None and found.rigid not in (None, wanted.dimension):
            place = unit.written.span
            self.inference.add(messages.no_rate(head(state), found, equation, wanted, place))

    def _solve(self, item: LinearSolve) -> None:
        """Check that the terms of each row have one unit."""
        rates = [self.inference.known.get(name, UNKNOWN) for name in item.unknowns]
        for row, right in zip(item.matrix, item.right, strict=True):
            entries = [
                (entry, times(self.inference.of(entry), rate))
                for entry, rate in zip(row, rates, strict=True)
                if not is_zero(entry)
            ]
            entries.append((right, self.inference.of(right)))
            parts, values = zip(*entries, strict=True)
            self.inference.alike(parts, values, "terms of one equation")

    def _time(self, setting: ast.Setting) -> None:
        unit = None if setting.unit is None else self.declared.measured(setting.unit)
        if unit is not None and unit.quantity.dimension is not SECOND:
            what = f"the {setting.name.text} of a run"
            place = unit.written.span
            self.inference.add(messages.no_constant(what, unit.quantity, place, _SECONDS))
