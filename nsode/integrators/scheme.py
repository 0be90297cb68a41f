"""What the methods have in common, and the explicit Runge-Kutta tableau."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol


class Scheme(Protocol):
    """A method that advances a state by one step.

    The class of a scheme tells a backend how to write it (a tableau, a splitting, an
    embedded pair); this is what everybody else asks for.
    """

    @property
    def name(self) -> str:
        """The name by which a model and a command choose the method."""
        ...

    @property
    def title(self) -> str:
        """What a person calls it."""
        ...

    @property
    def order(self) -> int:
        """The power of the step in the error of a smooth run."""
        ...

    def stability(self, z: complex) -> complex:
        """Return the factor by which a step multiplies a mode with ``z = h*lambda``."""
        ...


Row = tuple[Fraction, ...]


@dataclass(frozen=True, slots=True)
class RungeKutta:
    """An explicit Runge-Kutta method by its Butcher tableau.

    Row ``i`` of ``a`` holds the weights of the stages before stage ``i``.
    """

    name: str
    title: str
    order: int
    a: tuple[Row, ...]
    b: Row
    c: Row

    def __post_init__(self) -> None:
        stages = len(self.b)
        if len(self.c) != stages or [len(row) for row in self.a] != list(range(stages)):
            raise ValueError(f"the tableau of `{self.name}` is not explicit")
        if any(sum(row) != node for row, node in zip(self.a, self.c, strict=True)):
            raise ValueError(f"a row of the tableau of `{self.name}` does not sum to its node")

    @property
    def stages(self) -> int:
        """How often a step calls the right-hand side."""
        return len(self.b)

    @property
    def stability_polynomial(self) -> Row:
        """The coefficients of R(z), constant first: ``1 + sum_k z^(k+1) b A^k 1``."""
        coefficients = [Fraction(1)]
        column = [Fraction(1)] * self.stages
        for _ in range(self.stages):
            coefficients.append(_dot(self.b, column))
            column = [_dot(row, column) for row in self.a]
        return tuple(coefficients)

    def stability(self, z: complex) -> complex:
        """Return R(z) for ``z = h*lambda``."""
        value = 0j
        for coefficient in reversed(self.stability_polynomial):
            value = value * z + float(coefficient)
        return value


def _dot(row: Row, column: list[Fraction]) -> Fraction:
    return sum((w * v for w, v in zip(row, column, strict=False)), Fraction(0))


def register(*schemes: Scheme) -> dict[str, Scheme]:
    """Return schemes by name.

    Raises
    ------
    ValueError
        If two share a name.
    """
    table = {scheme.name: scheme for scheme in schemes}
    if len(table) != len(schemes):
        raise ValueError("two methods share a name")
    return table
