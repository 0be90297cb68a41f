"""What a figure of a run shows: states, outputs, forces, penetration, energy."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from nsode.simulate.trajectory import Array, Trajectory

_MOST = 8
_LEDGER = ("given", "stored", "dissipated")


@dataclass(frozen=True, slots=True, eq=False)
class Panel:
    """Curves over time that share an axis, by name."""

    label: str
    unit: str
    curves: dict[str, Array]

    @property
    def title(self) -> str:
        """What stands at the axis."""
        return f"{self.label} [{self.unit}]" if self.unit else self.label


def named(trajectory: Trajectory, name: str) -> Panel:
    """Return the panel of one name that somebody asked for.

    Raises
    ------
    KeyError
        If the name is unknown.
    """
    return _panel(trajectory, trajectory.names(name), name)


def panels(trajectory: Trajectory) -> list[Panel]:
    """Return what suits a run; where there is no room, the last states and outputs go."""
    own, acting = _own(trajectory), _acting(trajectory)
    return [*own[: max(0, _MOST - len(acting))], *acting]


def left_out(trajectory: Trajectory) -> str:
    """Return what a figure of a whole run has no room for, empty where it shows all."""
    more = len(_own(trajectory)) + len(_acting(trajectory)) - len(panels(trajectory))
    return f", without {more:,} of the states and outputs" if more else ""


def without_ledger(trajectory: Trajectory) -> Trajectory:
    """Return a run without the columns of the ledger."""
    ledger = _ledger(trajectory)
    kept = [k for k, name in enumerate(trajectory.y_names) if name not in ledger]
    names = tuple(trajectory.y_names[k] for k in kept)
    return replace(trajectory, y=trajectory.y[:, kept], y_names=names) if ledger else trajectory


def stem(name: str) -> str:
    """Return the name of the vector or family to which a column belongs."""
    return re.split(r"[.\[]", name, maxsplit=1)[0]


def _own(trajectory: Trajectory) -> list[Panel]:
    """Return the model's own states, then its outputs: vectors, and scalars of one unit."""
    hidden = {*trajectory.meta.get("auxiliary", ()), *trajectory.forces, *_ledger(trajectory)}
    found: list[Panel] = []
    for names in (trajectory.x_names, trajectory.y_names):
        shown = [name for name in names if name not in hidden]
        members = Counter(map(stem, shown))
        groups: dict[str, list[str]] = {}
        for name in shown:
            alone = members[stem(name)] == 1 and trajectory.unit(name)
            groups.setdefault(f"[{alone}]" if alone else stem(name), []).append(name)
        found += (_panel(trajectory, group) for group in groups.values())
    return found


def _acting(trajectory: Trajectory) -> list[Panel]:
    """Return what the elements do: forces of contacts and of friction, penetration, energy."""
    contacts = trajectory.psi_names
    pushing = [name for name in trajectory.forces if name in contacts]
    rubbing = [name for name in trajectory.forces if name not in contacts]
    found = [_panel(trajectory, group) for group in (pushing, rubbing) if group]
    if contacts:
        depths = {name: np.maximum(0.0, -trajectory[f"{name}.psi"]) for name in contacts}
        unit = _common(trajectory, [f"{name}.psi" for name in contacts])
        found.append(Panel("penetration", unit, depths))
    return [*found, *_energy(trajectory)]


def _energy(trajectory: Trajectory) -> list[Panel]:
    """Return the energy of all elements, where the run kept the ledger.

    What was given and dissipated are integrals, which only a row for each step allows.
    """
    names = _ledger(trajectory)
    if not names:
        return []
    total = {
        word: np.sum([trajectory[name] for name in names if name.endswith(f".{word}")], axis=0)
        for word in _LEDGER
    }
    if trajectory.meta["run"]["every"] > 1:
        return [Panel("stored energy", "J", {"stored": total["stored"]})]
    widths = np.diff(trajectory.t)
    for word in ("given", "dissipated"):
        means = 0.5 * (total[word][1:] + total[word][:-1])
        total[word] = np.concatenate([[0.0], np.cumsum(means * widths)])
    return [Panel("energy", "J", total)]


def _ledger(trajectory: Trajectory) -> list[str]:
    """Return the columns of the ledger that a run may keep."""
    entries = [f"{element}.{word}" for element in trajectory.mode_names for word in _LEDGER]
    return [name for name in entries if name in trajectory.y_names]


def _panel(trajectory: Trajectory, names: Sequence[str], label: str = "") -> Panel:
    stems = list(dict.fromkeys(map(stem, names)))
    shown = stems if len(stems) <= 3 else [stems[0], "...", stems[-1]]
    curves = {name: trajectory[name] for name in names}
    return Panel(label or ", ".join(shown), _common(trajectory, names), curves)


def _common(trajectory: Trajectory, names: Sequence[str]) -> str:
    """Return the unit that all of some columns have, empty if there is none."""
    units = {trajectory.unit(name) for name in names}
    return units.pop() if len(units) == 1 else ""
