"""Exact derivatives of expressions over bindings and families, without computer algebra.

Nothing is substituted into anything: the derivative of a binding is a binding, the
derivative of a family a family, so size stays linear in the model. At kinks the
derivative is finite: the value of one side, as :mod:`nsode.derivative.rules` states.
"""

from nsode.derivative.forward import (
    Motion,
    Row,
    derivative,
    tangent,
    time_derivative,
    time_derivatives,
)
from nsode.derivative.places import Pattern, pattern
from nsode.derivative.rules import Partial, partials
from nsode.derivative.sparse import Entry, Jacobian, jacobian, linearize

__all__ = [
    "Entry",
    "Jacobian",
    "Motion",
    "Partial",
    "Pattern",
    "Row",
    "derivative",
    "jacobian",
    "linearize",
    "partials",
    "pattern",
    "tangent",
    "time_derivative",
    "time_derivatives",
]
