"""A model in CasADi's virtual machine, for machines without a C compiler.

Some hundred times slower than C, and the conditions of the model are not checked at
every step; the numbers are the same up to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nsode.ode import AugmentedODE
from nsode.simulate.machine import NOT_FINITE, OK, Advance, Reach, Vector

if TYPE_CHECKING:
    from nsode.backends.casadi import CasadiModel

_TINY = 1e-290  # below this a state is zero, as in the C


@dataclass(frozen=True, slots=True, eq=False)
class Virtual:
    """The functions of one model as CasADi evaluates them."""

    model: CasadiModel

    @property
    def nx(self) -> int:
        """The number of states."""
        return len(self.model.x_names)

    @property
    def ny(self) -> int:
        """The number of outputs."""
        return len(self.model.y_names)

    def initial(self, p: Vector) -> Vector:
        """Return the states at the start."""
        return _flat(self.model.init(self.model.u0, self._p(p)))

    def rates(self, t: float, x: Vector, u: Vector, p: Vector) -> Vector:
        """Return the rates."""
        return _flat(self.model.rhs(t, x, self._u(u), self._p(p)))

    def outputs(self, t: float, x: Vector, u: Vector, p: Vector) -> Vector:
        """Return the outputs."""
        return _flat(self.model.out(t, x[: self.nx], self._u(u), self._p(p)))

    def reach(self, total: int, tolerance: Vector) -> Reach:
        """Refuse: the loop of a pair is C."""
        raise NotImplementedError

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
        """Take steps as the C does."""
        start, h = clock
        row, p = 0, self._p(p)
        for done in range(count):
            t = start + (first + done) * h
            after = _flat(self.model.step(t, h, x[: self.nx], self._u(u[done % len(u)]), p))
            if not np.all(np.isfinite(after)):
                return Advance(done, NOT_FINITE)
            x[: self.nx] = np.where(np.abs(after) < _TINY, 0.0, after)
            if (first + done + 1) % every == 0:
                t = start + (first + done + 1) * h
                xs[row] = x[: self.nx]
                ys[row] = self.outputs(t, x, u[(done + 1) % len(u)], p)
                row += 1
        return Advance(count, OK)

    def _u(self, u: Vector) -> Vector:
        return u[: len(self.model.u_names)]

    def _p(self, p: Vector) -> Vector:
        return p[: len(self.model.p_names)]


def virtual(ode: AugmentedODE, method: str) -> Virtual:
    """Return a model in CasADi's virtual machine.

    Raises
    ------
    ModelError
        NS603 if CasADi is not installed.
    """
    from nsode.backends.casadi import functions

    return Virtual(functions(ode, method))


def _flat(value: object) -> Vector:
    return np.asarray(value, dtype=np.float64).reshape(-1)
