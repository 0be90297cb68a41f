"""The order in which a function computes: what shares a loop, and what needs an array.

Values over one range that read each other at the same index become one loop, so that
steps on the way stay scalars inside it; only what is read elsewhere is stored.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import chain, pairwise
from typing import NamedTuple

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
    works = list(works)
    if all(work.range is None for work in works):  # nothing to arrange, as in most scenes
        return Plan((Group(None, works),), {}, set().union(*map(readings.names, works)))
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


class Reading(NamedTuple):
    """What a piece of work reads: at exactly the element at hand, and apart from it."""

    work: Work
    here: set[str]
    apart: set[str]


@dataclass(slots=True)
class Readings:
    """What each piece of work reads, found once for all the functions that do it."""

    known: dict[int, Reading] = field(default_factory=dict)

    def of(self, work: Work) -> Reading:
        """Return what a piece of work reads; it is held on to for its id."""
        found = self.known.get(id(work))
        if found is None:
            found = self.known[id(work)] = _reading(work)
        return found

    def names(self, work: Work) -> set[str]:
        """Return every name that a piece of work reads."""
        _, here, apart = self.of(work)
        return here | apart if here else apart


def _reading(work: Work) -> Reading:
    if work.range is None:
        return Reading(work, set(), reads(*exprs(work)))
    found = Reading(work, set(), set())
    for expr in exprs(work):
        _gather(expr, Index(work.range.variable), found)
    return found


def _gather(expr: Expr, index: Index | None, found: Reading) -> None:
    match expr:
        case Name(id, at):
            (found.apart if at is None or at != index else found.here).add(id)
        case Sum(over, body):
            _gather(body, None if index == Index(over.variable) else index, found)
        case _:
            for child in children(expr):
                _gather(child, index, found)


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
        _, here, apart = self.readings.of(work)
        if any(self._is_family(name) for name in apart):
            yield work
            return
        for name in here:
            keys = [key for key in self.homes.get(name, ()) if key is not None]
            starts.update(first for first, _ in keys if over.first < first <= over.last)
            starts.update(last + 1 for _, last in keys if over.first <= last < over.last)
        for first, after in pairwise([*sorted(starts), over.last + 1]):
            yield replace(work, range=IndexRange(over.variable, first, after - 1))

    def place(self, work: Work) -> None:
        key = _key(work.range)
        _, here, apart = self.readings.of(work)
        self.read |= here
        self.read |= apart
        shared = {name: self.homes[name][key] for name in here if key in self.homes.get(name, ())}
        low = max(shared.values(), default=0)
        for name in chain(apart, here - shared.keys()):
            for home, group in self.homes.get(name, {}).items():
                low = max(low, group + (home is not None or key is not None))
                if home is not None:
                    self.stored.add(name)
        position = self._position(key, low, work.range)
        self.stored.update(name for name, at in shared.items() if at != position)
        self.groups[position].works.append(work)
        for name in _defined(work):
            self.homes.setdefault(name, {})[key] = position

    def _is_family(self, name: str) -> bool:
        return any(key is not None for key in self.homes.get(name, ()))

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
