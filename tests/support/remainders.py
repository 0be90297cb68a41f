"""What ``mod(a, b)`` is, by hand: the remainder has the sign of the divisor."""

from __future__ import annotations

from math import inf, nan

REMAINDERS = [
    (-1.5, 2, 0.5),
    (1.5, -2, -0.5),
    (5.5, 2, 1.5),
    (-4, 2, 0),
    (1, 0.1, 0.1 - 2.0**-54),  # a little less than ten times: 0.1 is a little more
    (3, 0, nan),
    (-5, inf, inf),
]
