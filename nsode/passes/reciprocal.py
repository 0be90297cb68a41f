"""A quotient by parameters becomes a product, so that a step or a loop divides once.

``a*(1/p)`` differs from ``a/p`` by at most one and a half units in the last place, and
division is what the right-hand sides of this method spend most of their time on.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from math import frexp, isfinite

from nsode.expr import Call, Expr, If, Index, Name, Number, rebuild
from nsode.ode import AugmentedODE
from nsode.passes.expressions import map_definition, map_rate


def multiply_by_reciprocals(ode: AugmentedODE) -> AugmentedODE:
    """Return the ODE with multiplications in place of divisions by parameters and numbers.

    Bindings and rates change; what is computed once stays as it was written. A division in
    a branch stays: its divisor may be zero where the branch is not taken. So does a quotient
    of parameters alone, which a compiler takes out of the loop by itself.
    """
    fixed = {item.name for item in ode.parameters if item.range is None}

    def change(expr: Expr) -> Expr:
        return _change(expr, fixed)

    return replace(
        ode,
        bindings=tuple(map_definition(item, change) for item in ode.bindings),
        rates=tuple(map_rate(item, change) for item in ode.rates),
    )


def _change(expr: Expr, fixed: Collection[str]) -> Expr:
    match expr:
        case If():
            return expr
        case Name() | Number():
            return expr
        case Call("/", (top, bottom)) if _is_divisor(bottom, fixed) and not _is_fixed(top, fixed):
            inverse = Call("/", (Number(1.0), bottom), span=bottom.span)
            return Call("*", (_change(top, fixed), inverse), span=expr.span)
        case _:
            return rebuild(expr, lambda child: _change(child, fixed))


def _is_divisor(expr: Expr, fixed: Collection[str]) -> bool:
    """Whether a quotient by an expression is better a product; by a power of two it is not."""
    match expr:
        case Number(value) | Index(None, value):
            return isfinite(value) and abs(frexp(value)[0]) not in (0.0, 0.5)
        case _:
            return _is_fixed(expr, fixed)


def _is_fixed(expr: Expr, fixed: Collection[str]) -> bool:
    """Whether an expression reads scalar parameters and numbers alone."""
    match expr:
        case Name(id, None):
            return id in fixed
        case Number() | Index(None, _):
            return True
        case Call():
            return all(_is_fixed(arg, fixed) for arg in expr.args)
        case _:
            return False
