"""Smoothing (50): sgn(w) becomes sat(epsilon, w)/epsilon; no state, never sticks.

Under a load below the level of friction it creeps. In the factor, the speed |w| is
max(|w|, epsilon), as (50) is printed, where the factor itself holds ``abs(w)``, or
``norm`` of the vector w; behind a ``let`` it stays |w|, which differs by epsilon at most.
"""

from __future__ import annotations

from nsode.expr import Call, Expr, Number, divide, multiply, rebuild
from nsode.ode import SetValuedTerm
from nsode.regularizations import Condition, Constant, Replacement
from nsode.regularizations.pieces import constant, force, own, part, vector


def constants(term: SetValuedTerm) -> tuple[Constant, ...]:
    """Return epsilon, the speed below which friction is viscous."""
    return (Constant("epsilon", (Condition(">", 0.0, "the speed is divided by it"),)),)


def replace(term: SetValuedTerm, text: str, velocity: Expr | None = None) -> Replacement:
    """Return the value of a term as in (50)."""
    epsilon, factor = constant(term, "epsilon"), own(term, "factor")
    s = vector(term, "s")
    chi = Number(1.0) if term.factor is None else _no_slower(term.factor, term, epsilon)
    parts = [part(term, factor, chi)]
    if len(s) == 1:
        smooth = Call("sat", (epsilon, term.argument[0]))
        parts.append(part(term, s[0], divide(smooth, epsilon)))
    else:
        shrink = own(term, "shrink")
        parts.append(part(term, shrink, Call("shrink", (epsilon, Call("norm", term.argument)))))
        parts += [
            part(term, s[k], divide(multiply(shrink, w), epsilon))
            for k, w in enumerate(term.argument)
        ]
    values = (force(term, k, multiply(factor, s[k])) for k in range(len(s)))
    return Replacement((*parts, *values))


def _no_slower(expr: Expr, term: SetValuedTerm, epsilon: Expr) -> Expr:
    """Return an expression with the sliding speed at least epsilon."""
    match expr:
        case Call("abs" | "norm", args) if args == term.argument:
            return Call("max", (expr, epsilon), span=expr.span)
        case _:
            return rebuild(expr, lambda child: _no_slower(child, term, epsilon))
