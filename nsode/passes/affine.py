"""Affine forms of indices: a constant, and a slope for each index variable."""

from __future__ import annotations

from fractions import Fraction
from math import isfinite

from nsode.expr import Call, Expr, Index, Number

#: The slope of each index, and the constant under None.
Affine = dict[str | None, Fraction]


def difference(left: Expr, right: Expr) -> Affine | None:
    """Return ``left - right``; None if one of them is not affine."""
    a, b = _affine(left), _affine(right)
    return None if a is None or b is None else _combine(a, b, Fraction(-1))


def _combine(a: Affine, b: Affine, factor: Fraction) -> Affine:
    total = {v: a.get(v, Fraction(0)) + factor * b.get(v, Fraction(0)) for v in (*a, *b)}
    return {v: slope for v, slope in total.items() if v is None or slope}


def _affine(expr: Expr) -> Affine | None:
    """Return the form of an expression; None if it has none."""
    match expr:
        case Number(value) if isfinite(value):
            return {None: Fraction(value)}
        case Index(None, offset):
            return {None: Fraction(offset)}
        case Index(str() as variable, offset):
            return {None: Fraction(offset), variable: Fraction(1)}
        case Call("neg", (inner,)):
            return _scaled(_affine(inner), Fraction(-1))
        case Call("+", terms):
            return _affine_sum(terms)
        case Call("*", (left, right)):
            a, b = _affine(left), _affine(right)
            if a is not None and b is not None and len(a) > 1:
                a, b = b, a
            return _scaled(b, a[None]) if a is not None and len(a) == 1 else None
        case Call("/", (left, right)):
            divisor = _affine(right)
            if divisor is None or len(divisor) > 1 or not divisor[None]:
                return None
            return _scaled(_affine(left), 1 / divisor[None])
        case _:
            return None


def _scaled(a: Affine | None, factor: Fraction) -> Affine | None:
    return None if a is None else _combine({None: Fraction(0)}, a, factor)


def _affine_sum(terms: tuple[Expr, ...]) -> Affine | None:
    total: Affine = {None: Fraction(0)}
    for term in terms:
        part = _affine(term)
        if part is None:
            return None
        total = _combine(total, part, Fraction(1))
    return total
