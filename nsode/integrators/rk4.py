"""The classical Runge-Kutta method, the paper's choice and the default."""

from __future__ import annotations

from fractions import Fraction

from nsode.integrators.scheme import RungeKutta

_HALF = Fraction(1, 2)

RK4 = RungeKutta(
    name="rk4",
    title="classical Runge-Kutta",
    order=4,
    a=((), (_HALF,), (Fraction(0), _HALF), (Fraction(0), Fraction(0), Fraction(1))),
    b=(Fraction(1, 6), Fraction(1, 3), Fraction(1, 3), Fraction(1, 6)),
    c=(Fraction(0), _HALF, _HALF, Fraction(1)),
)
