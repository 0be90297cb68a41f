"""The values of all names of a system at one point, and Jacobians there."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from nsode.derivative import Entry, pattern
from nsode.evaluate import evaluate
from nsode.expr import TIME, Expr, IndexRange
from nsode.ode import Binding, Definition, LinearSolve, Parameter, SetValuedTerm, Slot, System, size

Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]


@dataclass(slots=True)
class Point:
    """The value of each name; a family has one for each index of its range."""

    values: dict[str, list[float]] = field(default_factory=dict)
    first: dict[str, int] = field(default_factory=dict)

    def lookup(self, name: str, at: int | None) -> float:
        """Return the value of a name, as :func:`nsode.evaluate.evaluate` asks for it."""
        place = 0 if at is None else at - self.first[name]
        values = self.values[name]
        if not 0 <= place < len(values):
            raise IndexError(f"`{name}` has no element {at}")
        return values[place]

    def set(self, name: str, span: IndexRange | None, values: Sequence[float]) -> None:
        """Give a name its value, or a family those of its range."""
        self.values[name] = list(values)
        self.first[name] = span.first if span else 0

    def value(self, expr: Expr, span: IndexRange | None = None) -> list[float]:
        """Return the value of an expression at each index of a range."""
        if span is None:
            return [evaluate(expr, self.lookup)]
        indices = range(span.first, span.last + 1)
        return [evaluate(expr, self.lookup, {span.variable: k}) for k in indices]

    def define(self, definitions: Iterable[Definition]) -> None:
        """Compute definitions in order; multipliers that are not set are 0."""
        for item in definitions:
            match item:
                case Binding(name, value, span):
                    self.set(name, span, self.value(value, span))
                case LinearSolve():
                    self._solve(item)
                case SetValuedTerm(multiplier=multiplier, range=span):
                    for name in multiplier:
                        if name not in self.values:
                            self.set(name, span, [0.0] * size(_Item(name, span)))

    def _solve(self, solve: LinearSolve) -> None:
        rows = [[self.value(a, solve.range) for a in row] for row in solve.matrix]
        right = [self.value(b, solve.range) for b in solve.right]
        matrices = np.moveaxis(np.array(rows), 2, 0)
        solutions = _solved(matrices, np.array(right).T)
        for unknown, values in zip(solve.unknowns, solutions.T, strict=True):
            self.set(unknown, solve.range, values.tolist())


def _solved(matrices: NDArray[np.float64], right: Matrix) -> Matrix:
    """Return the solutions, NaN where a matrix is singular."""
    try:
        found = np.linalg.solve(matrices, right[:, :, None])[:, :, 0]
    except np.linalg.LinAlgError:
        return np.full(right.shape, np.nan)
    return np.asarray(found, dtype=np.float64)


@dataclass(frozen=True, slots=True)
class _Item:
    name: str
    range: IndexRange | None


def parameters(system: System, constants: Iterable[Parameter] = ()) -> Point:
    """Return a point that knows the time 0, the parameters and the inputs' defaults.

    ``constants`` are those of the approximation, where the system does not hold them.
    """
    point = Point()
    point.set(TIME, None, [0.0])
    for item in (*system.parameters, *constants):
        point.set(item.name, item.range, item.values)
    for entry in system.inputs:
        value = 0.0 if entry.default is None else entry.default
        point.set(entry.name, entry.range, [value] * size(entry))
    return point


def start(system: System, constants: Iterable[Parameter] = ()) -> Point:
    """Return the point where a run starts; what reads the bindings starts last."""
    point = parameters(system, constants)
    late = []
    for state in system.states:
        try:
            point.set(state.name, state.range, point.value(state.initial, state.range))
        except KeyError:
            late.append(state)
            point.set(state.name, state.range, [0.0] * size(state))
    point.define(system.bindings)
    for state in late:
        point.set(state.name, state.range, point.value(state.initial, state.range))
    if late:
        point.define(system.bindings)
    return point


def assemble(
    entries: Sequence[Entry], point: Point, rows: dict[str, Slot], columns: dict[str, Slot]
) -> Matrix:
    """Return the entries as a matrix, where ``point`` knows all that they read."""
    places = pattern(entries, rows, columns)
    flat = np.zeros(len(places.rows))
    for entry, spots in zip(entries, places.places, strict=True):
        for spot, value in zip(spots, _values(entry, point), strict=True):
            if spot >= 0:
                flat[spot] += value
    height = max((slot.offset + _length(slot) for slot in rows.values()), default=0)
    matrix = np.zeros((height, len(places.columns) - 1))
    for column in range(len(places.columns) - 1):
        for place in range(places.columns[column], places.columns[column + 1]):
            matrix[places.rows[place], column] = flat[place]
    return matrix


def _values(entry: Entry, point: Point) -> Vector:
    """Return the value of an entry for each combination of its ranges."""
    found: list[float] = []

    def descend(level: int, at: dict[str, int]) -> None:
        if level == len(entry.ranges):
            found.append(evaluate(entry.value, point.lookup, at))
            return
        variable, first, last = entry.ranges[level]
        for k in range(first, last + 1):
            descend(level + 1, {**at, variable: k})

    descend(0, {})
    return np.asarray(found, dtype=np.float64)


def _length(slot: Slot) -> int:
    return 1 if slot.range is None else len(slot.range)
