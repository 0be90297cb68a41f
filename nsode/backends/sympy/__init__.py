"""The augmented ODE as SymPy objects, for a person to explore.

It stands on no path from text to code, and nothing of it is ever evaluated from a
string. SymPy is imported when :func:`system` is called.
"""

from __future__ import annotations

from nsode.backends.sympy.system import Solve, SymbolicSystem
from nsode.ode import AugmentedODE

__all__ = ["Solve", "SymbolicSystem", "system"]


def system(ode: AugmentedODE) -> SymbolicSystem:
    """Return an ODE as SymPy objects."""
    from nsode.backends.sympy.build import build

    return build(ode)
