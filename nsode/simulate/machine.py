"""What runs a model: compiled C, or CasADi's virtual machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

#: Status codes of the generated C; see its header.
OK, NOT_FINITE, SINGULAR, BROKEN = 0, 1, 2, 16


@dataclass(frozen=True, slots=True)
class Advance:
    """How far a call of :meth:`Machine.run` came: steps taken, and the status at the end."""

    done: int
    status: int


@dataclass(frozen=True, slots=True, eq=False)
class Reach:
    """What a method that chooses its own steps needs, and carries through a run.

    The end of the run in steps, relative and absolute tolerance, and the step at hand.
    """

    total: int
    tolerance: Vector
    memory: Vector


class Machine(Protocol):
    """The functions of one model. Vectors are contiguous and of the right length."""

    @property
    def nx(self) -> int:
        """The number of states."""
        ...

    @property
    def ny(self) -> int:
        """The number of outputs."""
        ...

    def initial(self, p: Vector) -> Vector:
        """Return the states at the start."""
        ...

    def rates(self, t: float, x: Vector, u: Vector, p: Vector) -> Vector:
        """Return the rates, NaN where they cannot be computed."""
        ...

    def outputs(self, t: float, x: Vector, u: Vector, p: Vector) -> Vector:
        """Return the outputs, NaN where they cannot be computed."""
        ...

    def reach(self, total: int, tolerance: Vector) -> Reach:
        """Return what a method that chooses its own steps carries through one run."""
        ...

    def run(
        self,
        clock: tuple[float, float],
        first: int,
        count: int,
        every: int,
        x: Vector,
        u: Vector,
        p: Vector,
        xs: Vector,
        ys: Vector,
        reach: Reach | None = None,
    ) -> Advance:
        """Take ``count`` steps from step ``first`` on, in place; rows go to ``xs``, ``ys``.

        ``clock`` is the start of step 0 and the size of a step; ``u`` has one row, which
        holds, or one for each step and one for the end.
        """
        ...
