"""Figures of trajectories, with matplotlib: states with units, forces, bands of modes."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nsode.simulate.observe import Mode
from nsode.simulate.trajectory import Trajectory

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
    "lines.linewidth": 1.0,
    "legend.frameon": False,
    "savefig.dpi": 200,
    "svg.hashsalt": "nsode",
}

_MOST_PANELS, _MOST_MODES = 8, 12
_LOOKS = {Mode.CONTACT: "0.55", Mode.STICK: "0.25", Mode.SLIP: "0.85"}


def plot(trajectory: Trajectory, names: Sequence[str] = (), file: Path | None = None) -> Figure:
    """Draw names over time, one panel for each vector or scalar, then a band of modes.

    Raises
    ------
    KeyError
        If a name is unknown.
    ModuleNotFoundError
        If matplotlib is not installed.
    """
    import matplotlib as mpl

    from nsode.simulate.figure import Figure

    panels = [[name] for name in names] or _panels(trajectory)[:_MOST_PANELS]
    bands = bool(trajectory.mode_names)
    heights = [1.0] * len(panels) + [0.16 * min(_MOST_MODES, len(trajectory.mode_names))] * bands
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.3, 0.5 + 1.35 * sum(heights)), layout="constrained")
        axes = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)
        for panel, axis in zip(panels, axes[:, 0], strict=False):
            curves(axis, trajectory, panel)
        if bands:
            _mode_panel(axes[-1, 0], trajectory)
        axes[-1, 0].set_xlabel("t [s]")
        figure.align_ylabels()
        if file is not None:
            write(figure, file)
    return figure


def left_out(trajectory: Trajectory) -> str:
    """Return what a figure of a whole run has no room for, empty where it shows all."""
    things = (
        (len(_panels(trajectory)) - _MOST_PANELS, "of the states and outputs"),
        (len(trajectory.mode_names) - _MOST_MODES, "of the elements"),
    )
    return "".join(f", without {more:,} {what}" for more, what in things if more > 0)


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


def curves(axis: Axes, trajectory: Trajectory, names: Sequence[str]) -> None:
    """Draw columns into a panel, named and with their unit."""
    drawn = [column for name in names for column in trajectory.names(name)]
    for number, name in enumerate(drawn):
        color = COLORS[number % len(COLORS)]
        axis.plot(trajectory.t, trajectory[name], color=color, label=name)
    unit = trajectory.unit(drawn[0])
    common = drawn[0] if len(drawn) == 1 else _stem(drawn[0])
    axis.set_ylabel(f"{common} [{unit}]" if unit else common)
    if 1 < len(drawn) <= len(COLORS):
        axis.legend(loc="best", ncols=len(drawn), fontsize="small")


def shade(axis: Axes, trajectory: Trajectory, element: str, mode: Mode = Mode.CONTACT) -> None:
    """Gray the times at which an element is in a mode, as Figure 9 of the paper does."""
    for first, last in _stretches(trajectory.mode(element) == mode):
        axis.axvspan(trajectory.t[first], trajectory.t[last], color="0.85", lw=0, zorder=0)


def _mode_panel(axis: Axes, trajectory: Trajectory) -> None:
    from matplotlib.patches import Patch

    names = trajectory.mode_names[:_MOST_MODES]
    seen: set[Mode] = set()
    for level, name in enumerate(reversed(names)):
        codes = trajectory.mode(name)
        for mode, gray in _LOOKS.items():
            spans = [
                (trajectory.t[first], trajectory.t[last] - trajectory.t[first])
                for first, last in _stretches(codes == mode)
            ]
            if spans:
                seen.add(mode)
                axis.broken_barh(spans, (level - 0.35, 0.7), facecolor=gray, lw=0)
    axis.set_yticks(range(len(names)), list(reversed(names)))
    axis.tick_params(axis="y", length=0)
    patches = [
        Patch(facecolor=gray, lw=0, label=mode.name.lower())
        for mode, gray in _LOOKS.items()
        if mode in seen
    ]
    if patches:
        axis.legend(handles=patches, loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small")


def _panels(trajectory: Trajectory) -> list[list[str]]:
    """Return the model's own states, then its outputs, vectors together."""
    auxiliary = set(trajectory.meta.get("auxiliary", ()))
    groups: dict[str, list[str]] = {}
    for name in (*trajectory.x_names, *trajectory.y_names):
        if name not in auxiliary:
            groups.setdefault(_stem(name), []).append(name)
    return list(groups.values())


def _stem(name: str) -> str:
    return re.split(r"[.\[]", name, maxsplit=1)[0]


def _stretches(where: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the first and the last row of each stretch of rows that are set."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(np.int8)))
    last = len(where) - 1
    return [(int(a), min(int(b), last)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
