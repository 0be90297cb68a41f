"""One-step methods, one file each; a backend writes any scheme whose kind it knows.

``REGISTRY`` holds every method by name. A further one is a file and an entry here.
"""

from __future__ import annotations

from nsode.integrators.euler import EULER
from nsode.integrators.heun import HEUN
from nsode.integrators.rk4 import RK4
from nsode.integrators.scheme import RungeKutta, Scheme, register

__all__ = ["REGISTRY", "RungeKutta", "Scheme"]

#: Every method by name, the default first.
REGISTRY: dict[str, Scheme] = register(RK4, HEUN, EULER)
