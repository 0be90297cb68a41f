"""Dormand and Prince (1980) 5(4), with the dense output of Hairer, Norsett and Wanner."""

from __future__ import annotations

from fractions import Fraction as Q

from nsode.integrators.embedded import EmbeddedPair
from nsode.integrators.scheme import RungeKutta

_B = (Q(35, 384), Q(0), Q(500, 1113), Q(125, 192), Q(-2187, 6784), Q(11, 84))

DOPRI5 = EmbeddedPair(
    RungeKutta(
        name="dopri5",
        title="Dormand-Prince 5(4)",
        order=5,
        a=(
            (),
            (Q(1, 5),),
            (Q(3, 40), Q(9, 40)),
            (Q(44, 45), Q(-56, 15), Q(32, 9)),
            (Q(19372, 6561), Q(-25360, 2187), Q(64448, 6561), Q(-212, 729)),
            (Q(9017, 3168), Q(-355, 33), Q(46732, 5247), Q(49, 176), Q(-5103, 18656)),
            _B,
        ),
        b=(*_B, Q(0)),
        c=(Q(0), Q(1, 5), Q(3, 10), Q(4, 5), Q(8, 9), Q(1), Q(1)),
    ),
    error=(
        Q(71, 57600), Q(0), Q(-71, 16695), Q(71, 1920), Q(-17253, 339200), Q(22, 525), Q(-1, 40),
    ),
    dense=(
        Q(-12715105075, 11282082432), Q(0), Q(87487479700, 32700410799),
        Q(-10690763975, 1880347072), Q(701980252875, 199316789632),
        Q(-1453857185, 822651844), Q(69997945, 29380423),
    ),
)  # fmt: skip
