"""What is said of a run that went wrong."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.evaluate import evaluate
from nsode.expr import TIME, names
from nsode.integrators import REGISTRY, RungeKutta
from nsode.ode import AugmentedODE, Check, element, element_names
from nsode.simulate.inputs import Inputs
from nsode.simulate.loop import Record
from nsode.simulate.machine import BROKEN, NOT_FINITE, SINGULAR, Machine, Vector
from nsode.simulate.settings import Settings
from nsode.source import Source

if TYPE_CHECKING:
    from nsode.simulate.trajectory import Trajectory


class RunError(ModelError):
    """A run went wrong; ``trajectory`` holds the rows before that."""

    def __init__(self, cause: Diagnostic, source: Source | None, trajectory: Trajectory) -> None:
        super().__init__([cause], source)
        self.trajectory = trajectory

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (*self.diagnostics, self.source, self.trajectory)


def cause(
    ode: AugmentedODE,
    machine: Machine,
    settings: Settings,
    inputs: Inputs,
    p: Vector,
    found: Record,
) -> Diagnostic:
    """Return why the step after the last one of a record failed."""
    now = settings.start + found.taken * settings.step
    where = f"in step {found.taken + 1:,} at t = {now:.6g} s"
    rows = len(found.t)
    kept = "the row before it is kept" if rows == 1 else f"{rows:,} rows up to there are kept"
    if found.status == NOT_FINITE:
        names = _not_finite(ode, machine, settings, now, inputs.at(now), p, found.x)
        return Diagnostic(
            "NS504",
            f"{names} no longer finite {where}",
            notes=(kept,),
            help="choose a smaller step, or look at the signs of parameters and forces; "
            "a model that truly grows without bound has no more to say",
        )
    if found.status == SINGULAR:
        message = f"the mass matrix is singular {where}"
        return Diagnostic("NS113", message, notes=(kept,))
    if found.status >= BROKEN:
        check = ode.checks[found.status - BROKEN]
        at = _broken_at(check, ode, _Values(now, found.x, inputs.at(now), p))
        return Diagnostic(
            "NS505",
            f"a condition of the model does not hold{at} {where}",
            (Label(check.span, _broken(check, ode)),),
            notes=(kept,),
        )
    return Diagnostic("NS504", f"a step returned status {found.status} {where}", notes=(kept,))


def _broken(check: Check, ode: AugmentedODE) -> str:
    text = ode.source.on_one_line(check.span)
    match check.kind:
        case "assume":
            return f"`{text}` was assumed"
        case "bound":
            return f"`{text}` was declared"
    return f"{check.reason} is negative"


class _Values(NamedTuple):
    """Where a run is: the time, the states, the inputs and the parameters."""

    t: float
    x: Vector
    u: Vector
    p: Vector


def _broken_at(check: Check, ode: AugmentedODE, now: _Values) -> str:
    """Return the first index at which a family breaks a check; nothing where a let tells it."""
    vectors = ((ode.states, now.x), (ode.inputs, now.u), (ode.parameters, now.p))
    known = {item.name for items, _ in vectors for item in items} | {TIME}
    if check.range is None or any(name.id not in known for name in names(check.condition)):
        return ""
    value: dict[str, float] = {TIME: now.t}
    for items, vector in vectors:  # an empty vector has one place
        value.update(zip(element_names(items), vector.tolist(), strict=False))

    def lookup(name: str, at: int | None) -> float:
        return value[name if at is None else element(name, at)]

    variable, first, last = check.range
    for k in range(first, last + 1):
        if not evaluate(check.condition, lookup, {variable: k}):
            return f" for `{variable} = {k}`"
    return ""


def interrupted(settings: Settings, found: Record) -> Diagnostic:
    """Return the remark on a run that somebody stopped."""
    now = settings.start + found.taken * settings.step
    message = f"interrupted at t = {now:.6g} s, after {found.taken:,} of {settings.steps:,} steps"
    return Diagnostic("NS507", message, severity="warning")


def _not_finite(
    ode: AugmentedODE,
    machine: Machine,
    settings: Settings,
    t: float,
    u: Vector,
    p: Vector,
    x: Vector,
) -> str:
    """Return which states break; the step is repeated, for the C does not tell."""
    with np.errstate(all="ignore"):
        after = _step(machine, settings, t, u, p, x)
    pairs = zip(element_names(ode.states), after, strict=True)
    hidden = (".balance", ".moved")  # states of the guard, which break only with others
    bad = [f"`{n}`" for n, v in pairs if not np.isfinite(v) and not n.endswith(hidden)]
    if not bad:
        return "a state is"
    shown = ", ".join(bad[:4]) + (f" and {len(bad) - 4} more" if len(bad) > 4 else "")
    return f"{shown} {'is' if len(bad) == 1 else 'are'}"


def _step(
    machine: Machine, settings: Settings, t: float, u: Vector, p: Vector, x: Vector
) -> Vector:
    scheme, h = REGISTRY.get(settings.method), settings.step
    if not isinstance(scheme, RungeKutta):
        return x + h * machine.rates(t, x, u, p)
    slopes: list[Vector] = []
    for node, row in zip(scheme.c, scheme.a, strict=True):
        slopes.append(machine.rates(t + float(node) * h, x + h * _mean(row, slopes, x), u, p))
    return x + h * _mean(scheme.b, slopes, x)


def _mean(weights: Sequence[Fraction], slopes: Sequence[Vector], like: Vector) -> Vector:
    mean = np.zeros_like(like)
    for weight, slope in zip(weights, slopes, strict=True):
        mean += float(weight) * slope
    return mean
