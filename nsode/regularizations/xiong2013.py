"""Xiong, Kikuuwe and Yamamoto (2013): sticks without creep, never pulls.

dio becomes a Zener solid by (24) and (25), chi*sgn a viscoelastic element behind a
slider by (18). The force is emitted as (25) has it, which cannot round below zero.
"""

from __future__ import annotations

from nsode.expr import Call, Expr, Number, add, divide, multiply, negate, subtract
from nsode.ode import SetValuedTerm
from nsode.regularizations import Condition, Constant, Replacement
from nsode.regularizations.pieces import STIFFNESS, constant, force, own, part, state, vector

_ZERO = Number(0.0)
_PASSIVE = Condition("<=", "beta", "alpha > beta creates energy; alpha = beta is perfectly elastic")


def constants(term: SetValuedTerm) -> tuple[Constant, ...]:
    """Return K, alpha, beta for dio; K, beta for sgn. A damper B is K*beta."""
    stiffness = Constant("K", (STIFFNESS,))
    beta = Constant(
        "beta",
        (Condition(">", 0.0, "a negative beta grows without bound"),),
        equal=divide(constant(term, "B"), constant(term, "K")),
    )
    if term.kind == "sgn":
        return stiffness, beta
    alpha = Constant("alpha", (Condition(">", 0.0, "alpha = 0 divides by zero"), _PASSIVE))
    return stiffness, alpha, beta


def replace(term: SetValuedTerm, text: str, velocity: Expr | None = None) -> Replacement:
    """Return the value of a term and its auxiliary states: (24), (25) or (18)."""
    return _dio(term, text) if term.kind == "dio" else _sgn(term, text)


def _dio(term: SetValuedTerm, text: str) -> Replacement:
    psi, e = own(term, "psi"), own(term, "e")
    K, alpha, beta = (constant(term, name) for name in ("K", "alpha", "beta"))
    pressed = divide(multiply(beta, add(psi, e)), alpha)
    value = multiply(K, Call("max", (_ZERO, subtract(e, pressed))))
    rate = Call("max", (divide(negate(e), beta), divide(negate(add(psi, e)), alpha)))
    initial: Expr = _ZERO
    if term.approximation.at_equilibrium:
        initial = Call("max", (_ZERO, negate(psi)))
    return Replacement(
        (part(term, psi, term.argument[0]), force(term, 0, value)),
        (state(term, e, rate, initial, text),),
    )


def _sgn(term: SetValuedTerm, text: str) -> Replacement:
    K, beta = constant(term, "K"), constant(term, "beta")
    factor = term.factor if term.factor is not None else Number(1.0)
    a, z, s = (vector(term, name) for name in ("a", "z", "s"))
    level = own(term, "Z")
    parts = [
        part(term, z[k], add(a[k], multiply(beta, theta))) for k, theta in enumerate(term.argument)
    ]
    parts.append(part(term, level, divide(factor, K)))
    if len(z) == 1:
        parts.append(part(term, s[0], Call("sat", (level, z[0]))))
    else:
        shrink = own(term, "shrink")
        parts.append(part(term, shrink, Call("shrink", (level, Call("norm", tuple(z))))))
        parts.extend(part(term, s[k], multiply(shrink, z[k])) for k in range(len(z)))
    values = [force(term, k, multiply(K, s[k])) for k in range(len(z))]
    states = [
        state(term, a[k], divide(subtract(s[k], a[k]), beta), _ZERO, text) for k in range(len(a))
    ]
    return Replacement((*parts, *values), tuple(states))
