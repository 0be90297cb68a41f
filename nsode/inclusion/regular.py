"""A mass matrix that is provably singular is refused when the model is compiled."""

from __future__ import annotations

from collections.abc import Sequence

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.expr import Expr
from nsode.inclusion.equations import Row
from nsode.inclusion.start import Constants
from nsode.inclusion.values import is_zero
from nsode.ode import LinearSolve


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
    numbers = [known.of_all(row) for row in system.matrix]
    rows = [row for row in numbers if row is not None]
    if len(rows) == len(numbers) and _is_singular(rows):
        places = {row.span for row in group}
        raise refuse(
            "NS113",
            "the mass matrix is singular",
            group[-1].span,
            "this row follows from the others" if len(places) > 1 else "its rows are dependent",
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
