"""Figures of trajectories, with matplotlib: states with units, forces, bands of modes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nsode.simulate.observe import Mode
from nsode.simulate.panels import Panel, named, panels, stem
from nsode.simulate.trajectory import Array, Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Black and grays first, as the paper prints them; then colors that the color-blind tell apart.
COLORS = ("#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
STYLE: dict[Any, Any] = {
    "font.size": 9.0,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.xmargin": 0.0,
    "axes.formatter.limits": (-3, 4),
    "axes.formatter.use_mathtext": True,
    "lines.linewidth": 1.0,
    "legend.frameon": False,
    "savefig.dpi": 200,
    "svg.hashsalt": "nsode",
}

_FEW_MODES = 12  # elements whose names have room
_BESIDE: dict[str, Any] = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5), "fontsize": "small"}
_LOOKS = {Mode.CONTACT: "0.55", Mode.STICK: "0.25", Mode.SLIP: "0.85"}


def plot(trajectory: Trajectory, names: Sequence[str] = (), file: Path | None = None) -> Figure:
    """Draw names over time, or what suits the run, then a band of modes.

    Raises
    ------
    KeyError
        If a name is unknown.
    ModuleNotFoundError
        If matplotlib is not installed.
    """
    import matplotlib as mpl

    from nsode.simulate.figure import Figure

    shown = [named(trajectory, name) for name in names] or panels(trajectory)
    bands = len(trajectory.mode_names)
    heights = [1.0] * len(shown) + [max(0.3, 0.16 * min(_FEW_MODES, bands))] * (bands > 0)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.3, 0.5 + 1.35 * sum(heights)), layout="constrained")
        axes = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)
        for panel, axis in zip(shown, axes[:, 0], strict=False):
            draw(axis, trajectory.t, panel)
            if len(trajectory.psi_names) == 1:
                shade(axis, trajectory, trajectory.psi_names[0])
        if bands:
            _mode_panel(axes[-1, 0], trajectory)
        axes[-1, 0].set_xlabel("t [s]")
        figure.align_ylabels()
        if file is not None:
            write(figure, file)
    return figure


def write(figure: Figure, file: Path) -> None:
    """Write a figure, whole or not at all; the ending of the name is its format.

    Raises
    ------
    OSError
        If the file cannot be written.
    ValueError
        If matplotlib knows no such format.
    """
    from nsode.files import write_binary

    ending = file.suffix.lstrip(".") or "png"
    undated = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(ending)
    write_binary(file, lambda target: figure.savefig(target, format=ending, metadata=undated))


def draw(axis: Axes, t: Array, panel: Panel) -> None:
    """Draw the curves of a panel; of many, the first and the last are named."""
    import matplotlib as mpl

    many = len(panel.curves) > len(COLORS)
    shades = mpl.colormaps["viridis"](np.linspace(0.0, 0.9, len(panel.curves)))
    for number, (name, values) in enumerate(panel.curves.items()):
        color = shades[number] if many else COLORS[number]
        shown = not many or number in (0, len(panel.curves) - 1)
        axis.plot(t, values, color=color, lw=0.6 if many else None, label=name if shown else None)
    axis.set_ylabel(panel.title)
    if len(panel.curves) > 1:
        axis.legend(**_BESIDE)


def shade(axis: Axes, trajectory: Trajectory, element: str, mode: Mode = Mode.CONTACT) -> None:
    """Gray the times at which an element is in a mode, as Figure 9 of the paper does."""
    for first, last in _stretches(trajectory.mode(element) == mode):
        axis.axvspan(trajectory.t[first], trajectory.t[last], color="0.85", lw=0, zorder=0)


def _mode_panel(axis: Axes, trajectory: Trajectory) -> None:
    from matplotlib.patches import Patch

    names = list(reversed(trajectory.mode_names))
    tall = 0.7 if len(names) <= _FEW_MODES else 1.0
    seen: set[Mode] = set()
    for level, name in enumerate(names):
        codes = trajectory.mode(name)
        for mode, gray in _LOOKS.items():
            spans = [
                (trajectory.t[first], trajectory.t[last] - trajectory.t[first])
                for first, last in _stretches(codes == mode)
            ]
            if spans:
                seen.add(mode)
                axis.broken_barh(spans, (level - tall / 2, tall), facecolor=gray, lw=0)
    ticks = [k for k, name in enumerate(names) if len(names) <= _FEW_MODES or _ends(names, k)]
    axis.set_yticks(ticks, [names[k] for k in ticks])
    axis.set_ylim(-0.6, len(names) - 0.4)
    axis.tick_params(axis="y", length=0)
    axis.legend(
        handles=[
            Patch(facecolor=gray, lw=0, label=mode.name.lower())
            for mode, gray in _LOOKS.items()
            if mode in seen
        ],
        **_BESIDE,
    )


def _ends(names: Sequence[str], k: int) -> bool:
    """Whether a name is the first or the last of its family among others."""
    return any(not 0 <= j < len(names) or stem(names[j]) != stem(names[k]) for j in (k - 1, k + 1))


def _stretches(where: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the first and the last row of each stretch of rows that are set."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(np.int8)))
    last = len(where) - 1
    return [(int(a), min(int(b), last)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
