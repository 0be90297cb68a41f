"""What each generated function has to compute, in an order that computes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import chain
from math import nan

from nsode.backends.c.plan import Require, Scatter, Store, Work
from nsode.backends.c.program import Program, Vector
from nsode.expr import TIME, Expr, IndexRange, Name, Number, rebuild
from nsode.ode import Binding, LinearSolve, State, defined, expressions
from nsode.passes.prune import needed, reads
from nsode.passes.split import pieces


def rates(program: Program) -> list[Work]:
    """Return the work of ``dx``."""
    stores = [
        _store(program, program.x, "dx", rate.state, rate.value, rate.range)
        for rate in program.ode.rates
    ]
    return _with_bindings(program, stores)


def outputs(program: Program) -> list[Work]:
    """Return the work of ``y``."""
    stores = chain.from_iterable(
        _stores(program, program.y, "y", item.name, item.value) for item in program.ode.outputs
    )
    return _with_bindings(program, tuple(stores))


def jacobian(program: Program) -> list[Work]:
    """Return the work of ``J``."""
    return _with_bindings(program, program.jacobian.work)


def checks(program: Program) -> list[Work]:
    """Return the work that finds the first broken check; its number is in the status."""
    require = [
        Require(check.condition, f"{program.prefix}_BROKEN + {number}", check.range)
        for number, check in program.checks
    ]
    return _with_bindings(program, require)


def start(program: Program) -> list[list[Work]]:
    """Return the work of ``x`` at the start, in phases: each reads the states before it.

    The time is zero there, and inputs have their defaults.
    """
    return [
        [
            _map(work, lambda expr: _at_start(expr, program))
            for work in _with_bindings(
                program,
                [
                    store
                    for state in phase
                    for store in _stores(program, program.x, "x", state.name, state.initial)
                ],
            )
        ]
        for phase in _phases(program)
    ]


def _phases(program: Program) -> list[list[State]]:
    waiting = _states_behind(program)
    phases: list[list[State]] = []
    left = list(program.ode.states)
    while left:
        open_names = {state.name for state in left}
        ready = [state for state in left if waiting[state.name].isdisjoint(open_names)]
        if not ready:
            raise ValueError(f"`{left[0].name}` at the start depends on itself")
        phases.append(ready)
        done = {state.name for state in ready}
        left = [state for state in left if state.name not in done]
    return phases


def _states_behind(program: Program) -> dict[str, set[str]]:
    """Return the states on which the initial value of each state rests, through bindings."""
    read = {state.name: reads(state.initial) for state in program.ode.states}
    wanted = set().union(*read.values())
    behind: dict[str, set[str]] = {name: {name} for name in program.x.slots}
    for item in needed(program.bindings, wanted):
        states = _behind(reads(*expressions(item)), behind)
        for name in defined(item):
            behind.setdefault(name, set()).update(states)
    return {name: _behind(names, behind) for name, names in read.items()}


def _behind(names: set[str], behind: dict[str, set[str]]) -> set[str]:
    return set().union(*(behind.get(name, ()) for name in names))


def _at_start(expr: Expr, program: Program) -> Expr:
    match expr:
        case Name(id) if id == TIME:
            return Number(0.0)
        case Name(id) if id in program.u.slots:
            default = next(item.default for item in program.ode.inputs if item.name == id)
            return Number(nan if default is None else default)
        case _:
            return rebuild(expr, lambda child: _at_start(child, program))


def _map(work: Work, change: Callable[[Expr], Expr]) -> Work:
    match work:
        case Binding(value=value) | Store(value=value) | Scatter(value=value):
            return replace(work, value=change(value))
        case LinearSolve(matrix=matrix, right=right):
            rows = tuple(tuple(map(change, row)) for row in matrix)
            return replace(work, matrix=rows, right=tuple(map(change, right)))
        case Require(condition=condition):
            return replace(work, condition=change(condition))


def _with_bindings(program: Program, works: Sequence[Store | Require | Scatter]) -> list[Work]:
    names = program.readings.names
    wanted = set().union(*map(names, works))
    return [*needed(program.bindings, wanted, names), *works]


def _stores(
    program: Program, vector: Vector, array: str, name: str, value: Expr
) -> Iterator[Store]:
    over = vector.slots[name].range
    if over is None:
        yield _store(program, vector, array, name, value, None)
        return
    for piece, (part,) in pieces(over, value):
        yield _store(program, vector, array, name, part, piece)


def _store(
    program: Program, vector: Vector, array: str, name: str, value: Expr, over: IndexRange | None
) -> Store:
    family = vector.slots[name].range
    first = 0 if family is None else family.first
    return Store(array, program.enumerator(vector, name), value, over, first)
