"""CasADi functions of an augmented ODE, and the files that hand them on.

Values and Jacobians are finite at rest, in free flight and in both at once. Families
are columns. CasADi itself is imported where a function here is called.
"""

from __future__ import annotations

from nsode.backends import Options
from nsode.backends.casadi.model import CasadiModel
from nsode.diagnostics import Diagnostic, ModelError
from nsode.integrators import REGISTRY, RungeKutta
from nsode.ode import AugmentedODE

__all__ = ["CasadiModel", "emit", "functions"]


def functions(ode: AugmentedODE, method: str = "rk4") -> CasadiModel:
    """Return the functions of an ODE; ``step`` is that of an explicit Runge-Kutta method.

    Raises
    ------
    ValueError
        If the method has no tableau.
    """
    scheme = REGISTRY.get(method)
    if not isinstance(scheme, RungeKutta):
        known = ", ".join(name for name, s in REGISTRY.items() if isinstance(s, RungeKutta))
        raise ValueError(f"`{method}` is no explicit Runge-Kutta method; there are {known}")
    from nsode.backends.casadi.build import build

    return build(ode, scheme)


def emit(ode: AugmentedODE, options: Options) -> dict[str, str]:
    """Return ``PREFIX.casadi``, the serialized functions, and ``PREFIX_casadi.py``, a loader.

    Raises
    ------
    ModelError
        If single precision is asked for.
    """
    if options.real != "double":
        message = "CasADi computes in double precision only"
        raise ModelError([Diagnostic("NS603", message, help="leave out `--real float`")])
    model = functions(ode)
    from nsode.backends.casadi.files import files

    return files(model, ode, options.prefix or ode.name)
