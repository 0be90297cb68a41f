"""From an augmented ODE to compiled C that a test can call: emit, compile, load."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nsode.backends import Options, emit
from nsode.ode import AugmentedODE, element_names, size

#: As strict as C comes. `-ffp-contract=off` keeps gcc and clang bit-equal.
WARNINGS = (
    "-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Wdouble-promotion",
    "-pedantic", "-Werror",
)  # fmt: skip
FLAGS = ("-O1", "-ffp-contract=off")

Real = Literal["double", "float"]
DTYPES: dict[str, np.dtype] = {"double": np.dtype(np.float64), "float": np.dtype(np.float32)}


class StatusError(Exception):
    """A generated function returned something other than 0."""

    def __init__(self, function: str, status: int) -> None:
        super().__init__(f"{function} returned {status}")
        self.status = status


def have(tool: str) -> bool:
    """Whether a program is installed."""
    return shutil.which(tool) is not None


@dataclass(frozen=True)
class Native:
    """The loaded C of one model; arrays in, arrays out, parameters `p0` unless given."""

    ode: AugmentedODE
    prefix: str
    folder: Path
    library: ctypes.CDLL
    dtype: np.dtype

    @property
    def p0(self) -> NDArray:
        count = sum(map(size, self.ode.parameters))
        scalar = np.ctypeslib.as_ctypes_type(self.dtype)
        table = (scalar * max(1, count)).in_dll(self.library, f"{self.prefix}_p0")
        return np.array(table, dtype=self.dtype)[:count]

    @property
    def x_names(self) -> list[str]:
        return element_names(self.ode.states)

    @property
    def y_names(self) -> list[str]:
        return element_names(self.ode.outputs)

    def init(self, p: ArrayLike | None = None) -> NDArray:
        x = self._empty(self.ode.states)
        self._call("init", self._array(self._p(p)), x)
        return x[: len(self.x_names)]

    def rhs(
        self, t: float, x: ArrayLike, u: ArrayLike | None = None, p: ArrayLike | None = None
    ) -> NDArray:
        dx = self._empty(self.ode.states)
        self._call("rhs", t, *map(self._array, (x, self._u(u), self._p(p))), dx)
        return dx[: len(self.x_names)]

    def out(
        self, t: float, x: ArrayLike, u: ArrayLike | None = None, p: ArrayLike | None = None
    ) -> NDArray:
        y = self._empty(self.ode.outputs)
        self._call("out", t, *map(self._array, (x, self._u(u), self._p(p))), y)
        return y[: len(self.y_names)]

    def step(
        self,
        t: float,
        h: float,
        x: ArrayLike,
        u: ArrayLike | None = None,
        p: ArrayLike | None = None,
        *,
        method: str = "rk4",
    ) -> NDArray:
        """Return the state one step later."""
        after = self._array(x).copy()
        self._call(f"step_{method}", t, h, after, self._array(self._u(u)), self._array(self._p(p)))
        return after[: len(self.x_names)]

    def run(
        self,
        steps: int,
        h: float,
        x: ArrayLike | None = None,
        u: ArrayLike | None = None,
        p: ArrayLike | None = None,
        *,
        method: str = "rk4",
        t0: float = 0.0,
    ) -> NDArray:
        """Return the states at t0, t0 + h, ... as rows."""
        rows = [self.init(p) if x is None else np.array(x, self.dtype)]
        for k in range(steps):
            rows.append(self.step(t0 + k * h, h, rows[-1], u, p, method=method))
        return np.array(rows)

    def _u(self, u: ArrayLike | None) -> ArrayLike:
        if u is not None:
            return u
        defaults = [
            float("nan") if i.default is None else i.default
            for i in self.ode.inputs
            for _ in range(size(i))
        ]
        return np.array(defaults, self.dtype)

    def _p(self, p: ArrayLike | None) -> ArrayLike:
        return self.p0 if p is None else p

    def _array(self, values: ArrayLike) -> NDArray:
        array = np.ascontiguousarray(values, dtype=self.dtype)
        return array if array.size else np.zeros(1, self.dtype)

    def _empty(self, items: Sequence) -> NDArray:
        return np.full(max(1, sum(map(size, items))), np.nan, self.dtype)

    def _call(self, function: str, *arguments: float | NDArray) -> None:
        scalar = np.ctypeslib.as_ctypes_type(self.dtype)
        converted = [
            a.ctypes.data_as(ctypes.c_void_p) if isinstance(a, np.ndarray) else scalar(a)
            for a in arguments
        ]
        status = getattr(self.library, f"{self.prefix}_{function}")(*converted)
        if status != 0:
            raise StatusError(function, status)


def run_tool(command: Sequence[str | Path], **options: object) -> subprocess.CompletedProcess[str]:
    """Run a program; a failure shows what it printed."""
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    if result.returncode != 0:
        shown = " ".join(str(c) for c in command)
        raise AssertionError(
            f"{shown}\nreturned {result.returncode}\n{result.stdout}{result.stderr}"
        )
    return result


def write_files(files: dict[str, str], folder: Path) -> list[Path]:
    """Write emitted files as they are."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / name for name in files]
    for path, text in zip(paths, files.values(), strict=True):
        path.write_text(text, encoding="utf-8")
    return paths


def build(
    ode: AugmentedODE,
    folder: Path,
    *,
    real: Real = "double",
    cc: str = "gcc",
    flags: Sequence[str] = FLAGS,
    prefix: str | None = None,
) -> Native:
    """Emit C into ``folder``, compile it there without a warning and load it."""
    files = emit("c", ode, Options(prefix=prefix, real=real))
    sources = [p for p in write_files(files, folder) if p.suffix == ".c"]
    library = folder / "model.so"
    strict = WARNINGS if cc in {"gcc", "clang"} else ()
    run_tool([cc, *strict, *flags, "-fPIC", "-shared", "-o", library, *sources, "-lm"])
    return Native(ode, prefix or ode.name, folder, ctypes.CDLL(str(library)), DTYPES[real])


def build_all(
    odes: Sequence[AugmentedODE], folder: Path, *, cc: str = "gcc", flags: Sequence[str] = FLAGS
) -> list[Native]:
    """Compile many ODEs into one library, each under a prefix of its own: m0, m1 and so on."""
    prefixes = [f"m{k}" for k in range(len(odes))]
    for ode, prefix in zip(odes, prefixes, strict=True):
        write_files(emit("c", ode, Options(prefix=prefix)), folder)
    library = folder / "models.so"
    sources = [folder / f"{prefix}.c" for prefix in prefixes]
    run_tool([cc, "-std=c99", *flags, "-fPIC", "-shared", "-o", library, *sources, "-lm"])
    loaded = ctypes.CDLL(str(library))
    return [
        Native(ode, prefix, folder, loaded, DTYPES["double"])
        for ode, prefix in zip(odes, prefixes, strict=True)
    ]
