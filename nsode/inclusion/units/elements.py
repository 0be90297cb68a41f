"""A set-valued term: its multiplier, and the constants that approximate it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from nsode.diagnostics import Label
from nsode.dimension import Dimension
from nsode.inclusion.units import laws, messages
from nsode.inclusion.units.declared import Declared
from nsode.inclusion.units.inference import Inference
from nsode.inclusion.units.quantity import UNKNOWN, Quantity
from nsode.inclusion.units.values import check_value
from nsode.ode import SetValuedTerm
from nsode.source import Span


class _Given(NamedTuple):
    """A constant or target, as the model gives it."""

    name: str
    quantity: Quantity
    place: Span


def check_element(
    term: SetValuedTerm, declared: Declared, inference: Inference
) -> tuple[Dimension | None, Dimension | None]:
    """Check a term and what is given for it; make the unit of its multiplier known.

    Returns
    -------
    tuple
        The dimensions of its multiplier and of its argument.
    """
    values = [inference.of(part) for part in term.argument]
    argument = inference.alike(term.argument, values, "components of one velocity")
    force = _multiplier(term, declared, inference)
    given = list(_given(term, declared, inference))
    if force.rigid is None:
        force = _from_stiffness(term, given, argument)
    for name in term.multiplier:
        inference.known[name] = force
    for item in given:
        _check(item, term, force, argument, inference)
    return force.rigid, argument.rigid


def _multiplier(term: SetValuedTerm, declared: Declared, inference: Inference) -> Quantity:
    """Return the unit of a force that is nothing but its term, or else that of chi."""
    unit = None if ".lambda" in term.multiplier[0] else declared.of(term.name)
    if unit is None:
        return UNKNOWN if term.factor is None else inference.of(term.factor)
    if term.factor is None:
        return unit.quantity
    return check_value(f"`{term.name}`", term.factor, unit, inference)


def _given(term: SetValuedTerm, declared: Declared, inference: Inference) -> Iterator[_Given]:
    written = declared.settings.get(term.approximation.span, {})
    for name, value in (*term.approximation.constants, *term.approximation.targets):
        setting = written.get(name)
        unit = None
        if setting is not None and setting.unit is not None:
            unit = declared.measured(setting.unit)
        if unit is None:
            yield _Given(name, inference.of(value), value.span)
        else:
            quantity = check_value(f"`{name}`", value, unit, inference)
            yield _Given(name, quantity, unit.written.span)


def _from_stiffness(term: SetValuedTerm, given: list[_Given], argument: Quantity) -> Quantity:
    """Return what K tells of the multiplier."""
    stiffness = {item.name: item.quantity.rigid for item in given}.get("K")
    if stiffness is None or argument.rigid is None:
        return UNKNOWN
    return Quantity(laws.force(term, stiffness, argument.rigid))


def _check(
    item: _Given, term: SetValuedTerm, force: Quantity, argument: Quantity, inference: Inference
) -> None:
    wanted = Quantity(laws.constant(term, item.name, force.rigid, argument.rigid))
    known = wanted if wanted.rigid is not None else item.quantity
    inference.known[f"{term.name}.{item.name}"] = UNKNOWN if known.flexible else known
    if wanted.rigid is None or item.quantity.rigid in (None, wanted.rigid):
        return
    reasons: list[Label] = []
    if laws.follows_from_units(term, item.name):
        nouns = ("force", "gap") if term.kind == "dio" else ("factor", "velocity")
        reasons.append(Label(term.span, f"a {nouns[0]} {force}, a {nouns[1]} {argument}"))
    what = f"`{item.name}` of `{term.name}`"
    inference.add(messages.no_constant(what, item.quantity, item.place, wanted, *reasons))
