"""A trajectory in a few lines, for a terminal and for a notebook."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import NamedTuple

import numpy as np

from nsode.simulate.observe import Mode
from nsode.simulate.trajectory import Trajectory

_SHOWN = 16  # rows of the table


class Row(NamedTuple):
    """One column of a trajectory in numbers."""

    name: str
    unit: str
    start: float
    end: float
    least: float
    most: float


def text(trajectory: Trajectory) -> str:
    """Return a summary as plain text."""
    lines = [headline(trajectory), f"  {'':<14}{'':<8}" + "".join(f"{h:>14}" for h in _HEADS)]
    for row in rows(trajectory):
        values = "".join(f"{value:>14.6g}" for value in row[2:])
        lines.append(f"  {row.name:<14}{row.unit:<8}{values}")
    if more(trajectory):
        lines.append(f"  and {more(trajectory)} more")
    lines.extend(f"  {line}" for line in shares(trajectory))
    return "\n".join(lines)


def html(trajectory: Trajectory) -> str:
    """Return a summary as a fragment of HTML."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in ("", "", *_HEADS))
    body = "".join(
        f"<tr><th style='text-align:left'>{escape(row.name)}</th><td>{escape(row.unit)}</td>"
        + "".join(f"<td>{value:.6g}</td>" for value in row[2:])
        + "</tr>"
        for row in rows(trajectory)
    )
    tail = f"<p>and {more(trajectory)} more</p>" if more(trajectory) else ""
    modes = "".join(f"<li>{escape(line)}</li>" for line in shares(trajectory))
    return (
        f"<p><b>{escape(headline(trajectory))}</b></p>"
        f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{tail}<ul>{modes}</ul>"
    )


_HEADS = ("start", "end", "least", "most")


def headline(trajectory: Trajectory) -> str:
    """Return what ran, how far and how."""
    run = trajectory.meta.get("run", {})
    length = trajectory.t[-1] - trajectory.t[0]
    how = ""
    if run:
        how = f" in {run['taken']:,} steps of {quantity(run['step'])} by {run['method']}"
    return f"{trajectory.name}: {quantity(length)}{how}, {len(trajectory):,} rows"


def rows(trajectory: Trajectory) -> list[Row]:
    """Return the table: the model's own states first, then its outputs."""
    return [_row(trajectory, name) for name in _chosen(trajectory)[:_SHOWN]]


def more(trajectory: Trajectory) -> int:
    """Return how many states and outputs the table leaves out."""
    return max(0, len(_chosen(trajectory)) - _SHOWN)


def shares(trajectory: Trajectory) -> Iterator[str]:
    """Yield what each element did, in percent of the rows, and by how much it gave way."""
    for name in trajectory.mode_names[:_SHOWN]:
        found = np.bincount(trajectory.mode(name), minlength=len(Mode)) / len(trajectory)
        parts = [f"{mode.name.lower()} {100 * found[mode]:.3g} %" for mode in Mode if found[mode]]
        yield ", ".join([f"{name}: {parts[0]}", *parts[1:], *_yielded(trajectory, name)])


def _yielded(trajectory: Trajectory, element: str) -> Iterator[str]:
    """Yield how far an element is from the rigid one; a K that is too low shows here."""
    if element in trajectory.psi_names:
        word, most = "deepest", -np.min(trajectory.psi[:, trajectory.psi_names.index(element)])
    else:
        state, names = f"{element}.a", trajectory.x_names
        places = [k for k, n in enumerate(names) if n == state or n.startswith(f"{state}.")]
        strain = np.linalg.norm(trajectory.x[:, places], axis=1)
        word, most = "presliding", np.max(strain)
    if most > 0:
        yield f"{word} {most:.3g}"


def quantity(seconds: float) -> str:
    """Return a duration in a unit that suits it."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if abs(seconds) >= size:
            return f"{seconds / size:.6g} {unit}"
    return f"{seconds:g} s"


def _chosen(trajectory: Trajectory) -> list[str]:
    auxiliary = set(trajectory.meta.get("auxiliary", ()))
    names = [name for name in trajectory.x_names if name not in auxiliary]
    names += trajectory.y_names
    # Where not all are shown, the elements of families make way for what stands alone.
    return sorted(names, key=lambda name: "[" in name) if len(names) > _SHOWN else names


def _row(trajectory: Trajectory, name: str) -> Row:
    values = trajectory[name]
    with np.errstate(invalid="ignore"):
        least, most = float(np.min(values)), float(np.max(values))
    return Row(name, trajectory.unit(name), float(values[0]), float(values[-1]), least, most)
