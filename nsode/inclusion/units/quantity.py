"""What is known of the unit of a value."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from nsode.dimension import ONE, SECOND, Dimension, inverse, power, product


class Quantity(NamedTuple):
    """The dimension of a value, None where nothing is known of it.

    A flexible value is built of numbers, indices and ``t`` alone. It fits anywhere, and
    only as a factor does its dimension count: that of a number, or of seconds.
    ``text`` is the unit as declared, for messages.
    """

    dimension: Dimension | None
    flexible: bool = False
    text: str | None = None

    @property
    def rigid(self) -> Dimension | None:
        """The dimension that others must agree with, None where they need not."""
        return None if self.flexible else self.dimension

    def __str__(self) -> str:
        if self.dimension is ONE:
            return "dimensionless"
        return f"in `{self.text or self.dimension}`"


UNKNOWN = Quantity(None)
FITTING = Quantity(None, flexible=True)
NUMBER = Quantity(ONE, flexible=True)
CLOCK = Quantity(SECOND, flexible=True)
DIMENSIONLESS = Quantity(ONE)


def times(left: Quantity, right: Quantity) -> Quantity:
    """Return what is known of a product."""
    flexible = left.flexible and right.flexible
    if left.dimension is None or right.dimension is None:
        return FITTING if flexible else UNKNOWN
    if left.dimension is ONE:
        return Quantity(right.dimension, flexible, right.text)
    if right.dimension is ONE:
        return Quantity(left.dimension, flexible, left.text)
    return Quantity(product(left.dimension, right.dimension), flexible)


def over(left: Quantity, right: Quantity) -> Quantity:
    """Return what is known of a quotient."""
    if right.dimension is None or right.dimension is ONE:
        return times(left, right)
    return times(left, Quantity(inverse(right.dimension), right.flexible))


def to_the(base: Quantity, exponent: Fraction) -> Quantity:
    """Return what is known of a power."""
    if base.dimension is None or exponent == 1:
        return base
    return Quantity(power(base.dimension, exponent), base.flexible)
