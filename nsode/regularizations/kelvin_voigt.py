"""Kelvin-Voigt (15): a spring and a damper in parallel, only while the gap is closed.

The force jumps at the touch, and pulls while the contact opens fast, as published.
``clipped_kelvin_voigt`` does not pull.
"""

from __future__ import annotations

from nsode.expr import Call, Expr, If, Number, add, multiply, negate
from nsode.ode import Binding, SetValuedTerm
from nsode.regularizations import Constant, Replacement
from nsode.regularizations.pieces import DAMPER, STIFFNESS, constant, force, own, part

_ZERO = Number(0.0)


def constants(term: SetValuedTerm) -> tuple[Constant, ...]:
    """Return K and B. The B of (24) is K*beta: its force tends to (15) as alpha -> 0."""
    B = multiply(constant(term, "K"), constant(term, "beta"))
    return Constant("K", (STIFFNESS,)), Constant("B", (DAMPER,), equal=B)


def replace(term: SetValuedTerm, text: str, velocity: Expr | None) -> Replacement:
    """Return the value of a term, (15)."""
    parts, pressing = pressed(term, velocity)
    return Replacement((*parts, force(term, 0, closed(term, pressing))))


def pressed(term: SetValuedTerm, velocity: Expr | None) -> tuple[tuple[Binding, ...], Expr]:
    """Return psi and psi' as steps, and -K psi - B psi'."""
    assert velocity is not None
    psi, closing = own(term, "psi"), own(term, "velocity")
    K, B = constant(term, "K"), constant(term, "B")
    steps = part(term, psi, term.argument[0]), part(term, closing, velocity)
    return steps, add(negate(multiply(K, psi)), negate(multiply(B, closing)))


def closed(term: SetValuedTerm, value: Expr) -> Expr:
    """Return a value while the gap is closed, 0 while it is open."""
    return If(Call("<=", (own(term, "psi"), _ZERO)), value, _ZERO)
