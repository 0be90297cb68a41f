"""Jacobians over bindings and families, as sparse entries.

What a family depends on is a band: ``d(b[i])/d(x[i+k])`` is a family of its own. A sum over
a family depends on every element of it: such a definition is a *hub*. Whatever
reads a hub is derived by the hub first, and the hub by its elements where the entries
are written; so no definition ever has two indices, whatever the model couples.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from nsode.derivative.forward import Row
from nsode.derivative.parts import is_small, with_parts
from nsode.derivative.rules import (
    ONE,
    ZERO,
    Partial,
    fresh_range,
    guarded,
    index_variables,
    moved,
    partials,
    shifted,
    summed,
    times,
)
from nsode.expr import (
    Call,
    Expr,
    Index,
    IndexRange,
    Name,
    Number,
    add,
    multiply,
    names,
    negate,
    walk,
)
from nsode.ode import (
    AugmentedODE,
    Binding,
    Definition,
    LinearSolve,
    Rate,
    SetValuedTerm,
    defined,
)

_SHORT = 4  # nodes of a derivative that is not worth a name


class Entry(NamedTuple):
    """``d(row)/d(column) += value`` for each combination of the ``ranges``."""

    row: Name
    column: Name
    value: Expr
    ranges: tuple[IndexRange, ...]


@dataclass(frozen=True, slots=True)
class Jacobian:
    """Entries, and the definitions that they read beside those of the system."""

    definitions: tuple[Definition, ...]
    entries: tuple[Entry, ...]


class _Dependence(NamedTuple):
    """``d(definition)/d(key) = value``, both at the index of the definition."""

    key: Name
    value: Expr


class _Spread(NamedTuple):
    """How a hub depends on the elements that it sums: ``value`` for each of ``over``."""

    column: Name
    value: Expr
    over: tuple[IndexRange, ...]


def jacobian(ode: AugmentedODE) -> Jacobian:
    """Return d(x')/dx."""
    return linearize(ode.bindings, ode.rates, {state.name for state in ode.states})


def linearize(
    definitions: Iterable[Definition], rows: Sequence[Row | Rate], columns: Collection[str]
) -> Jacobian:
    """Return the derivatives of ``rows`` by ``columns``, through the definitions.

    Parameters
    ----------
    definitions : iterable of Definition
        In an order that computes. Multipliers of set-valued terms are constants,
        unless they are among the columns.
    rows : sequence of Row
        What to derive: rates, or anything of the same shape.
    columns : collection of str
        Names of states, inputs, parameters or multipliers.
    """
    chain = _Chain(frozenset(columns), set(columns))
    for item in definitions:
        chain.define(item)
    entries = [entry for row in rows for entry in chain.entries(row)]
    return Jacobian(tuple(chain.emitted), tuple(entries))


@dataclass(slots=True)
class _Chain:
    """The chain rule, one definition after the other; ``moving`` depends on a column."""

    columns: frozenset[str]
    moving: set[str]
    known: dict[str, list[_Dependence]] = field(default_factory=dict)
    variables: dict[str, str | None] = field(default_factory=dict)
    spreads: dict[str, list[_Spread]] = field(default_factory=dict)
    emitted: list[Definition] = field(default_factory=list)
    parts: int = 0

    def define(self, item: Definition) -> None:
        self._note(item)
        match item:
            case Binding(name, value, span):
                self._define(name, self._parted(name, value, span), span)
            case LinearSolve():
                self._define_solve(item)
            case SetValuedTerm():
                pass

    def _note(self, item: Definition) -> None:
        for name in defined(item):
            self.variables[name] = item.range.variable if item.range else None

    def _emit(self, item: Definition) -> None:
        self._note(item)
        self.emitted.append(item)

    def _define(self, name: str, value: Expr, span: IndexRange | None) -> None:
        bands, spread = self._derive(value, span)
        self.known[name] = [
            _Dependence(key, self._named(name, key, terms, span)) for key, terms in bands.items()
        ]
        if spread:
            self._add_hub(name, spread, span)
            self.known[name].append(_Dependence(_own(name, span), ONE))
        if self.known[name]:
            self.moving.add(name)

    def _parted(self, name: str, value: Expr, span: IndexRange | None) -> Expr:
        """Return a value whose larger arguments have become definitions of their own."""

        def named(part: Expr) -> Name:
            self.parts += 1
            label = f"{name}.part{self.parts}"
            self._emit(Binding(label, part, span, role="part", span=part.span))
            self._define(label, part, span)
            return _own(label, span)

        return with_parts(value, named, self._varies)

    def _varies(self, expr: Expr) -> bool:
        return any(name.id in self.moving for name in names(expr))

    def _derive(
        self, value: Expr, span: IndexRange | None
    ) -> tuple[dict[Name, list[Expr]], list[_Spread]]:
        """Return the terms of each band, and what is spread over a sum."""
        bands: dict[Name, list[Expr]] = {}
        spread: list[_Spread] = []
        taken = frozenset({span.variable}) if span else frozenset()
        for partial in partials(value, taken, self.moving):
            for key, inner in self._through(partial.name):
                term = self._guarded(partial, inner)
                kept, summed_up = _split(partial, key)
                term = summed(summed_up, term)
                if kept:
                    spread.append(_Spread(key, term, kept))
                else:
                    bands.setdefault(key, []).append(term)
        return bands, spread

    def _guarded(self, partial: Partial, inner: Expr) -> Expr:
        """Multiply by the slope behind a partial, which stays unlooked at in a dead branch.

        A product of parameters is finite and may stand outside, so that columns share the
        branch.
        """
        if is_small(partial.coefficient, _SHORT) or not all(map(self._is_given, walk(inner))):
            return guarded(partial.where, times(partial.coefficient, inner))
        return times(guarded(partial.where, partial.coefficient), inner)

    def _is_given(self, node: Expr) -> bool:
        match node:
            case Name(name):
                return name not in self.variables and name not in self.columns
            case Call(function):
                return function in ("*", "neg")
            case _:
                return isinstance(node, Number)

    def _through(self, name: Name) -> Iterator[_Dependence]:
        """Yield what a name depends on, at the element where it is read."""
        if name.id in self.columns:
            yield _Dependence(name, ONE)
        variable = self.variables.get(name.id)
        for key, value in self.known.get(name.id, ()):
            if variable is None or name.at is None:
                yield _Dependence(key, value)
            else:
                at = moved(key.at, variable, name.at)
                yield _Dependence(Name(key.id, at), shifted(value, variable, name.at))

    def _named(self, name: str, key: Name, terms: list[Expr], span: IndexRange | None) -> Expr:
        """Return a derivative under a name of its own, unless it is short."""
        value = add(*terms)
        # In a family a quotient of parameters gets a name: inside a branch it could not leave
        # the loop.
        if is_small(value, _SHORT if span is None else 1) and not _is_element(value):
            return value
        label = derivative_name(name, key)
        self._emit(Binding(label, value, span, role="part", span=value.span))
        return _own(label, span)

    def _add_hub(self, name: str, spread: list[_Spread], span: IndexRange | None) -> None:
        if span is None:
            spread = [self._hoisted(name, n, item) for n, item in enumerate(spread)]
        self.spreads[name] = spread

    def _hoisted(self, name: str, number: int, spread: _Spread) -> _Spread:
        """Compute what a scalar hub depends on once, not once for each reader."""
        if len(spread.over) > 1 or isinstance(spread.value, Number | Name):
            return spread
        (over,) = spread.over
        label = f"{name}.d{number}.{spread.column.id}"
        self._emit(Binding(label, spread.value, over, role="part"))
        return spread._replace(value=_own(label, over))

    def _define_solve(self, solve: LinearSolve) -> None:
        """``M u = r`` gives ``M du = dr - dM u`` for each name that M and r depend on."""
        columns: dict[Name, dict[int, Expr]] = {}
        for number, (row, right) in enumerate(zip(solve.matrix, solve.right, strict=True)):
            known = (_own(unknown, solve.range) for unknown in solve.unknowns)
            products = [negate(multiply(a, u)) for a, u in zip(row, known, strict=True)]
            value = self._parted(solve.unknowns[number], add(right, *products), solve.range)
            bands, spread = self._derive(value, solve.range)
            for key, terms in bands.items():
                columns.setdefault(key, {})[number] = add(*terms)
            if spread:
                hub = f"{solve.unknowns[number]}.right"
                self.variables[hub] = solve.range.variable if solve.range else None
                self._add_hub(hub, spread, solve.range)
                columns[_own(hub, solve.range)] = {number: ONE}
        for unknown in solve.unknowns:
            self.known[unknown] = []
        for key, values in columns.items():
            self._emit_solve(solve, key, values)

    def _emit_solve(self, solve: LinearSolve, key: Name, values: dict[int, Expr]) -> None:
        labels = tuple(derivative_name(unknown, key) for unknown in solve.unknowns)
        right = tuple(values.get(number, ZERO) for number in range(len(labels)))
        self._emit(LinearSolve(labels, solve.matrix, right, solve.range, span=solve.span))
        for unknown, label in zip(solve.unknowns, labels, strict=True):
            self.known[unknown].append(_Dependence(key, _own(label, solve.range)))
            self.moving.add(unknown)

    def entries(self, row: Row | Rate) -> Iterator[Entry]:
        value = self._parted(f"{row.state}.rate", row.value, row.range)
        bands, spread = self._derive(value, row.range)
        ranges = (row.range,) if row.range else ()
        own = _own(row.state, row.range)
        for key, terms in bands.items():
            yield from self._spread_out(Entry(own, key, add(*terms), ranges))
        for column, value, over in spread:
            yield from self._spread_out(Entry(own, column, value, (*ranges, *over)))

    def _spread_out(self, entry: Entry) -> Iterator[Entry]:
        """Replace a hub by the elements that it depends on."""
        hub = entry.column
        if hub.id not in self.spreads:
            yield entry
            return
        taken = frozenset(span.variable for span in entry.ranges)
        for item in self.spreads[hub.id]:
            column, value, over = _renamed(item, taken)
            own = self.variables[hub.id]
            if own is not None and hub.at is not None:
                column = Name(column.id, moved(column.at, own, hub.at))
                value = shifted(value, own, hub.at)
            yield from self._spread_out(
                Entry(entry.row, column, times(entry.value, value), (*entry.ranges, *over))
            )


def _is_element(expr: Expr) -> bool:
    return isinstance(expr, Name) and expr.at is not None


def _own(name: str, span: IndexRange | None) -> Name:
    return Name(name, Index(span.variable) if span else None)


def _split(partial: Partial, key: Name) -> tuple[tuple[IndexRange, ...], tuple[IndexRange, ...]]:
    """Return the ranges that select the key's element, and those that are summed up."""
    selects = key.at.variable if key.at else None
    kept = tuple(span for span in partial.over if span.variable == selects)
    return kept, tuple(span for span in partial.over if span.variable != selects)


def _renamed(spread: _Spread, taken: frozenset[str]) -> _Spread:
    column, value, over = spread
    renamed = []
    for span in over:
        fresh = fresh_range(span, taken)
        if fresh.variable != span.variable:
            fresh = fresh_range(fresh, taken | index_variables(value))
            to = Index(fresh.variable)
            column = Name(column.id, moved(column.at, span.variable, to))
            value = shifted(value, span.variable, to)
        renamed.append(fresh)
    return _Spread(column, value, tuple(renamed))


def derivative_name(name: str, by: Name) -> str:
    """Return the name of d(name)/d(by): it tells bands from fixed elements."""
    match by.at:
        case None:
            return f"{name}.d.{by.id}"
        case Index(None, offset):
            return f"{name}.d.{by.id}.at{_signed(offset)}"
        case Index(_, offset):
            return f"{name}.d.{by.id}.to{_signed(offset)}"


def _signed(offset: int) -> str:
    return f"m{-offset}" if offset < 0 else str(offset)
