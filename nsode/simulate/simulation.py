"""One run from beginning to end: what it takes, what it says, what it hands back."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from typing import Any

import numpy as np

from nsode import __version__
from nsode.diagnostics import Diagnostic, ModelError
from nsode.integrators import REGISTRY
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.ode import AugmentedODE, DifferentialInclusion, Output, State, element_names, size
from nsode.rewrite.start import Beginning, pressed_at_start
from nsode.simulate import failure, parameters, solvers
from nsode.simulate.compilers import overlooked
from nsode.simulate.foresee import foreseen
from nsode.simulate.guard import verdict
from nsode.simulate.inputs import Signal, inputs
from nsode.simulate.loop import Progress, Record, record
from nsode.simulate.machine import OK, Vector
from nsode.simulate.observe import Observed
from nsode.simulate.parameters import Value
from nsode.simulate.scene import Scene, scene, slowly
from nsode.simulate.settings import SOLVERS, Settings, Wish, settle
from nsode.simulate.trajectory import Trajectory


class RunWarning(UserWarning):
    """A run that may be wrong, or that ended early."""


def _warn(diagnostic: Diagnostic) -> None:
    if diagnostic.severity == "warning":
        way_out = "" if diagnostic.help is None else f"; {diagnostic.help}"
        text = f"{diagnostic.message} [{diagnostic.code}]{way_out}"
        warnings.warn(text, RunWarning, stacklevel=5)


@dataclass(frozen=True, slots=True)
class Manner:
    """How a run goes about it: what it refuses, and whom it tells.

    Attributes
    ----------
    strict
        Refuse what would draw a warning before the run.
    guard
        Stop where energy comes from nothing. Books are kept where a method of fixed steps
        takes more than half of its limit, or where that is not known or varies; below half
        of it, nothing is watched and nothing is paid.
    tell
        Takes warnings and notes; Python warnings unless given.
    progress
        Takes the steps taken and that of all, some twenty times a second.
    limits
        How many steps and how much memory a run may take.
    """

    strict: bool = False
    guard: bool = True
    tell: Callable[[Diagnostic], None] = _warn
    progress: Progress | None = None
    limits: Limits = DEFAULT_LIMITS


_MODELS_OWN = Wish()
_USUAL = Manner()


def simulate(
    inclusion: DifferentialInclusion,
    ode: AugmentedODE,
    wish: Wish = _MODELS_OWN,
    *,
    overrides: Mapping[str, Value] | None = None,
    signals: Mapping[str, Signal] | None = None,
    start: Mapping[str, float] | None = None,
    manner: Manner = _USUAL,
) -> Trajectory:
    """Run a model and return what happened.

    Parameters
    ----------
    inclusion, ode
        The model before and after the rewrite.
    wish
        Duration, step, rows, method; the model's own where nothing is asked for.
    overrides
        Values of parameters by name, for this run.
    signals
        Inputs by name: a number, recorded (times, values), or a function of times.
    start
        States at the start by name, where they are not the model's.
    manner
        What is refused and who is told.

    Returns
    -------
    Trajectory
        What was stored; after Ctrl-C, as far as the run came.

    Raises
    ------
    ModelError
        Before the run: NS101, NS307, NS5xx.
    RunError
        If the run goes wrong; it holds the rows before that.
    """
    p = parameters.parameters(ode, overrides or {})
    settings, remarks = settle(wish, ode.run, _columns(ode), manner.limits)
    given = inputs(ode, signals or {}, settings)
    before = foreseen(inclusion, ode, settings, p)
    made = scene(inclusion, ode, settings.method, watched=manner.guard and before.doubtful)
    x0 = made.machine.initial(p if len(p) else np.zeros(1))
    parameters.states(ode, x0, start or {})
    u0 = given.at(settings.start)
    begin = Beginning(settings.start, x0.tolist(), u0.tolist(), p.tolist(), chosen=bool(start))
    pressed = pressed_at_start(inclusion.terms, ode, begin)
    _say([*remarks, *overlooked(), *slowly(made), *pressed, *before.remarks], manner, ode)
    if settings.method in SOLVERS:
        task = solvers.Task(ode, made.machine, settings, given, p)
        found = solvers.record(task, x0, manner.progress)
    else:
        found = record(made.machine, settings, x0, given, p, manner.progress, made.books)
    trajectory = _trajectory(made, settings, p, signals or {}, found)
    if found.status != OK:
        observed = made.observed.ode
        why = failure.cause(observed, made.machine, settings, given, p, found)
        raise failure.RunError(why, ode.source, trajectory)
    if made.books is not None:
        said = verdict(made.books, found.t, found.xs, found.ys)
        if said is not None and said.severity == "error":
            raise failure.RunError(said, ode.source, trajectory)
        if said is not None:
            manner.tell(said)
    if found.interrupted:
        manner.tell(failure.interrupted(settings, found))
    return trajectory


def _say(remarks: Sequence[Diagnostic], manner: Manner, ode: AugmentedODE) -> None:
    grave = [remark for remark in remarks if remark.severity == "warning"]
    if manner.strict and grave:
        raise ModelError([replace(remark, severity="error") for remark in grave], ode.source)
    for remark in remarks:
        manner.tell(remark)


def _columns(ode: AugmentedODE) -> int:
    return 1 + sum(map(size, ode.states)) + sum(map(size, ode.outputs))


def _trajectory(
    made: Scene, settings: Settings, p: Vector, signals: Mapping[str, Signal], found: Record
) -> Trajectory:
    observed, ode = made.observed, made.observed.ode
    outputs, gaps = len(observed.outputs), len(observed.gaps)
    names = tuple(element_names(ode.states)[: None if made.books is None else made.books.states])
    return Trajectory(
        name=ode.name,
        t=found.t,
        x=found.xs[:, : len(names)],
        y=found.ys[:, :outputs],
        x_names=names,
        y_names=observed.outputs,
        psi=found.ys[:, outputs : outputs + gaps],
        psi_names=observed.gaps,
        modes=found.ys[:, outputs + gaps : outputs + gaps + len(observed.modes)].astype(np.int8),
        mode_names=observed.modes,
        forces=observed.forces,
        units=_units(observed),
        meta=_meta(made, settings, p, signals, found),
    )


def _units(observed: Observed) -> dict[str, str]:
    items: list[State | Output] = [*observed.ode.states, *observed.ode.outputs]
    return {
        name: item.unit for item in items if item.unit is not None for name in element_names([item])
    }


def _meta(
    made: Scene, settings: Settings, p: Vector, signals: Mapping[str, Signal], found: Record
) -> dict[str, Any]:
    """Return all that made a run; nothing in it depends on when or where it was made."""
    ode = made.observed.ode
    return {
        "generator": {"name": "nsode", "version": __version__},
        "model": {
            "name": ode.name,
            "sha256": sha256(ode.source.text.encode()).hexdigest(),
            "text": ode.source.text,
        },
        "auxiliary": element_names(ode.auxiliary),
        "parameters": dict(zip(element_names(ode.parameters), p.tolist(), strict=True)),
        "inputs": {
            name: signal if isinstance(signal, int | float) else "varying"
            for name, signal in signals.items()
        },
        "run": {
            "start": settings.start,
            "step": settings.step,
            "steps": settings.steps,
            "taken": found.taken,
            "every": settings.every,
            "method": settings.method,
            "tolerance": settings.tolerance if settings.method not in REGISTRY else None,
            "status": found.status,
            "interrupted": found.interrupted,
        },
    }
