"""Embedded pairs: Runge-Kutta methods that choose their step by an estimate of the error.

``PAIRS`` holds every pair by name. A further one is a file and an entry here.
"""

from __future__ import annotations

from nsode.integrators.dopri5 import DOPRI5
from nsode.integrators.embedded import EmbeddedPair

__all__ = ["PAIRS", "EmbeddedPair"]

#: Every pair by name.
PAIRS: dict[str, EmbeddedPair] = {pair.name: pair for pair in (DOPRI5,)}
