"""From rows to the rate of every state, and to linear systems where rows couple."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain

from nsode.diagnostics import ModelError, refuse
from nsode.expr import (
    Call,
    Expr,
    Index,
    IndexRange,
    Name,
    Number,
    divide,
    names,
    negate,
)
from nsode.inclusion.coverage import check_coverage, doubled
from nsode.inclusion.equations import (
    Row,
    Unknown,
    aligned,
    derivative_name,
    free_index,
    is_unknown,
    reindexed,
    scaled_by,
    state_of,
)
from nsode.inclusion.fitting import choose_until
from nsode.inclusion.known import Constants
from nsode.inclusion.matching import Matching
from nsode.inclusion.regular import check_regular
from nsode.inclusion.values import is_zero, total
from nsode.ode import Binding, LinearSolve, Parameter, Rate, State


def solve(
    rows: Sequence[Row],
    states: Sequence[State],
    parameters: Sequence[Parameter] = (),
    definitions: Sequence[Binding] = (),
) -> tuple[list[Binding | LinearSolve], list[Rate]]:
    """Return the rate of every state, and what must be computed on the way.

    A row with one derivative is divided by its coefficient. A row with more reads those
    that other rows say by their names; rows that stay coupled become one linear system.

    Raises
    ------
    ModelError
        NS107 and NS108 for missing and doubled equations, NS113 for a coefficient that
        is zero, NS112 for systems that couple elements of a family.
    """
    matching = Matching(rows)
    groups = [[_known_aside(rows[k], matching.open[k]) for k in g] for g in matching.match()]
    systems = [_system(group) for group in groups]
    known = Constants.of(parameters, definitions)
    for system, group in zip(systems, groups, strict=True):
        check_regular(system, known, group)
    said = [_said(rows[k], unknown) for k, unknown in sorted(matching.said.items())]
    solved = [
        rate
        for system, group in zip(systems, groups, strict=True)
        for rate in _solved(system, group)
    ]
    check_coverage([*said, *solved], states)
    parts = chain((rate.value for rate in said), *map(_entries, systems))
    read = {name.id for part in parts for name in names(part) if is_unknown(name)}
    read.difference_update(*(system.unknowns for system in systems))
    bindings, rates = _named(said, read, {state.name: state for state in states})
    return [*systems, *bindings], [*rates, *solved]


def _solved(system: LinearSolve, group: Sequence[Row]) -> Iterator[Rate]:
    """Yield the rates that a linear system defines."""
    for unknown, row in zip(system.unknowns, group, strict=True):
        value = _element(unknown, system.range)
        yield Rate(state_of(value), value, system.range, span=row.span)


def _element(name: str, over: IndexRange | None) -> Name:
    return Name(name, None if over is None else Index(over.variable))


def _entries(system: LinearSolve) -> Iterator[Expr]:
    return chain(system.right, *system.matrix)


def _known_aside(found: Row, kept: Sequence[Unknown]) -> Row:
    """Return a row with the derivatives that other rows say on its right side."""
    known = [_times(negate(c), u) for u, c in found.coefficients if u not in kept]
    left = tuple((u, c) for u, c in found.coefficients if u in kept)
    return replace(found, coefficients=left, right=total((found.right, *known)))


def _times(coefficient: Expr, unknown: Unknown) -> Expr:
    match coefficient:
        case Call("neg", (inner,)):
            return negate(scaled_by(inner, unknown))
    return scaled_by(coefficient, unknown)


def _said(found: Row, unknown: Unknown) -> Rate:
    """Return the rate that a row says, once its other derivatives are known."""
    _check_elements(found, unknown)
    row = aligned(_known_aside(found, [unknown]))
    coefficient = row.coefficients[0][1]
    if is_zero(coefficient):
        raise refuse("NS113", "the coefficient of `der` is zero", row.span)
    value = row.right
    if not is_zero(value) and not (isinstance(coefficient, Number) and coefficient.value == 1.0):
        value = divide(row.right, coefficient)
    over = row.range
    if unknown.at is not None and unknown.at.variable is None:
        over = IndexRange("i", unknown.at.offset, unknown.at.offset)
    return Rate(state_of(unknown), value, over, span=row.span)


def _check_elements(found: Row, unknown: Unknown) -> None:
    if any(other.id == unknown.id and other != unknown for other in found.unknowns):
        raise _elements_couple(unknown)
    if found.range is not None and (unknown.at is None or unknown.at.variable is None):
        raise refuse(
            "NS108",
            f"`der({state_of(unknown)})` is given once for each `{found.range.variable}`",
            found.span,
            "one equation for each index",
            help="write it without `for`, with `sum(...)` if it adds up elements",
        )


def _elements_couple(unknown: Unknown) -> ModelError:
    return refuse(
        "NS112",
        "equations that couple elements of a family cannot be solved",
        unknown.span,
        "another element than its row's",
        help="write the few elements out as states of their own",
    )


def _named(
    rates: Sequence[Rate], read: Container[str], states: Mapping[str, State]
) -> tuple[list[Binding], list[Rate]]:
    """Give names to the rates that others read; the pieces of a family become one value."""
    together: dict[str, list[Rate]] = {}
    for rate in rates:
        together.setdefault(rate.state, []).append(rate)
    bindings: list[Binding] = []
    found: list[Rate] = []
    for state, pieces in together.items():
        name = derivative_name(state)
        if name not in read:
            found.extend(pieces)
            continue
        whole = pieces[0] if len(pieces) == 1 else _whole(pieces, states[state])
        bindings.append(Binding(name, whole.value, whole.range, "part", span=whole.span))
        found.append(replace(whole, value=_element(name, whole.range)))
    return bindings, found


def _whole(pieces: Sequence[Rate], state: State) -> Rate:
    """Return the rate of a whole family as a choice by the index."""
    assert state.range is not None
    index = free_index(state.range.variable, (piece.value for piece in pieces))
    ranges = [(p.range, p) for p in pieces if p.range is not None]
    parts = sorted(((over.last, p) for over, p in ranges if len(over)), key=lambda part: part[0])
    value = choose_until([(last, _value(p, index)) for last, p in parts], index)
    over = IndexRange(index, state.range.first, state.range.last)
    return Rate(state.name, value, over, span=pieces[0].span)


def _value(rate: Rate, index: str) -> Expr:
    assert rate.range is not None
    return reindexed(rate.value, rate.range.variable, index)


def _system(group: Sequence[Row]) -> LinearSolve:
    rows = _under_one_index(group)
    unknowns = list(dict.fromkeys(unknown for row in rows for unknown in row.unknowns))
    span = rows[0].span
    if len(unknowns) > len(rows):
        listed = ", ".join(f"`der({state_of(u)})`" for u in unknowns)
        plural = "s" if len(rows) > 1 else ""
        raise refuse(
            "NS107",
            f"{len(rows)} equation{plural} for {len(unknowns)} derivatives: {listed}",
            span,
            "coupled here",
            help="write one equation for each of these states",
        )
    if len(unknowns) < len(rows):
        raise doubled(state_of(unknowns[-1]), rows[-1].span, rows[0].span)
    zero = Number(0.0, span=span)
    entries = [dict(row.coefficients) for row in rows]
    matrix = tuple(tuple(row.get(unknown, zero) for unknown in unknowns) for row in entries)
    right = tuple(row.right for row in rows)
    return LinearSolve(tuple(u.id for u in unknowns), matrix, right, rows[0].range, span=span)


def _under_one_index(group: Sequence[Row]) -> list[Row]:
    """Return the rows with one name for their index; they must have one range."""
    over = group[0].range
    if over is not None:
        parts = [part for row in group for part in (row.right, *(c for _, c in row.coefficients))]
        over = IndexRange(free_index(over.variable, parts), over.first, over.last)
    rows = [_indexed(row, over) for row in group]
    for row in rows:
        for unknown in row.unknowns:
            if row.range != over or unknown != _element(unknown.id, over):
                raise _elements_couple(unknown)
    return rows


def _indexed(row: Row, over: IndexRange | None) -> Row:
    if row.range is None or over is None:
        return row
    old, new = row.range.variable, over.variable

    def moved(expr: Expr) -> Expr:
        return reindexed(expr, old, new)

    return row.changed(moved, IndexRange(new, row.range.first, row.range.last))
