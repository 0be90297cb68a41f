"""Runs by the integrators of other libraries: CVODES through CasADi, and SciPy's.

They choose their own steps; rows and inputs lie on the grid of the run all the same.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nsode.ode import AugmentedODE
from nsode.simulate.inputs import Inputs
from nsode.simulate.loop import Progress, Record, instants
from nsode.simulate.machine import NOT_FINITE, OK, Machine, Vector
from nsode.simulate.settings import Settings

_BLOCK = 1000  # rows from one call of CVODES to the next
_CVODES = {
    "max_num_steps": 20_000,
    "show_eval_warnings": False,
    "disable_internal_warnings": True,
}


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """What a run is made of: the model, its settings, inputs and parameters."""

    ode: AugmentedODE
    machine: Machine
    settings: Settings
    inputs: Inputs
    p: Vector

    def grid(self) -> NDArray[np.int64]:
        """Return the steps after which a row is stored, or an input changes."""
        every = 1 if self.inputs.varying else self.settings.every
        inner = np.arange(0, self.settings.steps, every)
        return np.append(inner, self.settings.steps)


#: A step of the grid and the state after it, in order.
States = Iterator[tuple[int, Vector]]


class GaveUpError(Exception):
    """A solver cannot go on from the last state that it gave."""


def record(task: Task, start: Vector, progress: Progress | None = None) -> Record:
    """Run by the method of the settings and return what was stored."""
    settings = task.settings
    walk = _cvodes if settings.method == "cvodes" else _scipy
    kept, xs = [0], [np.array(start)]
    taken, x, status, interrupted = 0, np.array(start), OK, False
    begin = time.perf_counter()
    try:
        for taken, x in walk(task, start):
            if taken % settings.every == 0 or taken == settings.steps:
                kept.append(taken)
                xs.append(x)
            if progress is not None:
                progress(taken, settings.steps)
    except GaveUpError:
        status = NOT_FINITE
    except KeyboardInterrupt:
        interrupted = True
    seconds = time.perf_counter() - begin
    t = instants(settings, np.array(kept))
    ys = [
        task.machine.outputs(now, row, task.inputs.at(now), task.p)
        for now, row in zip(t.tolist(), xs, strict=True)
    ]
    return Record(t, np.array(xs), np.array(ys), x, taken, status, interrupted, seconds)


def _scipy(task: Task, x: Vector) -> States:
    from scipy import integrate

    method = getattr(integrate, task.settings.method)
    grid = task.grid()
    if not task.inputs.varying:
        yield from _stretch(method, task, grid, x)
        return
    for pair in np.lib.stride_tricks.sliding_window_view(grid, 2):
        for step, after in _stretch(method, task, pair, x):
            x = after
            yield step, x


def _stretch(method: Any, task: Task, grid: NDArray[np.int64], x: Vector) -> States:  # noqa: ANN401
    """Yield the states on a stretch of the grid over which the inputs hold."""
    times = instants(task.settings, grid)
    u = task.inputs.at(float(times[0]))
    relative, absolute = task.settings.tolerances

    def rates(t: float, x: Vector) -> Vector:
        return task.machine.rates(t, np.ascontiguousarray(x), u, task.p)

    solver = method(rates, times[0], x, times[-1], rtol=max(relative, 3e-14), atol=absolute)
    place = 1
    while place < len(grid):
        with np.errstate(all="ignore"):
            solver.step()
        if solver.status == "failed" or not np.all(np.isfinite(solver.y)):
            raise GaveUpError
        inside = solver.dense_output()
        while place < len(grid) and times[place] <= solver.t:
            reached = solver.y if times[place] == solver.t else inside(times[place])
            yield int(grid[place]), np.array(reached)
            place += 1


def _cvodes(task: Task, x: Vector) -> States:
    from nsode.backends.casadi import functions

    dae = functions(task.ode).dae()
    grid = task.grid()
    blocks = [grid[first : first + _BLOCK + 1] for first in range(0, len(grid) - 1, _BLOCK)]
    while blocks:
        steps = blocks.pop(0)
        found = _solved(task, dae, steps, x)
        if found is None and len(steps) == 2:
            raise GaveUpError
        if found is None:  # find out how far it comes
            middle = len(steps) // 2
            blocks[:0] = [steps[: middle + 1], steps[middle:]]
            continue
        for step, after in zip(steps[1:].tolist(), found, strict=True):
            x = np.array(after)
            yield step, x


def _solved(task: Task, dae: dict[str, Any], steps: NDArray[np.int64], x: Vector) -> Vector | None:
    """Return a row for each step behind the first; None where CVODES cannot get there."""
    import casadi as ca

    relative, absolute = task.settings.tolerances
    options = {"reltol": relative, "abstol": absolute, **_CVODES}
    times = instants(task.settings, steps)
    solver = ca.integrator("run", "cvodes", dae, times[0], times[1:].tolist(), options)
    inputs = {}
    if "u" in dae:
        held = task.inputs.rows(times[:-1])
        inputs = {"u": held[:, : dae["u"].numel()].T}
    try:
        found = np.asarray(solver(x0=x, p=task.p, **inputs)["xf"], dtype=np.float64)
    except RuntimeError:
        return None
    return found.T if np.all(np.isfinite(found)) else None
