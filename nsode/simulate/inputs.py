"""What enters a run from outside: constants, recorded data, functions of time.

A value is read at the start of each step and held over it; between the samples of
recorded data it is interpolated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nsode.diagnostics import Diagnostic, ModelError, quoted, suggest
from nsode.files import open_regular
from nsode.ode import AugmentedODE, element_names, size
from nsode.simulate.settings import Settings

Vector = NDArray[np.float64]

#: A number; recorded times and values; or a function of an array of times.
Signal = float | tuple[ArrayLike, ArrayLike] | Callable[[Vector], ArrayLike]


@dataclass(frozen=True, slots=True)
class Inputs:
    """The inputs of one run: a value for each place of u, and what varies with time."""

    constant: Vector
    varying: tuple[tuple[int, Callable[[Vector], Vector]], ...]

    def rows(self, times: Vector) -> Vector:
        """Return u at some times, one row each."""
        rows = np.tile(self.constant, (len(times), 1))
        for place, signal in self.varying:
            rows[:, place] = signal(times)
        return rows

    def at(self, time: float) -> Vector:
        """Return u at one time."""
        row: Vector = self.rows(np.array([time]))[0]
        return row


def inputs(ode: AugmentedODE, given: Mapping[str, Signal], settings: Settings) -> Inputs:
    """Return the inputs of a run.

    Raises
    ------
    ModelError
        NS101 for an unknown input, NS503 for one without a value, NS508 for data that
        cannot be used.
    """
    names = element_names(ode.inputs)
    defaults = [item.default for item in ode.inputs for _ in range(size(item))]
    given = _spread(names, given)
    for name in given:
        if name not in names:
            message, way_out = f"there is no input `{name}`", suggest(name, names)
            notes = (f"the inputs are {quoted(names)}" if names else "the model has no input",)
            raise ModelError([Diagnostic("NS101", message, notes=notes, help=way_out)])
    pairs = zip(names, defaults, strict=True)
    lacking = [name for name, value in pairs if value is None and name not in given]
    if lacking:
        flags = " ".join(f"-u {name}=data.csv" for name in lacking)
        listed = quoted(lacking)
        way_out = f"give {flags} (or a number), or declare a default: `input {lacking[0]} = 0`"
        raise ModelError([Diagnostic("NS503", f"no value for the input {listed}", help=way_out)])
    constant = np.zeros(max(1, len(names)))
    varying = []
    for place, (name, default) in enumerate(zip(names, defaults, strict=True)):
        signal = given.get(name, default)
        if isinstance(signal, int | float):
            constant[place] = _finite(name, signal)
        elif callable(signal):
            varying.append((place, _sampled(name, signal)))
        elif signal is not None:
            varying.append((place, _recorded(name, signal, settings)))
    return Inputs(constant, tuple(varying))


def _spread(names: Sequence[str], given: Mapping[str, Signal]) -> dict[str, Signal]:
    """Return a signal for each component where one was given for a whole vector or family."""
    found: dict[str, Signal] = {}
    for name, signal in given.items():
        parts = [known for known in names if known.startswith((f"{name}.", f"{name}["))]
        found |= dict.fromkeys(parts or [name], signal)
    return found | {name: signal for name, signal in given.items() if name in names}


def read(path: Path, name: str) -> tuple[Vector, Vector]:
    """Return recorded times and values from a CSV file.

    Times stand in the first column. With a head, the values are the column of that name;
    without one, the file has two columns.

    Raises
    ------
    ModelError
        NS601 if the file cannot be read, NS508 if it does not hold the data.
    """
    try:
        with open_regular(path) as file:
            lines = file.read().decode("utf-8-sig").splitlines()
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise ModelError([Diagnostic("NS601", f"cannot read `{path}`: {reason}")]) from error
    except UnicodeDecodeError as error:
        raise _no_table(path, "it is not UTF-8") from error
    if not lines:
        raise _no_table(path, "it is empty")
    first = _cells(lines[0])
    headed = not all(map(_is_number, first))
    column = _column(path, name, first, headed)
    if not any(map(str.strip, lines[headed:])):
        raise _no_table(path, "no row stands below its head")
    try:
        table = np.loadtxt(
            lines[headed:], delimiter=",", usecols=(0, column), ndmin=2, comments=None
        )
    except ValueError as error:
        raise _no_table(path, _fault(lines, headed, column)) from error
    return table[:, 0], table[:, 1]


def _no_table(path: Path, why: str) -> ModelError:
    return ModelError([Diagnostic("NS508", f"`{path}` is no table of numbers: {why}")])


def _cells(line: str) -> list[str]:
    return [cell.strip().strip('"') for cell in line.split(",")]


def _fault(lines: Sequence[str], headed: bool, column: int) -> str:
    """Return what is wrong with the first row that holds no time and value."""
    for number, line in enumerate(lines, start=1):
        cells = _cells(line)
        if (number == 1 and headed) or not line.strip():
            continue
        if len(cells) <= column:
            return f"line {number} ends before column {column + 1}"
        for cell in (cells[0], cells[column]):
            if not _is_number(cell) or "_" in cell:
                return f"`{cell[:20]}` in line {number} is no number"
    return "its rows differ"


def _column(path: Path, name: str, first: list[str], headed: bool) -> int:
    if headed and name in first[1:]:
        return first.index(name, 1)
    if len(first) == 2:
        return 1
    columns = "1 column" if len(first) == 1 else f"{len(first)} columns"
    found = quoted(first[1:9]) if headed and len(first) > 1 else columns
    way_out = "the first line names the columns: `t,fe`; times stand in the first"
    message = f"`{path}` has no column `{name}`"
    raise ModelError([Diagnostic("NS508", message, notes=(f"it has {found}",), help=way_out)])


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _finite(name: str, value: float) -> float:
    if not np.isfinite(value):
        raise _unusable(name, f"is {value:g}")
    return float(value)


def _sampled(name: str, signal: Callable[[Vector], ArrayLike]) -> Callable[[Vector], Vector]:
    def sample(times: Vector) -> Vector:
        values = np.broadcast_to(np.asarray(signal(times), dtype=np.float64), times.shape)
        if not np.all(np.isfinite(values)):
            bad = times[~np.isfinite(values)][0]
            raise _unusable(name, f"is not finite at {bad:g} s")
        return values

    return sample


def _recorded(
    name: str, signal: tuple[ArrayLike, ArrayLike], settings: Settings
) -> Callable[[Vector], Vector]:
    try:
        times, values = (np.asarray(part, dtype=np.float64) for part in signal)
    except (TypeError, ValueError):
        raise _unusable(name, "are no number, no times and values, and no function") from None
    if times.ndim != 1 or times.shape != values.shape or not len(times):
        raise _unusable(name, "wants as many times as values, one or more")
    if not (np.all(np.isfinite(times)) and np.all(np.isfinite(values))):
        raise _unusable(name, "holds a number that is not finite")
    if np.any(np.diff(times) <= 0):
        place = int(np.argmax(np.diff(times) <= 0))
        raise _unusable(name, f"goes back in time after {times[place]:g} s")
    slack = 1e-9 * settings.step
    last = settings.start + (settings.steps - 1) * settings.step
    if times[0] > settings.start + slack or times[-1] < last - slack:
        covered = f"covers {times[0]:g} to {times[-1]:g} s"
        wanted = f"the run reads it from {settings.start:g} to {last:g} s"
        raise _unusable(name, f"{covered}, and {wanted}")
    return lambda at: np.interp(at, times, values)


def _unusable(name: str, why: str) -> ModelError:
    return ModelError([Diagnostic("NS508", f"the data of the input `{name}` {why}")])
