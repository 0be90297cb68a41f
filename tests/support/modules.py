"""Generated Python, loaded for a test."""

from __future__ import annotations

from types import ModuleType

from nsode.backends import Options, emit
from nsode.ode import AugmentedODE


def load_module(ode: AugmentedODE, **options: str) -> ModuleType:
    """Return the NumPy module of an ODE, run as Python runs a file."""
    [(name, text)] = emit("numpy", ode, Options(**options)).items()
    module = ModuleType(name.removesuffix(".py"))
    exec(compile(text, name, "exec"), module.__dict__)
    return module
