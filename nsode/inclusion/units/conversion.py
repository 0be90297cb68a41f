"""Values in a declared unit become values in SI."""

from __future__ import annotations

import math
from fractions import Fraction

from nsode.diagnostics import refuse
from nsode.evaluate import evaluate
from nsode.expr import Expr, Index, Number, multiply, walk
from nsode.expr import names as reads
from nsode.inclusion.units.reading import measure
from nsode.syntax.ast import Unit


def in_si(value: Expr, unit: Unit | None) -> Expr:
    """Return a value in SI: numbers are converted, anything that reads a name stays.

    The product is that of decimal numbers, rounded once: ``0.3 {mm}`` is ``3e-4``.

    Raises
    ------
    ModelError
        NS008 and NS114 as :func:`~nsode.inclusion.units.reading.measure`; NS116 for a
        value that is too large.
    """
    if unit is None:
        return value
    scale = measure(unit).scale
    if scale == 1 or any(True for _ in reads(value)):
        return value
    if any(isinstance(part, Index) for part in walk(value)):
        return multiply(value, Number(float(scale), span=value.span))
    number = evaluate(value, _no_names)
    if not math.isfinite(number):
        return value
    return Number(_scaled(number, scale, unit), span=value.span)


def _scaled(number: float, scale: Fraction, unit: Unit) -> float:
    try:
        return float(Fraction(repr(number)) * scale)
    except OverflowError:
        raise refuse(
            "NS116",
            f"{number:g} {unit.text} is too large for a double",
            unit.span,
            help="the largest number is 1.8e308: choose other units",
        ) from None


def _no_names(name: str, at: int | None) -> float:
    raise AssertionError(name)
