"""What the figures of the paper share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nsode.compiler import Model, loads
from nsode.simulate import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """One figure: the drawing, what it shows in words, and the runs it was made of."""

    figure: Figure
    text: str
    runs: Mapping[str, Trajectory]


def model(name: str) -> Model:
    """Return one of the shipped models."""
    return loads(files("nsode.models").joinpath(f"{name}.di").read_bytes(), f"{name}.di")


@contextmanager
def canvas(height: float, rows: int, columns: int = 1) -> Iterator[tuple[Figure, list[Axes]]]:
    """Give a figure as wide as a page of text, and its panels row by row."""
    import matplotlib as mpl

    from nsode.simulate.figure import Figure
    from nsode.simulate.plot import STYLE

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.3, height), layout="constrained")
        grid = figure.subplots(rows, columns, sharex=columns == 1, squeeze=False)
        yield figure, list(grid.flat)
        figure.align_ylabels()


def zero_speeds(gap: NDArray[np.float64], velocity: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the speeds at which a gap passes zero, in order, interpolated between rows."""
    rows = np.flatnonzero(np.diff(gap > 0))
    share = gap[rows] / (gap[rows] - gap[rows + 1])
    return np.abs(velocity[rows] + share * (velocity[rows + 1] - velocity[rows]))
