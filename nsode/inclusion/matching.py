"""Which row says which derivative, and which rows must be solved together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from nsode.expr import IndexRange
from nsode.inclusion.coverage import doubled
from nsode.inclusion.equations import Row, Unknown, state_of
from nsode.inclusion.families import Elements, Runs, elements


@dataclass(slots=True)
class _Readers:
    """The rows that read elements of one family: single elements, or several at once."""

    single: dict[int, list[int]] = field(default_factory=dict)
    several: list[int] = field(default_factory=list)

    def add(self, read: Elements, row: int) -> None:
        first, last = read
        (self.single.setdefault(first, []) if first == last else self.several).append(row)

    def of(self, known: Elements) -> list[int]:
        """Return the rows that read some of these elements."""
        first, last = known
        if last - first < len(self.single):
            elements = [k for k in range(first, last + 1) if k in self.single]
        else:
            elements = [k for k in self.single if first <= k <= last]
        return [*self.several, *(row for k in elements for row in self.single[k])]


@dataclass(slots=True)
class Matching:
    """Rows and the derivatives that are still open in each.

    ``said`` lists the rows that give one derivative each, as far as the others are
    known; ``coupled`` holds groups of rows that share derivatives.
    """

    rows: Sequence[Row]
    open: list[list[Unknown]] = field(init=False)
    said: dict[int, Unknown] = field(default_factory=dict)
    _covered: dict[str, Runs] = field(default_factory=dict)
    _readers: dict[str, _Readers] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.open = [list(row.unknowns) for row in self.rows]
        for k, unknowns in enumerate(self.open):
            if len(unknowns) > 1:
                for unknown in unknowns:
                    readers = self._readers.setdefault(state_of(unknown), _Readers())
                    readers.add(_elements(unknown, self.rows[k].range), k)

    def match(self) -> list[list[int]]:
        """Match rows with derivatives.

        Returns
        -------
        list of list of int
            Groups of rows that must be solved together.

        Raises
        ------
        ModelError
            NS108 for a row that says nothing new.
        """
        self._substitute()
        self._peel()
        return self._groups()

    def _substitute(self) -> None:
        """Let rows with one derivative say it, and others read it from them."""
        ready = [k for k, unknowns in enumerate(self.open) if len(unknowns) == 1]
        while ready:
            k = ready.pop()
            unknown = self.open[k][0]
            self.said[k] = unknown
            state, said = state_of(unknown), _elements(unknown, self.rows[k].range)
            self._covered.setdefault(state, Runs()).add(said)
            waiting = self._readers[state].of(said) if state in self._readers else ()
            ready.extend(r for r in waiting if self._drop_known(r, state, k))

    def _drop_known(self, k: int, state: str, by: int) -> bool:
        """Drop what is known now from an open row; tell whether one derivative is left."""
        row, before = self.rows[k], len(self.open[k])
        if k in self.said or before == 1:
            return False
        kept = [
            unknown
            for unknown in self.open[k]
            if state_of(unknown) != state or not self._is_covered(unknown, row.range)
        ]
        if not kept:
            raise doubled(state, row.span, self.rows[by].span)
        self.open[k] = kept
        return len(kept) == 1 < before

    def _is_covered(self, unknown: Unknown, over: IndexRange | None) -> bool:
        return self._covered[state_of(unknown)].holds(_elements(unknown, over))

    def _peel(self) -> None:
        """Let a row say the derivative that no other open row holds."""
        holders: dict[str, set[int]] = {}
        for k in self._coupled():
            for unknown in self.open[k]:
                holders.setdefault(state_of(unknown), set()).add(k)
        ready = list(self._coupled())
        while ready:
            k = ready.pop()
            alone = [u for u in self.open[k] if len(holders[state_of(u)]) == 1]
            if k in self.said or len(alone) != 1:
                continue
            self.said[k] = alone[0]
            for unknown in self.open[k]:
                state = state_of(unknown)
                holders[state].discard(k)
                ready.extend(holders[state] if len(holders[state]) == 1 else ())

    def _coupled(self) -> list[int]:
        return [k for k, unknowns in enumerate(self.open) if k not in self.said and unknowns]

    def _groups(self) -> list[list[int]]:
        """Return the rows that are left, those that share derivatives together."""
        leader: dict[int, int] = {k: k for k in self._coupled()}

        def find(k: int) -> int:
            while leader[k] != k:
                leader[k] = k = leader[leader[k]]
            return k

        first: dict[str, int] = {}
        for k in leader:
            for unknown in self.open[k]:
                a, b = find(first.setdefault(unknown.id, k)), find(k)
                leader[max(a, b)] = min(a, b)
        groups: dict[int, list[int]] = {}
        for k in leader:
            groups.setdefault(find(k), []).append(k)
        return list(groups.values())


def _elements(unknown: Unknown, over: IndexRange | None) -> Elements:
    """Return the elements of a family whose derivatives a row holds."""
    return elements(unknown.at, () if over is None else (over,))
