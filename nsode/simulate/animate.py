"""Moving pictures of a run: what a function draws, moment by moment."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from nsode.simulate.observe import Mode
from nsode.simulate.trajectory import Array, Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from PIL.Image import Image

_MOST_PICTURES = 2000
_WIDTH, _DPI = 4.0, 80  # inches, dots per inch


@dataclass(frozen=True, slots=True)
class Moment:
    """One row of a run: ``now["p.z"]`` is a number, ``now["p"]`` an array, ``now.t`` the time."""

    trajectory: Trajectory
    row: int

    @property
    def t(self) -> float:
        """The time in seconds."""
        return float(self.trajectory.t[self.row])

    def __getitem__(self, name: str) -> Array:
        """Return a value, or those of a vector or a family.

        Raises
        ------
        KeyError
            If nothing has that name; the message says what was perhaps meant.
        """
        value: Array = self.trajectory[name][self.row]
        return value

    def mode(self, element: str) -> Mode:
        """Return what an element does now.

        Raises
        ------
        KeyError
            If there is no such element.
        """
        return Mode(self.trajectory.mode(element)[self.row])


Draw = Callable[["Axes", Moment], object]


@dataclass(frozen=True, slots=True, eq=False)
class Animation:
    """Pictures of a run, drawn when they are shown in a notebook or saved.

    Attributes
    ----------
    rows
        The rows of the run that are drawn, one for each picture.
    draw
        Draws a moment into empty axes.
    limits
        Left, right, bottom and top of the axes, whose scales are equal.
    rate
        Pictures per second.
    """

    rows: Trajectory
    draw: Draw
    limits: tuple[float, float, float, float]
    rate: float

    def save(self, file: str | Path) -> Path:
        """Write the pictures as GIF, whole or not at all.

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        from nsode.files import write_binary

        path = Path(file)
        write_binary(path, lambda target: target.write(self._gif()))
        return path

    def pictures(self) -> Iterator[Image]:
        """Yield the pictures one by one.

        Raises
        ------
        ModuleNotFoundError
            If matplotlib is not installed.
        """
        import matplotlib as mpl
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        from PIL import Image

        from nsode.simulate.plot import STYLE

        left, right, bottom, top = self.limits
        height = _WIDTH * min(2.0, max(0.25, (top - bottom) / (right - left)))
        with mpl.rc_context(STYLE):
            figure = Figure(figsize=(_WIDTH, height + 0.5), dpi=_DPI, layout="constrained")
            canvas: Any = FigureCanvasAgg(figure)  # its methods have no types
            axis = figure.add_subplot()
            for row in range(len(self.rows)):
                axis.clear()
                axis.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
                moment = Moment(self.rows, row)
                self.draw(axis, moment)
                axis.set_title(f"{moment.t:.2f} s", fontsize="medium", loc="left")
                canvas.draw()
                figure.set_layout_engine("none")  # as the first picture is laid out, so are all
                yield Image.fromarray(np.array(canvas.buffer_rgba())).convert("RGB")

    def _gif(self) -> bytes:
        first, *others = (picture.quantize(64) for picture in self.pictures())
        buffer = BytesIO()
        first.save(
            buffer, "gif", save_all=True, append_images=others, duration=1000 / self.rate, loop=0
        )
        return buffer.getvalue()

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"image/gif": b64encode(self._gif()).decode(), "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<animation of {self.rows.name}: {len(self.rows)} pictures>"


def animate(
    trajectory: Trajectory,
    draw: Draw,
    limits: tuple[float, float, float, float],
    speed: float = 1.0,
    rate: float = 25.0,
) -> Animation:
    """Return pictures of a run at even times; see :meth:`Trajectory.animate`."""
    left, right, bottom, top = limits
    if not (left < right and bottom < top):
        raise ValueError(f"limits are left < right, bottom < top, not {limits}")
    if not (speed > 0 and 0 < rate <= 50):
        raise ValueError("the speed is above 0, the rate above 0 and at most 50 per second")
    t = trajectory.t
    count = int(np.floor((t[-1] - t[0]) * rate / speed * (1 + 1e-12))) + 1
    if count > _MOST_PICTURES:
        raise ValueError(f"{count} pictures are too many: raise the speed or lower the rate")
    times = t[0] + np.arange(count) * speed / rate
    nearest = np.searchsorted((t[1:] + t[:-1]) / 2, times)
    return Animation(_only(trajectory, nearest), draw, limits, rate)


def _only(trajectory: Trajectory, rows: np.ndarray[Any, np.dtype[np.intp]]) -> Trajectory:
    return replace(
        trajectory,
        **{name: getattr(trajectory, name)[rows] for name in ("t", "x", "y", "psi", "modes")},
    )
