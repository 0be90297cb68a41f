"""Kelvin-Voigt cut off at zero (16): never pulls, still jumps at the touch."""

from __future__ import annotations

from nsode.expr import Call, Expr, Number
from nsode.ode import SetValuedTerm
from nsode.regularizations import Replacement
from nsode.regularizations.kelvin_voigt import closed, constants, pressed
from nsode.regularizations.pieces import force

__all__ = ["constants", "replace"]


def replace(term: SetValuedTerm, text: str, velocity: Expr | None) -> Replacement:
    """Return the value of a term, (16)."""
    parts, pressing = pressed(term, velocity)
    pushing = Call("max", (Number(0.0), pressing))
    return Replacement((*parts, force(term, 0, closed(term, pushing))))
