"""Where the entries of a Jacobian stand in compressed columns."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import TYPE_CHECKING, NamedTuple

from nsode.derivative.sparse import Entry
from nsode.expr import Index, IndexRange
from nsode.ode import Slot

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Pattern(NamedTuple):
    """Compressed columns, and for each entry the place of each of its values.

    ``columns[j]:columns[j+1]`` are the places of column ``j`` in ``rows``. A place of
    -1 lies outside the matrix, where an ``if`` on the index keeps the value zero.
    """

    columns: tuple[int, ...]
    rows: tuple[int, ...]
    places: tuple[tuple[int, ...], ...]


def pattern(entries: Sequence[Entry], rows: dict[str, Slot], columns: dict[str, Slot]) -> Pattern:
    """Return where the values of the entries stand in compressed columns.

    Parameters
    ----------
    entries : sequence of Entry
        Of one Jacobian.
    rows, columns : dict of str to Slot
        The places of the names that are derived, and of those by which they are.
    """
    import numpy as np

    height = max((slot.offset + _length(slot) for slot in rows.values()), default=0)
    width = max((slot.offset + _length(slot) for slot in columns.values()), default=0)
    spots = [_spots(entry, rows, columns, height) for entry in entries]
    every = np.concatenate([np.empty(0, dtype=np.int64), *spots])
    used, place = np.unique(every[every >= 0], return_inverse=True)
    places = np.full(len(every), -1)
    places[every >= 0] = place
    ends = np.cumsum([len(found) for found in spots])
    return Pattern(
        tuple(np.searchsorted(used, height * np.arange(width + 1)).tolist()),
        tuple((used % height if height else used).tolist()),
        tuple(tuple(part.tolist()) for part in np.split(places, ends)[: len(spots)]),
    )


def _spots(
    entry: Entry, rows: dict[str, Slot], columns: dict[str, Slot], height: int
) -> NDArray[np.int64]:
    """Return ``column*height + row`` of each value in the order of the loops, or -1."""
    import numpy as np

    at = _grid(entry.ranges)
    row, row_fits = _place(rows[entry.row.id], entry.row.at, at)
    column, column_fits = _place(columns[entry.column.id], entry.column.at, at)
    spot, fits = column * height + row, row_fits & column_fits
    if not entry.ranges:
        return np.array([spot if fits else -1])
    return np.broadcast_to(np.where(fits, spot, -1), prod(map(len, entry.ranges)))


def _grid(ranges: tuple[IndexRange, ...]) -> dict[str, NDArray[np.int64]]:
    """Return the value of each index in the order of the loops."""
    import numpy as np

    values = (np.arange(span.first, span.last + 1) for span in ranges)
    grids = np.meshgrid(*values, indexing="ij") if ranges else ()
    return {span.variable: grid.ravel() for span, grid in zip(ranges, grids, strict=True)}


def _place(
    slot: Slot, at: Index | None, values: dict[str, NDArray[np.int64]]
) -> tuple[NDArray[np.int64] | int, NDArray[np.bool_] | bool]:
    """Return places in a vector, and whether they are inside the range."""
    if slot.range is None or at is None:
        return slot.offset, True
    index = at.offset + (values[at.variable] if at.variable is not None else 0)
    inside = (index >= slot.range.first) & (index <= slot.range.last)
    return slot.offset + index - slot.range.first, inside


def _length(slot: Slot) -> int:
    return 1 if slot.range is None else len(slot.range)
