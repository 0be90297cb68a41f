"""The explicit Euler method."""

from __future__ import annotations

from fractions import Fraction

from nsode.integrators.scheme import RungeKutta

EULER = RungeKutta(
    name="euler",
    title="explicit Euler",
    order=1,
    a=((),),
    b=(Fraction(1),),
    c=(Fraction(0),),
)
