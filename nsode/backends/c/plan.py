"""The order in which a function computes: what shares a loop, and what needs an array.

Values over one range that read each other at the same index become one loop, so that
steps on the way stay scalars inside it; only what is read elsewhere is stored.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise

from nsode.expr import Expr, Index, IndexRange, Name, Sum, children
from nsode.ode import Binding, LinearSolve, defined, expressions


@dataclass(frozen=True, slots=True)
class Store:
    """``array[place] = value``; over a range, ``place`` is that of element ``first``."""

    array: str
    place: str
    value: Expr
    range: IndexRange | None = None
    first: int = 0


@dataclass(frozen=True, slots=True)
class Require:
    """Leave with a status unless a condition holds."""

    condition: Expr
    status: str
    range: IndexRange | None = None


@dataclass(frozen=True, slots=True)
class Scatter:
    """Write into the Jacobian: at ``place``, or over a range and those inside it.

    The places of a family stand in a table from ``place`` on, element ``first`` first.
    ``adds``: the value is added; ``outside``: some elements have no place.
    """

    value: Expr
    adds: bool
    place: int
    range: IndexRange | None = None
    inner: tuple[IndexRange, ...] = ()
    first: int = 0
    outside: bool = False


Work = Binding | LinearSolve | Store | Require | Scatter


@dataclass(slots=True)
class Group:
    """Work that shares a loop over ``range``; None stands outside of loops."""

    range: IndexRange | None
    works: list[Work] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Plan:
    """Groups in order, the range of every family that is kept in an array, and what is read."""

    groups: tuple[Group, ...]
    stored: dict[str, IndexRange]
    read: set[str]


def plan(works: Iterable[Work]) -> Plan:
    """Arrange work, given in an order that computes."""
    planner = _Planner()
    for work in works:
        for part in planner.align(work):
            planner.place(part)
    stored = {name: planner.extent(name) for name in planner.homes if name in planner.stored}
    return Plan(tuple(planner.groups), stored, planner.read)


_Key = tuple[int, int] | None


def _key(range: IndexRange | None) -> _Key:
    return None if range is None else (range.first, range.last)


def _defined(work: Work) -> tuple[str, ...]:
    return defined(work) if isinstance(work, Binding | LinearSolve) else ()


def exprs(work: Work) -> tuple[Expr, ...]:
    """Return the expressions that a piece of work evaluates."""
    match work:
        case Store(value=value) | Scatter(value=value):
            return (value,)
        case Require(condition=condition):
            return (condition,)
        case _:
            return tuple(expressions(work))


def _reads(expr: Expr, variable: str | None) -> Iterator[tuple[str, bool]]:
    """Yield each name, and whether it is read at exactly the element at hand."""
    stack = [(expr, variable)]
    while stack:
        node, here = stack.pop()
        match node:
            case Name(id, None):
                yield id, False
            case Name(id, Index(name, offset)):
                yield id, here is not None and name == here and offset == 0
            case Sum(over, body):
                stack.append((body, None if over.variable == here else here))
            case _:
                stack.extend((child, here) for child in children(node))


def _all_reads(work: Work) -> set[tuple[str, bool]]:
    variable = None if work.range is None else work.range.variable
    return {read for expr in exprs(work) for read in _reads(expr, variable)}


@dataclass(slots=True)
class _Planner:
    groups: list[Group] = field(default_factory=list)
    positions: dict[_Key, list[int]] = field(default_factory=dict)
    homes: dict[str, list[tuple[_Key, int]]] = field(default_factory=dict)
    stored: set[str] = field(default_factory=set)
    read: set[str] = field(default_factory=set)

    def align(self, work: Work) -> Iterator[Work]:
        """Break work at the pieces of what it reads, if it can then share their loops."""
        over = work.range
        if over is None:
            yield work
            return
        starts = {over.first}
        for name, here in _all_reads(work):
            keys = [key for key, _ in self.homes.get(name, ()) if key is not None]
            if keys and not here:
                yield work
                return
            starts.update(first for first, _ in keys if over.first < first <= over.last)
            starts.update(last + 1 for _, last in keys if over.first <= last < over.last)
        for first, after in pairwise([*sorted(starts), over.last + 1]):
            yield replace(work, range=IndexRange(over.variable, first, after - 1))

    def place(self, work: Work) -> None:
        key = _key(work.range)
        shared: list[tuple[str, int]] = []
        low = 0
        for name, here in _all_reads(work):
            self.read.add(name)
            homes = self.homes.get(name)
            if homes is None:
                continue
            at = dict(homes).get(key) if here else None
            if at is not None:
                shared.append((name, at))
                low = max(low, at)
            else:
                low = max(low, max(g + (home != key or key is not None) for home, g in homes))
                self._store(name)
        position = self._position(key, low, work.range)
        for name, at in shared:
            if at != position:
                self._store(name)
        self.groups[position].works.append(work)
        for name in _defined(work):
            self.homes.setdefault(name, []).append((key, position))

    def _store(self, name: str) -> None:
        if self.homes[name][0][0] is not None:
            self.stored.add(name)

    def _position(self, key: _Key, low: int, range: IndexRange | None) -> int:
        known = self.positions.setdefault(key, [])
        at = bisect_left(known, low)
        if at == len(known):
            known.append(len(self.groups))
            self.groups.append(Group(range))
        return known[at]

    def extent(self, name: str) -> IndexRange:
        keys = [key for key, _ in self.homes[name] if key is not None]
        return IndexRange("", min(a for a, _ in keys), max(b for _, b in keys))
