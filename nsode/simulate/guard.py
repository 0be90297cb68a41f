"""The watch over energy: an element cannot return more than it was given.

Along a run, what an element stores equals what it was given less what it dissipated.
Where a step is too large that no longer holds, and the surplus is energy from nothing.
The books are kept by further states, integrated with the others; that takes time, so a
run keeps them only where its step is beyond half of the limit, or where that is not known
or may be another than at the start: where W varies.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nsode.diagnostics import Diagnostic
from nsode.expr import Call, Name, Number, subtract
from nsode.ode import AugmentedODE, DifferentialInclusion, Output, Rate, State, element_names, size
from nsode.simulate.machine import Vector

#: Shares of the energy moved at which a run draws a warning, and at which it stops.
WARNING, STOP = 0.01, 0.1

#: Stored energy as a share of that moved: below, an element is at rest; above, it is wrong.
_AT_REST, _BEYOND_DOUBT = 0.1, 3.0

#: What a gap may be wrong by, as a share of the largest state: elements that touch at rest
#: move that far, and what they seem to gain is rounding.
_ROUNDING = 64 * float(np.finfo(np.float64).eps)


@dataclass(frozen=True, slots=True)
class Books:
    """Where the books of a run stand: the elements, and the columns behind its own.

    Behind the states stand what each element was given less what it lost, and what it moved;
    behind the outputs, what each stores, and its stiffness.
    """

    elements: tuple[str, ...]
    states: int
    outputs: int

    def surplus(self, xs: Vector, ys: Vector, start: Vector) -> Vector:
        """Return the energy from nothing as a share of that moved, by row and element.

        ``start`` are the outputs at the start. It counts where an element is nearly at rest,
        or stores far more than it moved: as a first contact begins, the error of one step is
        large against the little that has been moved.
        """
        count = len(self.elements)
        balance = xs[:, self.states : self.states + count]
        before = start[self.outputs : self.outputs + count]
        moved = before + xs[:, self.states + count : self.states + 2 * count]
        stored = ys[:, self.outputs : self.outputs + count]
        stiffness = start[self.outputs + count : self.outputs + 2 * count]
        reach = np.abs(xs[:, : self.states]).max(axis=1, keepdims=True)
        with np.errstate(all="ignore"):
            share = (stored - before - balance) / moved
            telling = (stored < _AT_REST * moved) | (stored > _BEYOND_DOUBT * moved)
            return np.where(telling & (moved > stiffness * (_ROUNDING * reach) ** 2), share, 0.0)

    def trips(self, xs: Vector, ys: Vector, start: Vector) -> int | None:
        """Return the first row at which a run must stop."""
        rows = np.flatnonzero((self.surplus(xs, ys, start) > STOP).any(axis=1))
        return int(rows[0]) if len(rows) else None


def with_books(
    inclusion: DifferentialInclusion, ode: AugmentedODE
) -> tuple[AugmentedODE, Books] | None:
    """Return a model that keeps its books; None where no element has a ledger."""
    from nsode.analysis import ledger

    kept = ledger(ode, inclusion)
    entries = {output.name: output for output in kept.outputs[len(ode.outputs) :]}
    stored = [output for name, output in entries.items() if name.endswith(".stored")]
    if not stored:
        return None
    names = [output.name.removesuffix(".stored") for output in stored]
    given = [entries[f"{name}.given"] for name in names]
    lost = [entries[f"{name}.dissipated"] for name in names]
    rates = [
        *(
            Rate(_balance(a), subtract(a.value, b.value), a.range)
            for a, b in zip(given, lost, strict=True)
        ),
        *(Rate(_moved(a), Call("abs", (a.value,)), a.range) for a in given),
    ]
    states = [State(rate.state, Number(0.0), rate.range) for rate in rates]
    stiffness = [
        Output(f"{n}.stiffness", Name(f"{n}.K"), o.range)
        for o, n in zip(stored, names, strict=True)
    ]
    books = Books(
        tuple(element_names([replace(o, name=n) for o, n in zip(stored, names, strict=True)])),
        sum(map(size, ode.states)),
        sum(map(size, ode.outputs)),
    )
    return (
        replace(
            kept,
            states=(*ode.states, *states),
            rates=(*ode.rates, *rates),
            outputs=(*ode.outputs, *(replace(o, name=_held(o)) for o in stored), *stiffness),
        ),
        books,
    )


def verdict(books: Books, t: NDArray[np.float64], xs: Vector, ys: Vector) -> Diagnostic | None:
    """Return what is to be said of the energy of a run, an error where it was stopped."""
    surplus = books.surplus(xs, ys, ys[0])
    worst = float(surplus.max(initial=0.0))
    if worst <= WARNING:
        return None
    row, element = np.unravel_index(int(np.argmax(surplus)), surplus.shape)
    stopped = worst > STOP
    found = f"`{books.elements[element]}` has returned more energy than it was given"
    limit = f"a run stops at {100 * STOP:g} %" if stopped else f"it stops at {100 * STOP:g} %"
    return Diagnostic(
        "NS506",
        f"{found}: {100 * worst:.2g} % of the energy moved by t = {t[row]:.6g} s",
        notes=(limit, f"{len(t):,} rows up to there are kept") if stopped else (limit,),
        help="choose a smaller step; --no-guard goes on" if stopped else "choose a smaller step",
        severity="error" if stopped else "warning",
    )


def _balance(output: Output) -> str:
    return output.name.replace(".given", ".balance")


def _held(output: Output) -> str:
    """Return another name than that of a ledger which the model may have."""
    return output.name.replace(".stored", ".held")


def _moved(output: Output) -> str:
    return output.name.replace(".given", ".moved")
