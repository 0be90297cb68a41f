"""What can be said of a run before it: whether its step is stable."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import replace

from nsode.diagnostics import Diagnostic
from nsode.expr import Number
from nsode.ode import (
    AugmentedODE,
    Definition,
    DifferentialInclusion,
    Parameter,
    SetValuedTerm,
    size,
)
from nsode.simulate.machine import Vector
from nsode.simulate.settings import Settings

_KEPT = 32  # runs that are remembered
_known: OrderedDict[tuple[object, ...], tuple[object, tuple[Diagnostic, ...]]] = OrderedDict()


def foreseen(
    inclusion: DifferentialInclusion, ode: AugmentedODE, settings: Settings, p: Vector
) -> tuple[Diagnostic, ...]:
    """Return what :func:`foresee` does, looked up where a run is repeated."""
    key = (id(inclusion), id(ode), settings.method, settings.step, p.tobytes())
    if key not in _known:
        # The table holds the model itself, so that nothing else can take over its id.
        _known[key] = ((inclusion, ode), foresee(inclusion, ode, settings, p))
        if len(_known) > _KEPT:
            _known.popitem(last=False)
    return _known[key][1]


def foresee(
    inclusion: DifferentialInclusion, ode: AugmentedODE, settings: Settings, p: Vector
) -> tuple[Diagnostic, ...]:
    """Return a warning where the step is beyond what the method can take.

    Parameters
    ----------
    p
        The parameters of the run, which may be others than the model's.
    """
    from nsode.analysis import warnings

    chosen = _as_run(inclusion, ode, settings, p)
    found = (d for d in warnings(chosen) if d.code == "NS407")
    if inclusion.run.step == settings.step:
        return tuple(found)
    return tuple(replace(d, labels=()) for d in found)  # the step stands nowhere in the text


def _as_run(
    inclusion: DifferentialInclusion, ode: AugmentedODE, settings: Settings, p: Vector
) -> DifferentialInclusion:
    """Return the inclusion with the parameters, constants, step and method of a run."""
    values = p.tolist()
    known: dict[str, Parameter] = {}
    for item in ode.parameters:
        mine, values = tuple(values[: size(item)]), values[size(item) :]
        known[item.name] = replace(item, values=mine, formula=None)
    return replace(
        inclusion,
        parameters=tuple(known[item.name] for item in inclusion.parameters),
        bindings=tuple(_with_constants(item, known) for item in inclusion.bindings),
        run=replace(inclusion.run, step=settings.step, method=settings.method),
    )


def _with_constants(item: Definition, known: dict[str, Parameter]) -> Definition:
    if not isinstance(item, SetValuedTerm):
        return item
    mine = [p for p in known.values() if p.constant_of == item.name]
    constants = tuple((p.name.rpartition(".")[2], Number(p.values[0])) for p in mine)
    return replace(item, approximation=replace(item.approximation, constants=constants))
