"""From an augmented ODE to SymPy objects."""

from __future__ import annotations

import sympy as sp

from nsode.backends.families import ranges
from nsode.backends.latex.names import Symbol, symbols
from nsode.backends.sympy.lower import Environment, index, lower
from nsode.backends.sympy.names import Family, Named
from nsode.backends.sympy.system import Solve, SymbolicSystem
from nsode.expr import Expr, IndexRange, Number
from nsode.ode import AugmentedODE, Binding, LinearSolve, Output, Rate
from nsode.passes.split import split


def build(ode: AugmentedODE) -> SymbolicSystem:
    """Return the rates, bindings and outputs of an ODE in terms of its names."""
    ode = split(ode)
    typeset = symbols(ode)
    env = Environment({n: _symbol(n, typeset[n], over) for n, over in ranges(ode).items()})
    appended = {item.name for item in ode.auxiliary}
    solves = [item for item in ode.bindings if isinstance(item, LinearSolve)]
    return SymbolicSystem(
        name=ode.name,
        symbols=dict(env.symbols),
        ranges={name: (r.first, r.last) for name, r in ranges(ode).items() if r is not None},
        bindings=tuple(
            _pair(env.symbols[item.name], item, env)
            for item in ode.bindings
            if isinstance(item, Binding)
        ),
        solves=tuple(_solve(item, env) for item in solves),
        rates=tuple(_pair(env.symbols[item.state], item, env) for item in ode.rates),
        limits=tuple(_limits(item.range) for item in ode.rates),
        outputs=tuple(
            _pair(_symbol(y.name, typeset[y.name], y.range), y, env) for y in ode.outputs
        ),
        auxiliary=tuple(
            _at(env.symbols[s.name], s.range) for s in ode.states if s.name in appended
        ),
        defaults={
            env.symbols[p.name]: lower(Number(p.values[0]), env)
            for p in ode.parameters
            if p.range is None
        },
    )


def _pair(
    symbol: sp.Basic, item: Binding | Rate | Output, env: Environment
) -> tuple[sp.Basic, sp.Expr]:
    return _at(symbol, item.range), _value(item.value, item.range, env)


def _value(expr: Expr, over: IndexRange | None, env: Environment) -> sp.Expr:
    value = lower(expr, env)
    if over is None or len(over) > 1:
        return value
    return value.xreplace({index(over.variable): sp.Integer(over.first)})


def _limits(over: IndexRange | None) -> tuple[sp.Symbol, int, int] | None:
    if over is None or len(over) == 1:
        return None
    return index(over.variable), over.first, over.last


def _solve(item: LinearSolve, env: Environment) -> Solve:
    return Solve(
        sp.Matrix([[_value(entry, item.range, env) for entry in row] for row in item.matrix]),
        tuple(_at(env.symbols[name], item.range) for name in item.unknowns),
        sp.Matrix([_value(entry, item.range, env) for entry in item.right]),
    )


def _symbol(name: str, typeset: Symbol, over: IndexRange | None) -> sp.Basic:
    symbol = Named(name, typeset)
    return symbol if over is None else Family(symbol)


def _at(symbol: sp.Basic, over: IndexRange | None) -> sp.Basic:
    if over is None:
        return symbol
    return symbol[over.first if len(over) == 1 else index(over.variable)]
