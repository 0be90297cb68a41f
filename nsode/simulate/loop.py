"""The run itself: chunks of steps in C, short enough for Ctrl-C and a progress bar."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nsode.integrators.pairs import PAIRS
from nsode.simulate.guard import Books
from nsode.simulate.inputs import Inputs
from nsode.simulate.machine import OK, Machine, Vector
from nsode.simulate.settings import Settings

Progress = Callable[[int, int], None]

_BREATH = 0.05  # seconds from one return of the C to the next
_FIRST = 512  # steps before the speed is known
_MOST_INPUTS = 4_000_000  # numbers of u that are made at a time


@dataclass(frozen=True, slots=True)
class Record:
    """The rows of a run, as far as it came.

    ``taken`` counts the steps; ``status`` is that of the step that failed, 0 if none did;
    ``x`` is the last state. ``interrupted`` says that somebody pressed Ctrl-C.
    """

    t: Vector
    xs: Vector
    ys: Vector
    x: Vector
    taken: int
    status: int
    interrupted: bool
    seconds: float


def record(
    machine: Machine,
    settings: Settings,
    start: Vector,
    inputs: Inputs,
    p: Vector,
    progress: Progress | None = None,
    books: Books | None = None,
) -> Record:
    """Run from a state on and return what was stored.

    Parameters
    ----------
    start
        The states at the start.
    p
        The parameters.
    progress
        Called with the number of steps taken and that of all, some twenty times a second.
    books
        Stop at the row where they show energy from nothing.
    """
    p = p if len(p) else np.zeros(1)
    x = np.array(start) if len(start) else np.zeros(1)
    rows = settings.steps // settings.every + 1
    xs, ys = np.empty((rows, machine.nx)), np.empty((rows, machine.ny))
    xs[0] = start
    ys[0] = machine.outputs(settings.start, x, inputs.at(settings.start), p)
    taken, status, interrupted, chunk = 0, OK, False, _FIRST
    held = inputs.constant[None, :]
    reach = None
    if settings.method in PAIRS:
        reach = machine.reach(settings.steps, settings.tolerances)
    begin = before = time.perf_counter()
    try:
        while taken < settings.steps and status == OK:
            count = min(chunk, settings.steps - taken)
            u = held
            if inputs.varying:
                u = inputs.rows(instants(settings, np.arange(taken, taken + count + 1)))
            row = taken // settings.every + 1
            advance = machine.run(
                (settings.start, settings.step),
                taken, count, settings.every, x, u, p, xs[row:], ys[row:], reach,
            )  # fmt: skip
            taken, status = taken + advance.done, advance.status
            now = time.perf_counter()
            chunk = _next(count, now - before, max(1, u.shape[1] if inputs.varying else 0))
            before = now
            fresh = slice(row, taken // settings.every + 1)
            tripped = None if books is None else books.trips(xs[fresh], ys[fresh], ys[0])
            if tripped is not None:
                taken, status = (row + tripped) * settings.every, OK
                x[: len(start)] = xs[row + tripped]
                break
            if progress is not None:
                progress(taken, settings.steps)
    except KeyboardInterrupt:
        interrupted = True
    seconds = time.perf_counter() - begin
    kept = np.arange(taken // settings.every + 1) * settings.every
    xs, ys = xs[: len(kept)], ys[: len(kept)]
    if taken != kept[-1]:  # the end is a row, wherever it falls
        now = settings.start + taken * settings.step
        kept = np.append(kept, taken)
        xs = np.vstack([xs, x[: machine.nx]])
        ys = np.vstack([ys, machine.outputs(now, x, inputs.at(now), p)])
    t = instants(settings, kept)
    return Record(t, xs, ys, x[: machine.nx], taken, status, interrupted, seconds)


def instants(settings: Settings, steps: NDArray[np.int64]) -> Vector:
    """Return the times at which steps start, as the C computes them."""
    times: Vector = settings.start + steps.astype(np.float64) * settings.step
    return times


def _next(count: int, took: float, inputs: int) -> int:
    """Return how many steps to take next, to be back in time."""
    wanted = count * _BREATH / max(took, 1e-9)
    return int(max(1, min(wanted, 8 * count, _MOST_INPUTS // inputs)))
