"""The energy ledger: what each element stores, dissipates and is given, as outputs.

With ``x = e + alpha e'`` a contact stores ``K x^2/2 + K (r-1) (x-e)^2/2`` and dissipates
``K (beta-alpha) e'^2``; friction stores ``K |a|^2/2`` and dissipates
``K beta |a'|^2 + f.(theta - a')``. Both are never negative while ``alpha <= beta`` and
``chi >= 0``. What an element is given, ``-f psi'`` or ``f.theta``, is what it stores and
dissipates, at every instant: ``S' + D = P``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from nsode.analysis.local import LAW
from nsode.derivative import time_derivatives
from nsode.derivative.forward import Row
from nsode.expr import Call, Expr, Index, Name, Number, add, divide, multiply, negate, subtract
from nsode.ode import AugmentedODE, DifferentialInclusion, Output, Rate, SetValuedTerm, defined

_HALF = Number(0.5)


def ledger(ode: AugmentedODE, inclusion: DifferentialInclusion) -> AugmentedODE:
    """Return the ODE with three more outputs for each element.

    ``N.stored`` (J), ``N.dissipated`` and ``N.given`` (both W) for an element ``N``.

    Parameters
    ----------
    ode : AugmentedODE
        Made by the paper's law; elements under another law are left out.
    inclusion : DifferentialInclusion
        What it was made from.
    """
    rates = {rate.state: rate for rate in ode.rates}
    terms = [t for t in inclusion.terms if t.approximation.law == LAW]
    gaps = [Row(t.name, t.argument[0], t.range) for t in terms if t.kind == "dio"]
    definitions, closing = time_derivatives(ode, *gaps)
    speeds = {row.state: row.value for row in closing}
    outputs: list[Output] = []
    for term in terms:
        entries = (
            _contact(term, rates, speeds[term.name])
            if term.kind == "dio"
            else _friction(term, rates)
        )
        outputs += [
            Output(f"{term.name}.{word}", value, term.range, span=term.span)
            for word, value in entries
        ]
    present = {name for item in ode.bindings for name in defined(item)}
    new = (item for item in definitions if present.isdisjoint(defined(item)))
    return replace(ode, bindings=(*ode.bindings, *new), outputs=(*ode.outputs, *outputs))


Entries = Iterator[tuple[str, Expr]]


def _contact(term: SetValuedTerm, rates: dict[str, Rate], closing: Expr) -> Entries:
    stiffness, alpha, beta = (Name(f"{term.name}.{c}") for c in ("K", "alpha", "beta"))
    at = Index(term.range.variable) if term.range else None
    moving = rates[f"{term.name}.e"].value
    spring = add(Name(f"{term.name}.e", at), multiply(alpha, moving))
    branch = multiply(alpha, moving)
    ratio = subtract(divide(beta, alpha), Number(1.0))
    stored = add(_square(spring), multiply(ratio, _square(branch)))
    yield "stored", multiply(multiply(_HALF, stiffness), stored)
    yield "dissipated", multiply(multiply(stiffness, subtract(beta, alpha)), _square(moving))
    yield "given", negate(multiply(Name(term.multiplier[0], at), closing))


def _friction(term: SetValuedTerm, rates: dict[str, Rate]) -> Entries:
    stiffness, beta = Name(f"{term.name}.K"), Name(f"{term.name}.beta")
    at = Index(term.range.variable) if term.range else None
    tails = (
        ("",) if len(term.argument) == 1 else tuple(f".{c}" for c in "xyz")[: len(term.argument)]
    )
    stored, lost, given = [], [], []
    for tail, force, sliding in zip(tails, term.multiplier, term.argument, strict=True):
        moving = rates[f"{term.name}.a{tail}"].value
        stored.append(_square(Name(f"{term.name}.a{tail}", at)))
        lost.append(multiply(multiply(stiffness, beta), _square(moving)))
        lost.append(multiply(Name(force, at), subtract(sliding, moving)))
        given.append(multiply(Name(force, at), sliding))
    yield "stored", multiply(multiply(_HALF, stiffness), add(*stored))
    yield "dissipated", add(*lost)
    yield "given", add(*given)


def _square(expr: Expr) -> Expr:
    return Call("^", (expr, Number(2.0)), span=expr.span)
