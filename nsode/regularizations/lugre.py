"""LuGre (12), and Dahl as B = D = 0: bristles that creep under a load below the limit.

Canudas de Wit, Olsson, Astrom and Lischinsky (1995) without the Stribeck effect; Dahl
(1968). (12) divides by F. With a factor chi that may vanish or move, the bristles belong
to a reference force F0, and their force is scaled to chi::

    a' = theta - (K |theta|/F0) a
    f  = (chi/F0) (K a + B a') + D theta

Where chi is constant, F0 = chi gives (12) as printed. The rate is stiff while sliding
fast: RK4 holds it up to a step of about 2.8 F0/(K |theta|).
"""

from __future__ import annotations

from nsode.expr import Call, Expr, Number, add, divide, multiply, subtract
from nsode.ode import SetValuedTerm
from nsode.regularizations import Condition, Constant, Replacement
from nsode.regularizations.pieces import (
    DAMPER,
    STIFFNESS,
    constant,
    force,
    own,
    part,
    state,
    vector,
)


def constants(term: SetValuedTerm) -> tuple[Constant, ...]:
    """Return K, B, D and F0: stiffness, damper, viscous friction and reference force.

    D is 0 and F0 is chi unless given. The B of (18) is K*beta: both laws are the same
    spring and damper as long as they hardly move.
    """
    B = multiply(constant(term, "K"), constant(term, "beta"))
    divisor = Condition(">", 0.0, "the force of the bristles is divided by it")
    return (
        Constant("K", (STIFFNESS,)),
        Constant("B", (DAMPER,), equal=B),
        Constant("D", (DAMPER,), default=Number(0.0)),
        Constant("F0", (divisor,), default=_factor(term)),
    )


def replace(term: SetValuedTerm, text: str, velocity: Expr | None = None) -> Replacement:
    """Return the value of a term and its auxiliary states, (12) scaled to chi."""
    K, B, D, F0 = (constant(term, name) for name in ("K", "B", "D", "F0"))
    a, moving = vector(term, "a"), vector(term, "rate")
    worn, scale = own(term, "worn"), own(term, "scale")
    sliding = Call("abs" if len(a) == 1 else "norm", term.argument)
    parts = [part(term, worn, divide(multiply(K, sliding), F0))]
    parts += [
        part(term, moving[k], subtract(theta, multiply(worn, a[k])))
        for k, theta in enumerate(term.argument)
    ]
    parts.append(part(term, scale, divide(_factor(term), F0)))
    values = [
        force(
            term,
            k,
            add(
                multiply(scale, add(multiply(K, a[k]), multiply(B, moving[k]))),
                multiply(D, theta),
            ),
        )
        for k, theta in enumerate(term.argument)
    ]
    states = [state(term, a[k], moving[k], Number(0.0), text) for k in range(len(a))]
    return Replacement((*parts, *values), tuple(states))


def _factor(term: SetValuedTerm) -> Expr:
    return Number(1.0) if term.factor is None else term.factor
