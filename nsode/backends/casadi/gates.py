"""Choices whose value and derivative are finite, whatever the branch not taken holds.

CasADi evaluates every branch and multiplies its derivative by 0 or 1, and 0*inf is NaN.
So each operation with a singularity is given an argument that avoids it wherever its
result does not count. NaN goes through; at kinks the derivative is that of one side, as
:mod:`nsode.derivative.rules` states it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import casadi as ca


@contextmanager
def as_written() -> Iterator[None]:
    """Keep CasADi from rewriting ``(x + y) - y`` to ``x`` and ``x/x`` to 1."""
    before = ca.GlobalOptions.getSimplificationOnTheFly()
    ca.GlobalOptions.setSimplificationOnTheFly(False)
    try:
        yield
    finally:
        ca.GlobalOptions.setSimplificationOnTheFly(before)


def where(condition: ca.SX, value: ca.SX) -> ca.SX:
    """Return a value where a condition holds and -0 elsewhere, which adds nothing even to -0."""
    # A single gate; as written it would carry a second one for the zero.
    ca.GlobalOptions.setSimplificationOnTheFly(True)
    try:
        return -ca.if_else(condition, -value, 0)
    finally:
        ca.GlobalOptions.setSimplificationOnTheFly(False)


def choose(condition: ca.SX, then: ca.SX, otherwise: ca.SX) -> ca.SX:
    """Return one of two values."""
    return where(condition, then) + where(ca.logic_not(condition), otherwise)


def maximum(a: ca.SX, b: ca.SX) -> ca.SX:
    """Return the larger; the first where they are equal, NaN where one is NaN."""
    first, second = a >= b, a < b
    return where(first, a) + where(second, b) + where(_neither(first, second), a + b)


def minimum(a: ca.SX, b: ca.SX) -> ca.SX:
    """Return the smaller; the first where they are equal, NaN where one is NaN."""
    first, second = a <= b, a > b
    return where(first, a) + where(second, b) + where(_neither(first, second), a + b)


def _neither(a: ca.SX, b: ca.SX) -> ca.SX:
    return ca.logic_not(ca.logic_or(a, b))


def sat(level: ca.SX, x: ca.SX) -> ca.SX:
    """Return x cut off at a level on both sides; flat in x where the level is 0."""
    inside, above, below = ca.fabs(x) < level, x > 0, x < 0
    slip = ca.logic_not(inside)
    cut = where(ca.logic_and(slip, above), level) - where(ca.logic_and(slip, below), level)
    undefined = ca.logic_or(x != x, level != level)
    return where(inside, x) + cut + where(undefined, x + level)


def shrink(level: ca.SX, n: ca.SX) -> ca.SX:
    """Return the factor by which a vector of norm n is shortened to a level.

    It is 0 where both are 0: the vector is 0 then, and its product flat, as it should be.
    """
    inside = n < level
    slip = ca.logic_not(inside)
    safe = choose(ca.logic_and(slip, n != 0), n, ca.SX(1.0))
    return where(inside, ca.SX(1.0)) + where(slip, level / safe)


def root(x: ca.SX) -> ca.SX:
    """Return the square root, with the derivative 0 at 0."""
    return where(x != 0, ca.sqrt(choose(x != 0, x, ca.SX(1.0))))


def norm(*components: ca.SX) -> ca.SX:
    """Return the Euclidean norm, with the derivative 0 at 0."""
    total = components[0] * components[0]
    for component in components[1:]:
        total = total + component * component
    return root(total)


def angle(y: ca.SX, x: ca.SX) -> ca.SX:
    """Return ``atan2(y, x)``, with the derivative 0 where both are 0."""
    somewhere = ca.logic_or(y != 0, x != 0)
    return where(somewhere, ca.atan2(y, choose(somewhere, x, ca.SX(1.0))))


def inside_unit(function: str, x: ca.SX) -> ca.SX:
    """Return ``asin`` or ``acos``, with the derivative 0 at the ends of the domain."""
    end = ca.fabs(x) == 1
    inner = getattr(ca, function)(choose(end, ca.SX(0.0), x))
    return choose(end, getattr(ca, function)(where(end, ca.sign(x))), inner)


def modulo(a: ca.SX, b: ca.SX) -> ca.SX:
    """Return ``a`` modulo ``b``, with the sign of ``b``."""
    rest = ca.fmod(a, b)
    return rest + where(rest * b < 0, b)


def power(base: ca.SX, exponent: float) -> ca.SX:
    """Return a power with a constant exponent."""
    if exponent == 0.0:
        return ca.SX.ones(base.shape)
    if exponent == 1.0:
        return base
    if exponent == 2.0:
        return base * base
    if 0.0 < exponent < 1.0:
        return where(base != 0, ca.constpow(choose(base != 0, base, ca.SX(1.0)), exponent))
    return ca.constpow(base, exponent)
