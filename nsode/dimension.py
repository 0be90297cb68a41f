"""Dimensions: exponents of the seven SI base units, and how they are shown."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache

BASE = ("kg", "m", "s", "A", "K", "mol", "cd")


@dataclass(frozen=True, slots=True, eq=False)
class Dimension:
    """The exponents of :data:`BASE`. Equal ones are one object (see :func:`dimension`)."""

    exponents: tuple[Fraction, ...]

    def __str__(self) -> str:
        return _shortest(self)


@cache
def dimension(exponents: tuple[Fraction, ...]) -> Dimension:
    """Return the one dimension with these exponents."""
    return Dimension(exponents)


@cache
def base(symbol: str, exponent: Fraction = Fraction(1)) -> Dimension:
    """Return a power of a base unit."""
    return dimension(tuple(exponent if symbol == one else Fraction(0) for one in BASE))


@cache
def product(left: Dimension, right: Dimension) -> Dimension:
    """Return the dimension of a product."""
    pairs = zip(left.exponents, right.exponents, strict=True)
    return dimension(tuple(a + b for a, b in pairs))


@cache
def power(of: Dimension, exponent: Fraction) -> Dimension:
    """Return the dimension of a power."""
    return dimension(tuple(a * exponent for a in of.exponents))


@cache
def inverse(of: Dimension) -> Dimension:
    """Return the dimension of a reciprocal."""
    return power(of, Fraction(-1))


def quotient(left: Dimension, right: Dimension) -> Dimension:
    """Return the dimension of a quotient."""
    return product(left, inverse(right))


ONE = dimension((Fraction(0),) * len(BASE))
SECOND = base("s")
_NEWTON = product(base("kg"), product(base("m"), base("s", Fraction(-2))))
_VOLT = product(product(_NEWTON, base("m")), inverse(product(base("A"), SECOND)))
_MASS, _CURRENT = BASE.index("kg"), BASE.index("A")
_HUGE = 1000


@cache
def _shortest(of: Dimension) -> str:
    """Write a dimension in base units, or with N or V for its mass if that is shorter."""
    if any(max(abs(e.numerator), e.denominator) > _HUGE for e in of.exponents):
        return "a huge power"
    written = [list(zip(BASE, of.exponents, strict=True))]
    if mass := of.exponents[_MASS]:
        symbol, known = ("V", _VOLT) if of.exponents[_CURRENT] else ("N", _NEWTON)
        rest = quotient(of, power(known, mass))
        written.append([(symbol, mass), *zip(BASE, rest.exponents, strict=True)])
    return _text(min(written, key=lambda factors: sum(abs(e) for _, e in factors)))


def simple(of: Dimension) -> bool:
    """Tell whether a dimension is that of one unit, or of a product or quotient of two."""
    return sum(abs(e) for e in of.exponents) <= 2


def _text(factors: list[tuple[str, Fraction]]) -> str:
    over = "*".join(_power(symbol, e) for symbol, e in factors if e > 0)
    under = [_power(symbol, -e) for symbol, e in factors if e < 0]
    if not under:
        return over or "1"
    below = "*".join(under)
    return f"{over or '1'}/{below if len(under) == 1 else f'({below})'}"


def _power(symbol: str, exponent: Fraction) -> str:
    if exponent == 1:
        return symbol
    return f"{symbol}^{exponent}" if exponent.denominator == 1 else f"{symbol}^({exponent})"
