"""Splittings: methods that treat positions, velocities and auxiliary states each in its way.

``SPLITTINGS`` holds every one by name. A further one is a file and an entry here.
"""

from __future__ import annotations

from nsode.integrators.verlet import VERLET, Verlet

__all__ = ["SPLITTINGS", "Verlet"]

#: Every splitting by name.
SPLITTINGS: dict[str, Verlet] = {method.name: method for method in (VERLET,)}
