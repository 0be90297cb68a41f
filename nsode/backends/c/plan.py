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
from nsode.passes.prune import reads


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


def plan(works: Iterable[Work], readings: Readings) -> Plan:
    """Arrange work, given in an order that computes."""
    planner = _Planner(readings)
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


_Reads = set[tuple[str, bool]]


@dataclass(slots=True)
class Readings:
    """What each piece of work reads, found once for all the functions that do it."""

    known: dict[int, tuple[Work, _Reads]] = field(default_factory=dict)

    def of(self, work: Work) -> _Reads:
        """Return each name, and whether it is read at exactly the element at hand."""
        if id(work) not in self.known:
            self.known[id(work)] = work, _reads(work)
        return self.known[id(work)][1]

    def names(self, work: Work) -> set[str]:
        """Return each name that is read."""
        return {name for name, _ in self.of(work)}


def _reads(work: Work) -> _Reads:
    if work.range is None:
        return {(name, False) for name in reads(*exprs(work))}
    found: _Reads = set()
    for expr in exprs(work):
        _gather(expr, Index(work.range.variable), found)
    return found


def _gather(expr: Expr, here: Index | None, found: _Reads) -> None:
    match expr:
        case Name(id, at):
            found.add((id, at is not None and at == here))
        case Sum(over, body):
            _gather(body, None if here == Index(over.variable) else here, found)
        case _:
            for child in children(expr):
                _gather(child, here, found)


@dataclass(slots=True)
class _Planner:
    readings: Readings
    groups: list[Group] = field(default_factory=list)
    positions: dict[_Key, list[int]] = field(default_factory=dict)
    homes: dict[str, dict[_Key, int]] = field(default_factory=dict)
    stored: set[str] = field(default_factory=set)
    read: set[str] = field(default_factory=set)

    def align(self, work: Work) -> Iterator[Work]:
        """Break work at the pieces of what it reads, if it can then share their loops."""
        over = work.range
        if over is None:
            yield work
            return
        starts = {over.first}
        for name, here in self.readings.of(work):
            keys = [key for key in self.homes.get(name, ()) if key is not None]
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
        for name, here in self.readings.of(work):
            self.read.add(name)
            homes = self.homes.get(name)
            if homes is None:
                continue
            at = homes.get(key) if here else None
            if at is not None:
                shared.append((name, at))
                low = max(low, at)
            else:
                apart = (g + (home is not None or key is not None) for home, g in homes.items())
                low = max(low, *apart)
                self._store(name)
        position = self._position(key, low, work.range)
        for name, at in shared:
            if at != position:
                self._store(name)
        self.groups[position].works.append(work)
        for name in _defined(work):
            self.homes.setdefault(name, {})[key] = position

    def _store(self, name: str) -> None:
        if None not in self.homes[name]:
            self.stored.add(name)

    def _position(self, key: _Key, low: int, range: IndexRange | None) -> int:
        known = self.positions.setdefault(key, [])
        at = bisect_left(known, low)
        if at == len(known):
            known.append(len(self.groups))
            self.groups.append(Group(range))
        return known[at]

    def extent(self, name: str) -> IndexRange:
        keys = [key for key in self.homes[name] if key is not None]
        return IndexRange("", min(a for a, _ in keys), max(b for _, b in keys))
