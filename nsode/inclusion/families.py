"""Families: what stands under an index, piece by piece, and the elements that it selects."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from nsode.expr import Expr, Index, IndexRange
from nsode.passes.split import pieces, settle

#: The index ranges under which an expression stands.
Axes = tuple[IndexRange, ...]
#: The first and the last element of a run; a scalar is its own element 0.
Elements = tuple[int, int]


def elements(at: Index | None, over: Iterable[IndexRange]) -> Elements:
    """Return the elements that a subscript selects under some index ranges."""
    if at is None:
        return 0, 0
    if at.variable is None:
        return at.offset, at.offset
    first, last = next((a.first, a.last) for a in over if a.variable == at.variable)
    return first + at.offset, last + at.offset


class Case(NamedTuple):
    """An expression as it reads over some ranges, without an ``if`` on their indices."""

    expr: Expr
    over: Axes


def cases(expr: Expr, over: IndexRange | None) -> list[Case]:
    """Return what an expression is, piece by piece of its range."""
    if over is None:
        return [Case(settle(expr), ())]
    return [Case(part, (piece,)) for piece, (part,) in pieces(over, expr)]


@dataclass(slots=True)
class Runs:
    """A set of elements; runs that touch become one."""

    runs: list[Elements] = field(default_factory=list)

    def add(self, new: Elements) -> None:
        """Take in a run; one that ends before it begins is empty."""
        first, last = new
        if first > last:
            return
        start = bisect_left(self.runs, first - 1, key=lambda run: run[1])
        end = bisect_right(self.runs, last + 1, key=lambda run: run[0])
        for low, high in self.runs[start:end]:
            first, last = min(first, low), max(last, high)
        self.runs[start:end] = [(first, last)]

    def holds(self, wanted: Elements) -> bool:
        """Tell whether every element of a run is in the set."""
        first, last = wanted
        k = bisect_left(self.runs, last, key=lambda run: run[1])
        return first > last or (k < len(self.runs) and self.runs[k][0] <= first)
