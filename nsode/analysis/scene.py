"""A differential inclusion made ready to be looked at: multipliers, gaps, slips, factors.

The derivatives are formed once, as expressions; :meth:`Scene.at` evaluates them at a point.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from nsode.analysis.local import LAW, Constants, Element, Local
from nsode.analysis.point import Matrix, Point, Vector, assemble, parameters, start
from nsode.derivative import Entry, Jacobian, Row, linearize, time_derivatives
from nsode.expr import TIME, Expr, Number, names
from nsode.ode import (
    Binding,
    Definition,
    DifferentialInclusion,
    LinearSolve,
    Parameter,
    Rate,
    SetValuedTerm,
    Slot,
    defined,
    element,
    element_names,
    layout,
)
from nsode.rewrite.constants import constants


class Scene:
    """The derivatives that the analysis of one inclusion rests on.

    ``chosen`` are the constants of the approximation, where they are not the model's.
    """

    def __init__(
        self, inclusion: DifferentialInclusion, chosen: Iterable[Parameter] | None = None
    ) -> None:
        self.inclusion = inclusion
        self.parameters = tuple(constants(inclusion) if chosen is None else chosen)
        self.states = layout(inclusion.states)
        self.state_names = element_names(inclusion.states)
        self.multipliers = _slots(inclusion.terms)
        self.elements = tuple(_elements(inclusion.terms, self.multipliers))
        self.arguments = tuple(_arguments(inclusion.terms))
        self.factors = tuple(_factors(inclusion.terms))
        definitions, velocities = time_derivatives(inclusion, *self._contacts())
        self.definitions: tuple[Definition, ...] = (*inclusion.bindings, *definitions)
        by_name = {row.state: row for row in velocities}
        self.motions = tuple(by_name.get(row.state, row) for row in self.arguments)

    def _contacts(self) -> Iterable[Row]:
        kinds = {name: t.kind for t in self.inclusion.terms for name in t.multiplier}
        return (row for row in self.arguments if kinds[row.state] == "dio")

    @property
    def of_rates(self) -> Jacobian:
        """The derivatives of the rates by states and multipliers."""
        return self._derivatives["rate"]

    @property
    def of_arguments(self) -> Jacobian:
        """The derivatives of psi and theta."""
        return self._derivatives["argument"]

    @property
    def of_motions(self) -> Jacobian:
        """The derivatives of psi' and theta."""
        return self._derivatives["motion"]

    @property
    def of_factors(self) -> Jacobian:
        """The derivatives of chi."""
        return self._derivatives["factor"]

    @cached_property
    def _derivatives(self) -> dict[str, Jacobian]:
        """The derivatives of all four, over the same definitions."""
        groups: dict[str, Sequence[Row | Rate]] = {
            "rate": self.inclusion.rates,
            "argument": self.arguments,
            "motion": self.motions,
            "factor": self.factors,
        }
        rows = [
            Row(f"{group}.{row.state}", row.value, row.range)
            for group, members in groups.items()
            for row in members
        ]
        whole = self._linearized(rows)
        entries: dict[str, list[Entry]] = {group: [] for group in groups}
        for entry in whole.entries:
            group, _, name = entry.row.id.partition(".")
            entries[group].append(entry._replace(row=replace(entry.row, id=name)))
        return {group: Jacobian(whole.definitions, tuple(mine)) for group, mine in entries.items()}

    def _linearized(self, rows: Sequence[Row | Rate]) -> Jacobian:
        return linearize(self.definitions, rows, {*self.states, *self.multipliers})

    @cached_property
    def acts_at_once(self) -> NDArray[np.bool_]:
        """Which multiplier (column) may, at some state, act on the rate of which motion (row)."""
        motion, lift = self._blocks(_marked(self.of_motions), Point(), self.multipliers)
        _, force = self._blocks(_marked(self.of_rates), Point(), self.states)
        acts: NDArray[np.bool_] = (motion @ force + lift) > 0
        return acts

    @cached_property
    def start(self) -> Point:
        """The point where a run starts, without any multiplier."""
        point = start(self.inclusion, self.parameters)
        point.define(self.definitions[len(self.inclusion.bindings) :])
        return point

    @cached_property
    def start_state(self) -> Vector:
        """The state where a run starts."""
        return np.array([v for name in self.states for v in self.start.values[name]])

    @cached_property
    def gaps_bend(self) -> bool:
        """Whether a gap is not affine in the state, or moves with time or an input."""
        contacts = tuple(self._contacts())
        sources = {TIME, *(entry.name for entry in self.inclusion.inputs)}
        return self.moves(self._linearized(contacts)) or any(
            reads(row.value) & self._depending(sources) for row in contacts
        )

    def point(self, x: Sequence[float], t: float = 0.0) -> Point:
        """Return a point from a state vector."""
        point = parameters(self.inclusion, self.parameters)
        point.set(TIME, None, [t])
        for state in self.inclusion.states:
            offset, span = self.states[state.name]
            count = 1 if span is None else len(span)
            point.set(state.name, span, list(x[offset : offset + count]))
        return point

    def at(self, point: Point, forces: Vector | None = None) -> Local:
        """Return the linear model at a point, under given multipliers (0 if None)."""
        with np.errstate(all="ignore"):
            return self._at(Point(dict(point.values), dict(point.first)), forces)

    def _at(self, here: Point, forces: Vector | None) -> Local:
        width = sum(len(e.rows) for e in self.elements)
        self._load(here, np.zeros(width))
        rates, idle = self._rates(here), self._factor(here)
        self._load(here, np.zeros(width) if forces is None else forces)
        here.define(self.of_rates.definitions)
        return Local(
            rates,
            *self._blocks(self.of_rates, here, self.states),
            np.array(self._values(self.arguments, here)),
            np.array(self._values(self.motions, here)),
            self._blocks(self.of_arguments, here, self.multipliers)[0],
            *self._blocks(self.of_motions, here, self.multipliers),
            idle,
            self._factor(here),
            *self._blocks(self.of_factors, here, self._factor_slots),
        )

    def _load(self, here: Point, forces: Vector) -> None:
        for name, slot in self.multipliers.items():
            count = 1 if slot.range is None else len(slot.range)
            here.set(name, slot.range, forces[slot.offset : slot.offset + count].tolist())
        here.define(self.definitions)

    def _rates(self, here: Point) -> Vector:
        rates = np.zeros(len(self.state_names))
        for rate in self.inclusion.rates:
            offset, span = self.states[rate.state]
            if span is not None and rate.range is not None:
                offset += rate.range.first - span.first
            values = here.value(rate.value, rate.range)
            rates[offset : offset + len(values)] = values
        return rates

    def _blocks(
        self, jacobian: Jacobian, here: Point, rows: dict[str, Slot]
    ) -> tuple[Matrix, Matrix]:
        """Return the derivatives by the states and by the multipliers."""
        shape = _length(rows.values())
        blocks = []
        for columns in (self.states, self.multipliers):
            entries = [entry for entry in jacobian.entries if entry.column.id in columns]
            block = np.zeros((shape, _length(columns.values())))
            found = assemble(entries, here, rows, columns)
            block[: found.shape[0], : found.shape[1]] = found
            blocks.append(block)
        return blocks[0], blocks[1]

    @cached_property
    def _factor_slots(self) -> dict[str, Slot]:
        slots: dict[str, Slot] = {}
        offset = 0
        for term in self.inclusion.terms:
            slots[term.name] = Slot(offset, term.range)
            offset += 1 if term.range is None else len(term.range)
        return slots

    def _factor(self, here: Point) -> Vector:
        values = np.zeros(len(self.elements))
        for row in self.factors:
            first = self._factor_slots[row.state].offset
            found = here.value(row.value, row.range)
            values[first : first + len(found)] = found
        return values

    def _values(self, rows: Sequence[Row], here: Point) -> list[float]:
        return list(chain.from_iterable(here.value(row.value, row.range) for row in rows))

    @cached_property
    def constants(self) -> tuple[Constants, ...]:
        """The constants of each element."""
        return tuple(self._constants_of(element.term) for element in self.elements)

    def _constants_of(self, term: SetValuedTerm) -> Constants:
        if term.approximation.law != LAW:
            return Constants(np.nan, np.nan, np.nan)
        known = self.start.values

        def value(name: str) -> float:
            return known.get(f"{term.name}.{name}", [np.nan])[0]

        given = Constants(value("K"), value("alpha"), value("beta"))
        if term.kind == "dio" and np.isnan(given.alpha):
            return Constants(np.nan, np.nan, np.nan)
        return given

    def moves(self, jacobian: Jacobian) -> bool:
        """Whether the entries of a Jacobian depend on time, inputs or the state."""
        sources = {*self.states, *self.multipliers, TIME}
        sources |= {entry.name for entry in self.inclusion.inputs}
        moving = self._depending(sources, jacobian.definitions)
        return any(reads(entry.value) & moving for entry in jacobian.entries)

    def _depending(self, sources: set[str], further: Sequence[Definition] = ()) -> set[str]:
        """Return the sources and every definition that reads one of them."""
        moving = set(sources)
        for item in (*self.definitions, *further):
            if any(reads(expr) & moving for expr in _expressions(item)):
                moving.update(defined(item))
        return moving


def reads(expr: Expr) -> set[str]:
    """Return the names that an expression reads."""
    return {name.id for name in names(expr)}


def _marked(jacobian: Jacobian) -> Jacobian:
    """Return the Jacobian with 1 in every place that holds an entry."""
    entries = tuple(entry._replace(value=Number(1.0)) for entry in jacobian.entries)
    return Jacobian((), entries)


def _expressions(item: Definition) -> Iterable[Expr]:
    match item:
        case Binding(value=value):
            return (value,)
        case LinearSolve(matrix=matrix, right=right):
            return (*chain.from_iterable(matrix), *right)
        case SetValuedTerm():
            return ()


def _slots(terms: Sequence[SetValuedTerm]) -> dict[str, Slot]:
    slots: dict[str, Slot] = {}
    offset = 0
    for term in terms:
        for name in term.multiplier:
            slots[name] = Slot(offset, term.range)
            offset += 1 if term.range is None else len(term.range)
    return slots


def _elements(terms: Sequence[SetValuedTerm], slots: dict[str, Slot]) -> Iterable[Element]:
    number = 0
    for term in terms:
        span = term.range
        for place in range(1 if span is None else len(span)):
            name = term.name if span is None else element(term.name, span.first + place)
            rows = tuple(slots[multiplier].offset + place for multiplier in term.multiplier)
            yield Element(name, term, rows, number)
            number += 1


def _arguments(terms: Sequence[SetValuedTerm]) -> Iterable[Row]:
    for term in terms:
        for name, argument in zip(term.multiplier, term.argument, strict=True):
            yield Row(name, argument, term.range)


def _factors(terms: Sequence[SetValuedTerm]) -> Iterable[Row]:
    return (Row(t.name, t.factor, t.range) for t in terms if t.factor is not None)


def _length(slots: Iterable[Slot]) -> int:
    ends = (s.offset + (1 if s.range is None else len(s.range)) for s in slots)
    return max(ends, default=0)
