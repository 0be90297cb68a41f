"""From an augmented ODE to the columns of its rates, outputs and initial states."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import casadi as ca
import numpy as np

from nsode.backends.casadi.gates import as_written
from nsode.backends.casadi.lower import Environment, lower
from nsode.backends.casadi.model import CasadiModel
from nsode.backends.families import ranges
from nsode.expr import TIME, Expr, IndexRange
from nsode.integrators import RungeKutta
from nsode.ode import (
    AugmentedODE,
    Binding,
    Definition,
    Input,
    LinearSolve,
    Slot,
    element_names,
    layout,
    size,
)
from nsode.passes.prune import needed, reads
from nsode.passes.split import pieces, split


@dataclass(frozen=True, slots=True)
class Columns:
    """The symbols of an ODE and what is computed from them; ``initial`` reads u and p."""

    t: ca.SX
    x: ca.SX
    u: ca.SX
    p: ca.SX
    rates: ca.SX
    outputs: ca.SX
    initial: ca.SX


def columns(ode: AugmentedODE) -> Columns:
    """Return the rates, outputs and initial states of an ODE."""
    ode = split(ode)
    t = ca.SX.sym("t")
    x, u, p = (
        ca.SX.sym(name, sum(map(size, items)))
        for name, items in (("x", ode.states), ("u", ode.inputs), ("p", ode.parameters))
    )
    states, outputs = layout(ode.states), layout(ode.outputs)
    with as_written():
        env = _environment(ode, t, x, u, p, ode.bindings)
        rates = ca.SX.nan(x.shape[0])
        for rate in ode.rates:
            _fill(rates, states[rate.state], rate.range, rate.value, env)
        y = ca.SX.nan(sum(map(size, ode.outputs)))
        for output in ode.outputs:
            _fill_whole(y, outputs[output.name], output.value, env)
        return Columns(t, x, u, p, rates, y, _initial(ode, u, p))


def _step(method: RungeKutta, rhs: ca.Function, now: Columns, h: ca.SX) -> ca.SX:
    """Return the states one step later."""
    slopes: list[ca.SX] = []
    for row, node in zip(method.a, method.c, strict=True):
        there = now.x + h * _combine(row, slopes)
        slopes.append(rhs(now.t + float(node) * h, there, now.u, now.p))
    return now.x + h * _combine(method.b, slopes)


def _combine(weights: Sequence[Fraction], slopes: Sequence[ca.SX]) -> ca.SX:
    total = ca.SX(0.0)
    for weight, slope in zip(weights, slopes, strict=True):
        if weight:
            total = total + float(weight) * slope
    return total


def _initial(ode: AugmentedODE, u: ca.SX, p: ca.SX) -> ca.SX:
    """Return the states at the start: the model's own, then what is appended to them."""
    slots = layout(ode.states)
    appended = {item.name for item in ode.auxiliary}
    x = ca.SX.nan(sum(map(size, ode.states)))
    for later in (False, True):
        items = [state for state in ode.states if (state.name in appended) is later]
        bindings = needed(ode.bindings, reads(*(state.initial for state in items)))
        env = _environment(ode, ca.SX(0.0), x, u, p, bindings)
        for state in items:
            _fill_whole(x, slots[state.name], state.initial, env)
    return x


def _environment(
    ode: AugmentedODE, t: ca.SX, x: ca.SX, u: ca.SX, p: ca.SX, bindings: Iterable[Definition]
) -> Environment:
    """Return the environment of a point, in which the bindings have their values."""
    whole = ranges(ode)
    values: dict[str, ca.SX] = {TIME: t}
    for vector, items in ((x, ode.states), (u, ode.inputs), (p, ode.parameters)):
        for name, (offset, over) in layout(items).items():
            values[name] = vector[offset : offset + (1 if over is None else len(over))]
    env = Environment(values, {k: 0 if over is None else over.first for k, over in whole.items()})
    for item in bindings:
        match item:
            case Binding():
                column = _column(values, item.name, whole[item.name])
                _fill(column, Slot(0, whole[item.name]), item.range, item.value, env)
            case LinearSolve():
                _solve(item, [_column(values, n, whole[n]) for n in item.unknowns], env)
            case _:
                raise NotImplementedError(f"no CasADi rule for {type(item).__name__}")
    return env


def _column(values: dict[str, ca.SX], name: str, whole: IndexRange | None) -> ca.SX:
    return values.setdefault(name, ca.SX.nan(1 if whole is None else len(whole)))


def _fill(
    column: ca.SX, slot: Slot, over: IndexRange | None, value: Expr, env: Environment
) -> None:
    """Write a value, or those of a piece of a family, where they stand in a column."""
    if over is None or slot.range is None:
        column[slot.offset] = lower(value, env)
        return
    start = slot.offset + over.first - slot.range.first
    column[start : start + len(over)] = lower(value, env.along(over))


def _fill_whole(column: ca.SX, slot: Slot, value: Expr, env: Environment) -> None:
    parts = [(None, (value,))] if slot.range is None else pieces(slot.range, value)
    for over, (piece,) in parts:
        _fill(column, slot, over, piece, env)


def _solve(item: LinearSolve, unknowns: Sequence[ca.SX], env: Environment) -> None:
    """Solve a small system symbolically, one for each element of a family."""
    over = item.range
    first = 0 if over is None else env.firsts[item.unknowns[0]]
    for k in [0] if over is None else range(over.first, over.last + 1):
        here = env if over is None else env.at(over.variable, k)
        matrix = ca.vertcat(*(ca.horzcat(*(lower(e, here) for e in row)) for row in item.matrix))
        solution = ca.solve(matrix, ca.vertcat(*(lower(e, here) for e in item.right)))
        for row, unknown in enumerate(unknowns):
            unknown[k - first] = solution[row]


def build(ode: AugmentedODE, method: RungeKutta) -> CasadiModel:
    """Return the functions of an ODE."""
    c = columns(ode)
    arguments, names = [c.t, c.x, c.u, c.p], ["t", "x", "u", "p"]
    rhs = ca.Function("rhs", arguments, [c.rates], names, ["dx"])
    h = ca.SX.sym("h")
    after = _step(method, rhs, c, h)
    return CasadiModel(
        name=ode.name,
        rhs=rhs,
        out=ca.Function("out", arguments, [c.outputs], names, ["y"]),
        step=ca.Function(
            "step", [c.t, h, c.x, c.u, c.p], [after], ["t", "h", *names[1:]], ["x_next"]
        ),
        init=ca.Function("init", [c.u, c.p], [c.initial], ["u", "p"], ["x"]),
        t=c.t,
        x=c.x,
        u=c.u,
        p=c.p,
        dx=c.rates,
        y=c.outputs,
        x_names=tuple(element_names(ode.states)),
        u_names=tuple(element_names(ode.inputs)),
        p_names=tuple(element_names(ode.parameters)),
        y_names=tuple(element_names(ode.outputs)),
        u0=np.array([_default(item) for item in ode.inputs for _ in range(size(item))]),
        p0=np.array([value for item in ode.parameters for value in item.values]),
    )


def _default(item: Input) -> float:
    return float("nan") if item.default is None else item.default
