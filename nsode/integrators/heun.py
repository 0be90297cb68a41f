"""Heun's method: an Euler step, then the mean of the slopes at both ends."""

from __future__ import annotations

from fractions import Fraction

from nsode.integrators.scheme import RungeKutta

HEUN = RungeKutta(
    name="heun",
    title="Heun",
    order=2,
    a=((), (Fraction(1),)),
    b=(Fraction(1, 2), Fraction(1, 2)),
    c=(Fraction(0), Fraction(1)),
)
