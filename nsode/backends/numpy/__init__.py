"""A readable Python module that needs NumPy alone.

Families are slices, so the length of the text does not grow with a family. Arithmetic
is IEEE arithmetic: nothing raises or warns, and NaN goes through. The exception is a
singular mass matrix, which raises :class:`numpy.linalg.LinAlgError` as NumPy does.
No text of the model other than its names reaches the module.
"""

from __future__ import annotations

import re

import nsode
from nsode.backends import Options
from nsode.backends.families import ranges
from nsode.backends.jacobian import SparseJacobian, sparse_jacobian
from nsode.backends.numpy import jacobian
from nsode.backends.numpy.functions import Writer
from nsode.backends.numpy.helpers import HELPERS
from nsode.backends.numpy.lower import Environment, lower
from nsode.backends.numpy.names import module_stem, python_names
from nsode.backends.numpy.steps import steps
from nsode.backends.numpy.tables import tables
from nsode.expr import TIME
from nsode.ode import AugmentedODE
from nsode.passes.split import split

__all__ = ["emit", "environment", "lower"]

_REAL = {"double": "float64", "float": "float32"}


def emit(ode: AugmentedODE, options: Options) -> dict[str, str]:
    """Return the module as ``{"PREFIX.py": text}``.

    It has ``rhs(t, x, u, p)``, ``jac``, ``out``, ``init`` and a ``step_*`` for each integrator
    that has a tableau; ``u`` and ``p`` may be left out for their defaults.
    """
    stem = module_stem(options.prefix or ode.name)
    return {f"{stem}.py": _module(stem, sparse_jacobian(ode), _REAL[options.real])}


def environment(ode: AugmentedODE) -> Environment:
    """Return what the names of a split ODE mean."""
    found = ranges(ode)
    spelling = python_names(name for name in found if name != TIME)
    return Environment({**spelling, TIME: TIME}, found)


def _module(stem: str, sparse: SparseJacobian, real: str) -> str:
    ode = split(sparse.ode)
    writer = Writer(ode, environment(ode))
    functions = "\n\n\n".join(
        [
            _function(_RHS, "x, u, p", writer.rhs(), "dx"),
            _function(_OUT, "x, u, p", writer.out(), "y"),
            *_jacobian(writer, sparse),
            _function(_INIT, "np.zeros(NX), u, p", writer.init(), "x", at_start=True),
            *steps(),
        ]
    )
    helpers = [text for name, text in HELPERS.items() if re.search(rf"\b{name}\(", functions)]
    head = "\n".join([_DOCSTRING.format(stem=stem), *tables(ode, real)])
    return "\n\n\n".join([head, *helpers, functions]) + "\n"


def _jacobian(writer: Writer, sparse: SparseJacobian) -> list[str]:
    """Return the places of the Jacobian, and the function that computes it."""
    if not sparse.ode.states:
        return []
    return [
        jacobian.table(sparse),
        _function(jacobian.HEAD, "x, u, p", jacobian.body(writer, sparse), "J"),
    ]


_DOCSTRING = f'''\
"""The augmented ODE of {{stem}} for NumPy, written by nsode {nsode.__version__}.

x' = rhs(t, x, u, p) with outputs y = out(t, x, u, p), in the order of the names below;
init(p) is the state at the start, p0 holds the parameters as the model gives them.
"""

import numpy as np
'''
_RHS = '''\
def rhs(t, x, u=u0, p=p0):
    """Return the rates of the states."""'''
_OUT = '''\
def out(t, x, u=u0, p=p0):
    """Return the outputs."""'''
_INIT = '''\
def init(p=p0, u=u0):
    """Return the states at the start."""'''


def _function(
    head: str, arguments: str, body: list[str], result: str, *, at_start: bool = False
) -> str:
    lines = [f"x, u, p = vectors({arguments})"]
    if any(re.search(r"\bt\b", line) for line in body):
        lines.append("t = real(0.0)" if at_start else "t = real(t)")
    if body:
        lines += ['with np.errstate(all="ignore"):', *(f"    {line}" for line in body)]
    return "\n".join([head, *(f"    {line}" for line in [*lines, f"return {result}"])])
