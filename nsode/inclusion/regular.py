"""A mass matrix that is provably singular is refused when the model is compiled."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.expr import Expr, IndexRange
from nsode.inclusion.equations import Row
from nsode.inclusion.known import Constants
from nsode.inclusion.values import is_zero
from nsode.ode import LinearSolve

#: Parameters that a message shows.
_SHOWN = 4


def check_regular(system: LinearSolve, known: Constants, group: Sequence[Row]) -> None:
    """Refuse a system that no numbers, or not those of the parameters, can solve.

    Raises
    ------
    ModelError
        NS113.
    """
    _check_structure(system.matrix, group)
    _check_rank(system, known, group)


def _check_structure(matrix: tuple[tuple[Expr, ...], ...], group: Sequence[Row]) -> None:
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


def _check_rank(system: LinearSolve, known: Constants, group: Sequence[Row]) -> None:
    """Refuse a matrix of parameters alone that is singular at their values."""
    for at in _indices(system.range):
        rows = _numbers(system, known, at)
        if rows is None:
            return
        if _is_singular(rows):
            elsewhere = _numbers(system, known.elsewhere(), at)
            if elsewhere is None or _is_singular(elsewhere):
                raise _dependent(group)
            raise _singular_here(group, known.read([e for row in system.matrix for e in row], at))


def _indices(over: IndexRange | None) -> Iterator[dict[str, int]]:
    if over is None:
        yield {}
    else:
        yield from ({over.variable: k} for k in range(over.first, over.last + 1))


def _numbers(
    system: LinearSolve, known: Constants, at: Mapping[str, int]
) -> list[list[float]] | None:
    rows = [known.of_all(row, at) for row in system.matrix]
    return None if None in rows else [row for row in rows if row is not None]


def _dependent(group: Sequence[Row]) -> ModelError:
    several = len({row.span for row in group}) > 1
    return refuse(
        "NS113",
        "the mass matrix is singular",
        group[-1].span,
        "this row follows from the others" if several else "its rows are dependent",
        help="each equation must say something new about the derivatives",
    )


def _singular_here(group: Sequence[Row], read: Mapping[str, float]) -> ModelError:
    values = ", ".join(f"`{name}` = {value:g}" for name, value in list(read.items())[:_SHOWN])
    more = ", ..." if len(read) > _SHOWN else ""
    return refuse(
        "NS113",
        f"the mass matrix is singular where {values}{more}",
        group[-1].span,
        "at other values of the parameters it would not be",
        help="check these values, and the entries of the matrix",
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
