"""Hunt and Crossley (1975): damping grows with the depth, so nothing jumps at the touch.

With the depth d = max(0, -psi)::

    f = K d^n max(0, 1 - 3/2 c psi')

from "Coefficient of restitution interpreted as damping in vibroimpact", Journal of Applied
Mechanics 42(2): there F = k x^n + lambda x^n x', lambda = 3/2 c k, for a coefficient of
restitution of about 1 - c v at low impact speeds v. n = 3/2 is Hertz's sphere.

It never pulls. The published law does where something else tears the contact open faster
than 2/(3 c), a speed that a rebound left alone never reaches; there it is cut off at zero.
"""

from __future__ import annotations

from nsode.expr import Call, Expr, Number, multiply, negate, subtract
from nsode.ode import SetValuedTerm
from nsode.regularizations import Condition, Constant, Replacement
from nsode.regularizations.pieces import STIFFNESS, constant, force, own, part


def constants(term: SetValuedTerm) -> tuple[Constant, ...]:
    """Return K, c and n; n is 1 unless given, so that K of another law is the same spring."""
    return (
        Constant("K", (STIFFNESS,), equal=constant(term, "K"), shared=False),
        Constant("c", (Condition(">=", 0.0, "a negative damper creates energy"),)),
        Constant(
            "n",
            (Condition(">=", 1.0, "below 1 the stiffness at the touch is infinite"),),
            default=Number(1.0),
        ),
    )


def replace(term: SetValuedTerm, text: str, velocity: Expr | None) -> Replacement:
    """Return the value of a term."""
    assert velocity is not None
    psi, closing, depth = own(term, "psi"), own(term, "velocity"), own(term, "depth")
    K, c, n = (constant(term, name) for name in ("K", "c", "n"))
    spring = multiply(K, Call("^", (depth, n)))
    lost = multiply(multiply(Number(1.5), c), closing)
    damped = Call("max", (Number(0.0), subtract(Number(1.0), lost)))
    return Replacement(
        (
            part(term, psi, term.argument[0]),
            part(term, closing, velocity),
            part(term, depth, Call("max", (Number(0.0), negate(psi)))),
            force(term, 0, multiply(spring, damped)),
        )
    )
