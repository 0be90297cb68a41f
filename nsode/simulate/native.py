"""A compiled model in this process, called through ctypes, which releases the lock."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, c_double, c_longlong
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nsode.ode import AugmentedODE, size
from nsode.simulate.build import PREFIX
from nsode.simulate.machine import Advance, Reach, Vector

_reals = POINTER(c_double)


@dataclass(frozen=True, slots=True, eq=False)
class Native:
    """The compiled functions of one model. Vectors are contiguous and of the right length."""

    handle: ctypes.CDLL
    nx: int
    ny: int
    path: Path

    def initial(self, p: Vector) -> Vector:
        """Return the states at the start."""
        x = np.zeros(max(1, self.nx))
        self._function("init")(_pointer(p), _pointer(x))
        return x[: self.nx]

    def rates(self, t: float, x: Vector, u: Vector, p: Vector) -> Vector:
        """Return the rates, NaN where they cannot be computed."""
        dx = np.full(max(1, self.nx), np.nan)
        self._function("rhs")(c_double(t), _pointer(x), _pointer(u), _pointer(p), _pointer(dx))
        return dx[: self.nx]

    def outputs(self, t: float, x: Vector, u: Vector, p: Vector) -> Vector:
        """Return the outputs, NaN where they cannot be computed."""
        y = np.full(max(1, self.ny), np.nan)
        self._function("out")(c_double(t), _pointer(x), _pointer(u), _pointer(p), _pointer(y))
        return y[: self.ny]

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
        holds, or one for each step and one for the end; ``reach`` is what a method that
        chooses its own steps needs.
        """
        done = c_longlong()
        stride = u.shape[1] if len(u) > 1 else 0
        start, step = clock
        status = self._function("run")(
            c_double(start), c_double(step),
            c_longlong(first), c_longlong(count), c_longlong(every),
            _pointer(x), _pointer(u), c_longlong(stride), _pointer(p),
            _pointer(xs), _pointer(ys), ctypes.byref(done),
            *_arguments(reach),
        )  # fmt: skip
        return Advance(done.value, status)

    def reach(self, total: int, tolerance: Vector) -> Reach:
        """Return what a method that chooses its own steps carries through one run."""
        length = c_longlong.in_dll(self.handle, f"{PREFIX}_step_size").value
        return Reach(total, tolerance, np.zeros(length // 8 + 1))

    def _function(self, name: str) -> ctypes._FuncPointer:
        function: ctypes._FuncPointer = getattr(self.handle, f"{PREFIX}_{name}")
        return function


def _arguments(reach: Reach | None) -> tuple[object, ...]:
    if reach is None:
        return ()
    memory = reach.memory.ctypes.data_as(ctypes.c_void_p)
    return c_longlong(reach.total), _pointer(reach.tolerance), memory


def _pointer(array: Vector) -> ctypes._Pointer[c_double]:
    return array.ctypes.data_as(_reals)


def load(ode: AugmentedODE, path: Path) -> Native:
    """Return the functions in the library of a model."""
    handle = ctypes.CDLL(str(path))
    return Native(handle, sum(map(size, ode.states)), sum(map(size, ode.outputs)), path)
