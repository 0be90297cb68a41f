"""Xiong, Kikuuwe and Yamamoto (2013): sticks without creep, never pulls.

dio becomes a Zener solid by (24) and (25), chi*sgn a viscoelastic element behind a
slider by (18). The force is emitted as (25) has it, which cannot round below zero.
"""

from __future__ import annotations

from nsode.expr import (
    Call,
    Expr,
    Index,
    Name,
    Number,
    add,
    divide,
    multiply,
    negate,
    subtract,
)
from nsode.ode import AuxiliaryState, Binding, SetValuedTerm
from nsode.regularizations import Replacement

_ZERO = Number(0.0)


def constants(term: SetValuedTerm) -> tuple[str, ...]:
    """Return K, alpha, beta for dio; K, beta for sgn."""
    return ("K", "alpha", "beta") if term.kind == "dio" else ("K", "beta")


def replace(term: SetValuedTerm, text: str) -> Replacement:
    """Return the value of a term and its auxiliary states: (24), (25) or (18)."""
    return _dio(term, text) if term.kind == "dio" else _sgn(term, text)


def _dio(term: SetValuedTerm, text: str) -> Replacement:
    at = _at(term)
    psi, e = Name(f"{term.name}.psi", at), Name(f"{term.name}.e", at)
    K, alpha, beta = (Name(f"{term.name}.{constant}") for constant in constants(term))
    pressed = divide(multiply(beta, add(psi, e)), alpha)
    force = multiply(K, Call("max", (_ZERO, subtract(e, pressed))))
    rate = Call("max", (divide(negate(e), beta), divide(negate(add(psi, e)), alpha)))
    initial: Expr = _ZERO
    if term.approximation.at_equilibrium:
        initial = Call("max", (_ZERO, negate(psi)))
    return Replacement(
        (_part(psi, term.argument[0], term), _value(term.multiplier[0], force, term)),
        (AuxiliaryState(e.id, rate, initial, term.name, text, term.range, span=term.span),),
    )


def _sgn(term: SetValuedTerm, text: str) -> Replacement:
    at = _at(term)
    K, beta = (Name(f"{term.name}.{constant}") for constant in constants(term))
    factor = term.factor if term.factor is not None else Number(1.0)
    a = [Name(f"{term.name}.a{suffix}", at) for suffix in term.suffixes]
    z = [Name(f"{term.name}.z{suffix}", at) for suffix in term.suffixes]
    s = [Name(f"{term.name}.s{suffix}", at) for suffix in term.suffixes]
    level = Name(f"{term.name}.Z", at)
    parts = [
        _part(z[k], add(a[k], multiply(beta, theta)), term) for k, theta in enumerate(term.argument)
    ]
    parts.append(_part(level, divide(factor, K), term))
    if len(z) == 1:
        parts.append(_part(s[0], Call("sat", (level, z[0])), term))
    else:
        shrink = Name(f"{term.name}.shrink", at)
        parts.append(_part(shrink, Call("shrink", (level, Call("norm", tuple(z)))), term))
        parts.extend(_part(s[k], multiply(shrink, z[k]), term) for k in range(len(z)))
    values = [_value(name, multiply(K, s[k]), term) for k, name in enumerate(term.multiplier)]
    states = [
        AuxiliaryState(
            a[k].id,
            divide(subtract(s[k], a[k]), beta),
            _ZERO,
            term.name,
            text,
            term.range,
            span=term.span,
        )
        for k in range(len(a))
    ]
    return Replacement((*parts, *values), tuple(states))


def _at(term: SetValuedTerm) -> Index | None:
    return None if term.range is None else Index(term.range.variable)


def _part(name: Name, value: Expr, term: SetValuedTerm) -> Binding:
    return Binding(name.id, value, term.range, "part", span=term.span)


def _value(name: str, value: Expr, term: SetValuedTerm) -> Binding:
    return Binding(name, value, term.range, "term", span=term.span)
