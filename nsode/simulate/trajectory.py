"""What a run hands back: rows of time, states and outputs, with all that made them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nsode.diagnostics import suggest

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure

    from nsode.simulate.animate import Animation, Draw

Array = NDArray[np.float64]

_PART = re.compile(r"(\[-?\d+\])?(\.([xyzw]|\d+))?")
_ELEMENT = re.compile(r"\[-?\d+\](?=\.)")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Trajectory:
    """The stored rows of one run; every array has one row for each time.

    Attributes
    ----------
    name
        The name of the model.
    t
        Times in seconds, shape (rows,).
    x, y
        States and outputs, shape (rows, names). Outputs are those that the model
        declares, then every force.
    psi, modes
        The gap of each contact, and what each element does, as codes of
        :class:`nsode.simulate.Mode`.
    x_names, y_names, psi_names, mode_names
        What the columns are.
    forces
        Which of ``y_names`` are values of set-valued terms.
    units
        The unit of each name that has one.
    meta
        All that made the run, as plain data: model text, settings, parameters, versions.
    """

    name: str
    t: Array
    x: Array
    y: Array
    x_names: tuple[str, ...]
    y_names: tuple[str, ...]
    psi: Array
    psi_names: tuple[str, ...]
    modes: NDArray[np.int8]
    mode_names: tuple[str, ...]
    forces: tuple[str, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)
    meta: Mapping[str, Any] = field(default_factory=dict)

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.t)

    def __getitem__(self, name: str) -> Array:
        """Return a column by its name, or all columns of a vector or a family.

        ``sol["p.z"]`` is one column, ``sol["p"]`` those of ``p.x``, ``p.y`` and ``p.z``,
        ``sol["N.psi"]`` the gap of a contact, or those of a family of contacts,
        ``sol["t"]`` the times.

        Raises
        ------
        KeyError
            If nothing has that name; the message says what was perhaps meant.
        """
        if name == "t":
            return self.t
        columns = self._columns()
        found = [columns[known] for known in self.names(name)]
        if name in columns:
            return found[0][0][:, found[0][1]]
        return np.column_stack([table[:, place] for table, place in found])

    def names(self, name: str) -> list[str]:
        """Return the columns that a name stands for: its own, or its components.

        Raises
        ------
        KeyError
            If nothing has that name; the message says what was perhaps meant.
        """
        columns = self._columns()
        found = [name] if name in columns else [known for known in columns if _belongs(known, name)]
        if not found:
            hint = suggest(name, columns)
            raise KeyError(f"nothing is called `{name}`" + (f": {hint}" if hint else ""))
        return found

    def mode(self, element: str) -> NDArray[np.int8]:
        """Return what an element does at each time, as codes of ``Mode``.

        Raises
        ------
        KeyError
            If there is no such element.
        """
        if element not in self.mode_names:
            hint = suggest(element, self.mode_names)
            raise KeyError(f"there is no element `{element}`" + (f": {hint}" if hint else ""))
        return self.modes[:, self.mode_names.index(element)]

    def unit(self, name: str) -> str:
        """Return the unit of a name, empty if it has none."""
        return "s" if name == "t" else self.units.get(name, "")

    def plot(self, *names: str, file: str | Path | None = None) -> Figure:
        """Draw states, forces and modes over time, with matplotlib.

        Parameters
        ----------
        names
            What to draw; without names, a choice that suits the model.
        file
            Where to write the figure too; its ending chooses the format.

        Raises
        ------
        ModuleNotFoundError
            If matplotlib is not installed.
        """
        from nsode.simulate.plot import plot

        return plot(self, names, None if file is None else Path(file))

    def animate(
        self,
        draw: Draw,
        limits: tuple[float, float, float, float],
        speed: float = 1.0,
        rate: float = 25.0,
    ) -> Animation:
        """Return moving pictures, which a notebook shows and ``.save("x.gif")`` writes.

        Parameters
        ----------
        draw
            Called as ``draw(axis, now)`` for each picture, with empty matplotlib axes;
            ``now["p.z"]`` is a value, ``now.mode("N")`` a mode, ``now.t`` the time. Values
            are those of the nearest row.
        limits
            Left, right, bottom and top of the axes.
        speed
            Seconds of the run in a second of watching.
        rate
            Pictures per second of watching.

        Raises
        ------
        ValueError
            If limits, speed or rate make no sense, or too many pictures.
        """
        from nsode.simulate.animate import animate

        return animate(self, draw, limits, speed, rate)

    def to_pandas(self) -> pd.DataFrame:
        """Return states and outputs as a table whose index is the time.

        Raises
        ------
        ModuleNotFoundError
            If pandas is not installed.
        """
        import pandas as pd

        index = pd.Index(self.t, name="t")
        columns = [*self.x_names, *self.y_names]
        frame = pd.DataFrame(np.hstack([self.x, self.y]), index=index, columns=columns)
        frame.attrs.update(self.meta)
        return frame

    def to_xarray(self) -> xr.Dataset:
        """Return states and outputs as a dataset over the time, with units.

        Raises
        ------
        ModuleNotFoundError
            If xarray is not installed.
        """
        import xarray as xr

        found = {
            name: ("t", self[name], {"units": self.unit(name)} if self.unit(name) else {})
            for name in (*self.x_names, *self.y_names)
        }
        time = {"t": ("t", self.t, {"units": "s"})}
        return xr.Dataset(found, coords=time, attrs={"model": self.name})

    def save(self, path: str | Path) -> Path:
        """Write the trajectory to a ``.npz`` or a ``.csv`` file, whole or not at all.

        Raises
        ------
        ModelError
            NS602 if the ending is another one.
        OSError
            If the file cannot be written.
        """
        from nsode.simulate.storage import save

        return save(self, Path(path))

    @classmethod
    def load(cls, path: str | Path) -> Trajectory:
        """Read a trajectory back from a ``.npz`` file.

        Raises
        ------
        ModelError
            NS601 if the file is not one that :meth:`save` wrote.
        """
        from nsode.simulate.storage import load

        return load(Path(path))

    def __repr__(self) -> str:
        states, outputs = len(self.x_names), len(self.y_names)
        return (
            f"<nsode.Trajectory {self.name}: {len(self):,} rows of "
            f"{states} states and {outputs} outputs>"
        )

    def __str__(self) -> str:
        from nsode.simulate.display import text

        return text(self)

    def _repr_html_(self) -> str:
        from nsode.simulate.display import html

        return html(self)

    def _columns(self) -> dict[str, tuple[Array, int]]:
        gaps = [f"{name}.psi" for name in self.psi_names]
        return {
            name: (table, place)
            for names, table in ((gaps, self.psi), (self.y_names, self.y), (self.x_names, self.x))
            for place, name in enumerate(names)
        }


def _belongs(name: str, to: str) -> bool:
    """Whether ``name`` is a component or an element of ``to``, ``F[3].a.x`` one of ``F.a``."""
    for known in (name, _ELEMENT.sub("", name, count=1)):
        if known == to or (known.startswith(to) and _PART.fullmatch(known, len(to))):
            return True
    return False
