"""From rows to the rate of every state, and to linear systems where rows couple."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.evaluate import evaluate
from nsode.expr import Expr, Index, IndexRange, Name, Number, add, divide, names, negate
from nsode.inclusion.coverage import check_coverage, doubled
from nsode.inclusion.equations import (
    Row,
    Unknown,
    derivative_name,
    is_unknown,
    scaled_by,
    state_of,
)
from nsode.inclusion.values import is_zero
from nsode.ode import Binding, LinearSolve, Parameter, Rate, State


def solve(
    rows: Sequence[Row], states: Sequence[State], parameters: Sequence[Parameter] = ()
) -> tuple[list[Binding | LinearSolve], list[Rate]]:
    """Return the rate of every state, and what must be computed on the way.

    Rows with one derivative are divided; a row that also reads derivatives found that
    way reads them as names; rows that stay coupled become one linear system.

    Raises
    ------
    ModelError
        NS107 and NS108 for missing and doubled equations, NS113 for a coefficient that
        is zero, NS112 for systems that couple elements of a family.
    """
    bindings: list[Binding | LinearSolve] = []
    rates: list[Rate] = []
    open_rows = list(rows)
    solved: dict[Unknown, Rate] = {}
    while True:
        single = [r for r in open_rows if len(r.unknowns) == 1]
        if not single:
            break
        for found in single:
            rate = _single(found)
            rates.append(rate)
            solved.setdefault(found.unknowns[0], rate)
        open_rows = [r for r in open_rows if len(r.unknowns) > 1]
        open_rows = [_substitute(r, solved) for r in open_rows]
    for group in _coupled(open_rows):
        system = _system(group)
        _check_rank(system.matrix, {p.name: p.values for p in parameters}, group)
        bindings.append(system)
        rates.extend(
            Rate(state_of(unknown), unknown, group[0].range, span=r.span)
            for unknown, r in zip(_unknowns(group), group, strict=True)
        )
    check_coverage(rates, states)
    named = {name.id for item in bindings for name in _reads(item) if is_unknown(name)}
    named |= {name.id for r in rates for name in names(r.value) if is_unknown(name)}
    defined = {u for item in bindings if isinstance(item, LinearSolve) for u in item.unknowns}
    for k, rate in enumerate(rates):
        name = derivative_name(rate.state)
        if name in named - defined:
            bindings.append(Binding(name, rate.value, rate.range, "part", span=rate.span))
            at = None if rate.range is None else Index(rate.range.variable)
            rates[k] = replace(rate, value=Name(name, at, span=rate.span))
    return bindings, rates


def _reads(item: Binding | LinearSolve) -> list[Name]:
    if isinstance(item, Binding):
        return list(names(item.value))
    return [name for part in (*item.right, *sum(item.matrix, ())) for name in names(part)]


def _single(found: Row) -> Rate:
    unknown, coefficient = found.coefficients[0]
    if is_zero(coefficient):
        raise refuse("NS113", "the coefficient of `der` is zero", found.span)
    value = found.right
    if not is_zero(value) and not (isinstance(coefficient, Number) and coefficient.value == 1.0):
        value = divide(found.right, coefficient)
    range = found.range
    if unknown.at is not None and unknown.at.variable is None:
        k = unknown.at.offset
        range = IndexRange("i", k, k)
    return Rate(state_of(unknown), value, range, span=found.span)


def _substitute(found: Row, solved: Mapping[Unknown, Rate]) -> Row:
    right = found.right
    kept: list[tuple[Unknown, Expr]] = []
    for unknown, coefficient in found.coefficients:
        if unknown in solved and solved[unknown].range == found.range:
            right = add(right, negate(scaled_by(coefficient, unknown)))
        else:
            kept.append((unknown, coefficient))
    if not kept:
        raise doubled(state_of(found.unknowns[0]), found.span, solved[found.unknowns[0]].span)
    return replace(found, coefficients=tuple(kept), right=right)


def _coupled(rows: Sequence[Row]) -> list[list[Row]]:
    """Group rows that share derivatives."""
    groups: list[tuple[set[Unknown], list[Row]]] = []
    for found in rows:
        mine, together = set(found.unknowns), [found]
        apart = []
        for unknowns, members in groups:
            if unknowns & mine:
                mine |= unknowns
                together = members + together
            else:
                apart.append((unknowns, members))
        groups = [*apart, (mine, together)]
    return [members for _, members in groups]


def _unknowns(group: Sequence[Row]) -> list[Unknown]:
    return list(dict.fromkeys(unknown for r in group for unknown in r.unknowns))


def _system(group: Sequence[Row]) -> LinearSolve:
    unknowns = _unknowns(group)
    span = group[0].span
    if len(unknowns) > len(group):
        listed = ", ".join(f"`der({state_of(u)})`" for u in unknowns)
        raise refuse(
            "NS107",
            f"{len(group)} equations for {len(unknowns)} derivatives: {listed}",
            span,
            "coupled here",
            help="every state has one equation",
        )
    if len(unknowns) < len(group):
        raise doubled(state_of(unknowns[-1]), group[-1].span, group[0].span)
    _check_one_index(group)
    zero = Number(0.0, span=span)
    matrix = tuple(
        tuple(dict(r.coefficients).get(unknown, zero) for unknown in unknowns) for r in group
    )
    _check_regular(matrix, group)
    right = tuple(r.right for r in group)
    return LinearSolve(tuple(u.id for u in unknowns), matrix, right, group[0].range, span=span)


def _check_one_index(group: Sequence[Row]) -> None:
    range = group[0].range
    for found in group:
        for unknown in found.unknowns:
            at = unknown.at
            fits = at is None if range is None else at == Index(range.variable)
            if found.range != range or not fits:
                raise refuse(
                    "NS112",
                    "equations that couple elements of a family cannot be solved",
                    unknown.span,
                    "another element than its row's",
                    help="write the few elements out as states of their own",
                )


def _check_regular(matrix: tuple[tuple[Expr, ...], ...], group: Sequence[Row]) -> None:
    for k, entries in enumerate(zip(*matrix, strict=True)):
        if all(is_zero(entry) for entry in entries):
            raise refuse("NS113", f"column {k + 1} of the mass matrix is zero", group[0].span)
    for k, first in enumerate(matrix):
        for j in range(k):
            if matrix[j] == first:
                raise ModelError(
                    [
                        Diagnostic(
                            "NS113",
                            "the mass matrix is singular: two of its rows are equal",
                            (
                                Label(group[k].span, "this row"),
                                Label(group[j].span, "equals this one"),
                            ),
                            help="each equation must say something new about the derivatives",
                        )
                    ]
                )


def _check_rank(
    matrix: tuple[tuple[Expr, ...], ...],
    values: Mapping[str, tuple[float, ...]],
    group: Sequence[Row],
) -> None:
    """Refuse a matrix of parameters alone that is singular at their values."""

    def value(name: str, at: int | None) -> float:
        return values[name][0]

    read = {name.id for row in matrix for entry in row for name in names(entry)}
    if not all(len(values.get(name, ())) == 1 for name in read) or group[0].range is not None:
        return
    numbers = [[evaluate(entry, value) for entry in row] for row in matrix]
    if _is_singular(numbers):
        raise refuse(
            "NS113",
            "the mass matrix is singular",
            group[-1].span,
            "this row follows from the others",
            help="each equation must say something new about the derivatives",
        )


def _is_singular(rows: list[list[float]]) -> bool:
    """Tell whether elimination meets a pivot that is zero up to rounding."""
    scales = [max(map(abs, row)) for row in rows]
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda j: abs(rows[j][k]) / (scales[j] or 1.0))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        scales[k], scales[pivot] = scales[pivot], scales[k]
        if not abs(rows[k][k]) > 1e-14 * scales[k]:
            return True
        for j in range(k + 1, len(rows)):
            factor = rows[j][k] / rows[k][k]
            rows[j] = [a - factor * b for a, b in zip(rows[j], rows[k], strict=True)]
    return False
