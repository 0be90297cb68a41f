"""What can be said of a run before it: whether its step is stable, and by what margin."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, replace

from nsode.diagnostics import Diagnostic
from nsode.expr import Number
from nsode.integrators.splittings import SPLITTINGS
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

#: What the run says with its own parameters, and need not be said of the model's before it.
TOLD = ("NS402", "NS407", "NS409", "NS411", "NS412")

#: A step below this share of the limit needs no guard.
MARGIN = 0.5

_KEPT = 32  # runs that are remembered


@dataclass(frozen=True, slots=True)
class Outlook:
    """What is said before a run, and whether its energy needs a guard."""

    remarks: tuple[Diagnostic, ...]
    doubtful: bool


_known: OrderedDict[tuple[object, ...], tuple[object, Outlook]] = OrderedDict()


def foreseen(
    inclusion: DifferentialInclusion, ode: AugmentedODE, settings: Settings, p: Vector
) -> Outlook:
    """Return what :func:`outlook` does, looked up where a run is repeated."""
    key = (id(inclusion), id(ode), settings.method, settings.step, p.tobytes())
    if key not in _known:
        # The table holds the model itself, so that nothing else can take over its id.
        _known[key] = ((inclusion, ode), outlook(inclusion, ode, settings, p))
        if len(_known) > _KEPT:
            _known.popitem(last=False)
    return _known[key][1]


def outlook(
    inclusion: DifferentialInclusion, ode: AugmentedODE, settings: Settings, p: Vector
) -> Outlook:
    """Return what is known of the step: NS407, NS409, or NS410 where nothing is.

    Parameters
    ----------
    p
        The parameters of the run, which may be others than the model's.
    """
    from nsode.analysis import foresee

    found = foresee(_as_run(inclusion, ode, settings, p), MARGIN)
    remarks = [_of_signs(d) for d in found.diagnostics if d.code in TOLD]
    if inclusion.run.step != settings.step:  # it stands nowhere in the text
        remarks = [replace(d, labels=()) if d.code == "NS407" else d for d in remarks]
    if found.unknown is not None and all(remark.code != "NS407" for remark in remarks):
        remarks.append(_unchecked(found.unknown))
    known = found.limit is not None and not found.varies
    certain = known and settings.step <= MARGIN * (found.limit or 0.0)
    # A splitting integrates the books with errors of another kind, which look like gains.
    return Outlook(tuple(remarks), not certain and settings.method not in SPLITTINGS)


def _of_signs(found: Diagnostic) -> Diagnostic:
    """Return a warning of fed energy that also tells of parameters, which a run can change."""
    if found.code != "NS402":
        return found
    return replace(found, help=f"{found.help}; a parameter of the wrong sign does the same")


def _unchecked(why: str) -> Diagnostic:
    message = "whether the step is stable was not checked"
    help = "run it with half the step too: what changes much is not to be trusted"
    return Diagnostic("NS410", message, notes=(why,), help=help, severity="note")


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
