"""The augmented ODE as SymPy objects, for a person to explore.

It stands on no path from text to code, and nothing of it is ever evaluated from a
string. SymPy is imported when :func:`system` is called.
"""

from __future__ import annotations

from nsode.backends.sympy.system import Solve, SymbolicSystem
from nsode.diagnostics import Diagnostic, ModelError
from nsode.ode import AugmentedODE

__all__ = ["Solve", "SymbolicSystem", "system"]


def system(ode: AugmentedODE) -> SymbolicSystem:
    """Return an ODE as SymPy objects.

    Raises
    ------
    ModelError
        If SymPy is not installed.
    """
    try:
        import sympy  # noqa: F401
    except ImportError as error:
        way_out = "install it with `pip install nsode[sympy]`"
        raise ModelError([Diagnostic("NS603", "SymPy is not installed", help=way_out)]) from error
    from nsode.backends.sympy.build import build

    return build(ode)
