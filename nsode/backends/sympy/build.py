"""From an augmented ODE to SymPy objects."""

from __future__ import annotations

import sympy as sp

from nsode.backends.families import ranges
from nsode.backends.latex.names import symbols
from nsode.backends.sympy.lower import Environment, index, lower
from nsode.backends.sympy.system import Solve, SymbolicSystem
from nsode.expr import IndexRange, Number
from nsode.ode import AugmentedODE, Binding, LinearSolve
from nsode.passes.split import split


def build(ode: AugmentedODE) -> SymbolicSystem:
    """Return the rates, bindings and outputs of an ODE in terms of its names."""
    ode = split(ode)
    env = Environment({name: _symbol(name, over) for name, over in ranges(ode).items()})
    appended = {item.name for item in ode.auxiliary}
    solves = [item for item in ode.bindings if isinstance(item, LinearSolve)]
    return SymbolicSystem(
        name=ode.name,
        symbols=dict(env.symbols),
        ranges={name: (r.first, r.last) for name, r in ranges(ode).items() if r is not None},
        bindings=tuple(
            (_at(env.symbols[item.name], item.range), lower(item.value, env))
            for item in ode.bindings
            if isinstance(item, Binding)
        ),
        solves=tuple(_solve(item, env) for item in solves),
        rates=tuple((_at(env.symbols[r.state], r.range), lower(r.value, env)) for r in ode.rates),
        outputs=tuple(
            (_at(_symbol(y.name, y.range), y.range), lower(y.value, env)) for y in ode.outputs
        ),
        auxiliary=tuple(
            _at(env.symbols[s.name], s.range) for s in ode.states if s.name in appended
        ),
        defaults={
            env.symbols[p.name]: lower(Number(p.values[0]), env)
            for p in ode.parameters
            if p.range is None
        },
        typeset=_typeset(ode, env),
    )


def _solve(item: LinearSolve, env: Environment) -> Solve:
    return Solve(
        sp.Matrix([[lower(entry, env) for entry in row] for row in item.matrix]),
        tuple(_at(env.symbols[name], item.range) for name in item.unknowns),
        sp.Matrix([lower(entry, env) for entry in item.right]),
    )


def _symbol(name: str, over: IndexRange | None) -> sp.Basic:
    # Real, and never nonnegative: SymPy would take max(0, -psi) for 0.
    symbol = sp.Symbol(name, real=True)
    return symbol if over is None else sp.IndexedBase(symbol)


def _at(symbol: sp.Basic, over: IndexRange | None) -> sp.Basic:
    if over is None:
        return symbol
    return symbol[over.first if len(over) == 1 else index(over.variable)]


def _typeset(ode: AugmentedODE, env: Environment) -> dict[sp.Symbol, str]:
    known = symbols(ode)
    return {_symbol(name, None): str(known[name]) for name in env.symbols}
