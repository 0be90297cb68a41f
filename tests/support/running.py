"""Values with their running term scale: how large the numbers were that made them.

Wilkinson's running error analysis: each operation adds the magnitude of its result and
passes on the scales of its arguments through its slopes. Two ways of rounding one
formula differ by some eps times this scale, whatever the cancellation.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nsode.evaluate import apply, position
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import AugmentedODE, Binding, LinearSolve, Output, Placed, Rate, layout, size

_FOUR_EPS = 4 * np.finfo(float).eps


class Running(NamedTuple):
    """A value and its term scale."""

    value: float
    scale: float


def _exact(value: float) -> Running:
    return Running(value, abs(value))


@dataclass
class Tracer:
    """Evaluates an ODE at one point, term scales included."""

    ode: AugmentedODE
    t: float
    x: Sequence[float]
    u: Sequence[float]
    p: Sequence[float]

    def __post_init__(self) -> None:
        self.known: dict[tuple[str, int | None], Running] = {("t", None): _exact(self.t)}
        for items, vector in (
            (self.ode.states, self.x),
            (self.ode.inputs, self.u),
            (self.ode.parameters, self.p),
        ):
            for name, (offset, over) in layout(items).items():
                if over is None:
                    self.known[name, None] = _exact(float(vector[offset]))
                else:
                    for k in range(len(over)):
                        self.known[name, over.first + k] = _exact(float(vector[offset + k]))
        for item in self.ode.bindings:
            self._define(item)

    def rhs(self) -> tuple[NDArray, NDArray]:
        """Return the rates and their scales."""
        return self._column(self.ode.states, [(r.state, r) for r in self.ode.rates])

    def out(self) -> tuple[NDArray, NDArray]:
        """Return the outputs and their scales."""
        return self._column(self.ode.outputs, [(y.name, y) for y in self.ode.outputs])

    def _column(
        self, places: Sequence[Placed], items: Sequence[tuple[str, Rate | Output]]
    ) -> tuple[NDArray, NDArray]:
        slots = layout(places)
        found = [Running(np.nan, np.nan)] * sum(map(size, places))
        for name, item in items:
            offset, whole = slots[name]
            for k in _indices(item):
                place = offset if whole is None or k is None else offset + k - whole.first
                found[place] = self.expr(item.value, _at(item, k))
        return np.array([r.value for r in found]), np.array([r.scale for r in found])

    def _define(self, item: Binding | LinearSolve) -> None:
        for k in _indices(item):
            at = _at(item, k)
            match item:
                case Binding(name, value):
                    self.known[name, k] = self.expr(value, at)
                case LinearSolve(unknowns, matrix, right):
                    rows = [[self.expr(entry, at) for entry in row] for row in matrix]
                    sides = [self.expr(entry, at) for entry in right]
                    for name, value in zip(unknowns, _solve(rows, sides), strict=True):
                        self.known[name, k] = value

    def expr(self, expr: Expr, at: Mapping[str, int]) -> Running:
        """Return the value and scale of an expression."""
        match expr:
            case Number(value):
                return _exact(value)
            case Index():
                return _exact(float(position(expr, at)))
            case Name(id, subscript):
                return self.known[id, None if subscript is None else position(subscript, at)]
            case If(condition, then, otherwise):
                test = self.expr(condition, at)
                chosen = self.expr(then if test.value else otherwise, at)
                return chosen if np.isfinite(test.scale) else Running(chosen.value, np.inf)
            case Sum(IndexRange(variable=variable, first=first, last=last), body):
                terms = [self.expr(body, {**at, variable: k}) for k in range(first, last + 1)]
                scale = len(terms) * sum(term.scale for term in terms)
                return Running(sum(term.value for term in terms), scale)
            case Call("mod", (a, b)):
                return _mod(self.expr(a, at), self.expr(b, at))
            case Call(function, args):
                return _call(function, [self.expr(arg, at) for arg in args])
        raise NotImplementedError(type(expr).__name__)


def _indices(item: object) -> Sequence[int | None]:
    over = getattr(item, "range", None)
    return [None] if over is None else range(over.first, over.last + 1)


def _at(item: object, k: int | None) -> dict[str, int]:
    over = getattr(item, "range", None)
    return {} if over is None or k is None else {over.variable: k}


def _call(function: str, args: list[Running]) -> Running:
    values = [a.value for a in args]
    value = _ieee(function, values)
    if function == "atan2" and values[1] < 0 and abs(values[0]) <= _FOUR_EPS * args[0].scale:
        return Running(value, np.inf)  # rounding, or the sign of a zero, decides between turns
    try:
        slopes = _slopes(function, values, value)
    except (OverflowError, ValueError, ZeroDivisionError):
        return Running(value, np.inf)  # at a pole nothing is known
    passed = sum(slope * a.scale for slope, a in zip(slopes, args, strict=True))
    return Running(value, abs(value) + passed)


def _mod(a: Running, b: Running) -> Running:
    value = _ieee("mod", [a.value, b.value])
    quotient = apply("/", a.value, b.value)
    if not np.isfinite(quotient):
        return Running(value, np.inf)
    # Where rounding decides between two turns, the value may be 0 or b.
    blur = (a.scale + abs(quotient) * b.scale) / abs(b.value) + abs(quotient)
    if abs(quotient - round(quotient)) <= _FOUR_EPS * blur:
        return Running(value, np.inf)
    return Running(value, abs(value) + a.scale + (abs(quotient) + 1) * b.scale)


def _ieee(function: str, values: list[float]) -> float:
    with np.errstate(all="ignore"):
        match function:
            case "^":
                return float(np.float64(values[0]) ** values[1])
            case "sinh":
                return float(np.sinh(values[0]))
            case "mod":
                return float(np.mod(*values))
    return apply(function, *values)


def _slopes(function: str, v: list[float], value: float) -> list[float]:
    """Return the magnitude of the derivative by each argument (a bound where it has kinks)."""
    match function:
        case "*":
            return [abs(v[1]), abs(v[0])]
        case "/":
            return [1 / abs(v[1]), abs(value / v[1])]
        case "^":
            return [abs(v[1] * apply("^", v[0], v[1] - 1)), 0.0]
        case "shrink":
            return [0.0, 0.0] if v[1] <= v[0] else [1 / v[1], v[0] / v[1] ** 2]
        case "sqrt":
            return [0.5 / value]
        case "log":
            return [1 / v[0]]
        case "exp":
            return [value]
        case "tan":
            return [1 + value**2]
        case "cosh" | "sinh":
            return [math.cosh(v[0])]
        case "atan2":
            return [1 / math.hypot(*v)] * 2
        case _:
            return [1.0] * len(v)


def _solve(rows: list[list[Running]], sides: list[Running]) -> list[Running]:
    """Return the unknowns with their scales, which the condition number enlarges."""
    matrix = np.array([[entry.value for entry in row] for row in rows])
    right = np.array([side.value for side in sides])
    solution = np.linalg.solve(matrix, right)
    inverse = np.abs(np.linalg.inv(matrix))
    error = np.array([[entry.scale for entry in row] for row in rows]) @ np.abs(solution)
    error += np.array([side.scale for side in sides])
    scales = np.abs(solution) + 2 * inverse @ error
    return [Running(v, s) for v, s in zip(solution, scales, strict=True)]
