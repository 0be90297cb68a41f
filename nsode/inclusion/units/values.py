"""A value against the unit that was declared for it."""

from __future__ import annotations

from nsode.expr import Call, Expr, If, names
from nsode.inclusion.units import messages
from nsode.inclusion.units.declared import DeclaredUnit
from nsode.inclusion.units.inference import Inference
from nsode.inclusion.units.quantity import Quantity
from nsode.inclusion.values import is_zero


def check_value(what: str, value: Expr, unit: DeclaredUnit, inference: Inference) -> Quantity:
    """Check a value against its declared unit, and return what that unit makes known."""
    found, wanted, written = inference.of(value), unit.quantity, unit.written
    if found.rigid not in (None, wanted.dimension):
        inference.add(messages.no_value(what, found, value.span, wanted, written.span))
    elif not unit.coherent and any(True for _ in names(value)):
        number = _unconverted(value, inference)
        if number is not None:
            inference.add(messages.unconverted(number.span, written.span, wanted))
    return wanted


def _unconverted(expr: Expr, inference: Inference) -> Expr | None:
    """Return a part of a formula that has no unit of its own and is not zero."""
    match expr:
        case Call("+" | "min" | "max" | "mod", parts) | Call("neg" | "abs", parts):
            pass
        case If(_, then, otherwise):
            parts = (then, otherwise)
        case _:
            return expr if inference.of(expr).flexible and not is_zero(expr) else None
    found = (_unconverted(part, inference) for part in parts)
    return next((part for part in found if part is not None), None)
