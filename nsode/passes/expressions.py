"""Every expression of an ODE, changed by one function."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain

from nsode.expr import Expr
from nsode.ode import AugmentedODE, Binding, Definition, LinearSolve, Rate, expressions

Change = Callable[[Expr], Expr]


def map_expressions(ode: AugmentedODE, change: Change) -> AugmentedODE:
    """Return the ODE with ``change`` applied to every expression in it."""
    return replace(
        ode,
        parameters=tuple(
            p if p.formula is None else replace(p, formula=change(p.formula))
            for p in ode.parameters
        ),
        states=tuple(replace(s, initial=change(s.initial)) for s in ode.states),
        bindings=tuple(map_definition(item, change) for item in ode.bindings),
        rates=tuple(map_rate(rate, change) for rate in ode.rates),
        outputs=tuple(replace(o, value=change(o.value)) for o in ode.outputs),
        checks=tuple(replace(c, condition=change(c.condition)) for c in ode.checks),
        auxiliary=tuple(
            replace(a, rate=change(a.rate), initial=change(a.initial)) for a in ode.auxiliary
        ),
    )


def all_expressions(ode: AugmentedODE) -> Iterator[Expr]:
    """Yield every expression that a backend writes."""
    yield from (state.initial for state in ode.states)
    yield from chain.from_iterable(map(expressions, ode.bindings))
    yield from (rate.value for rate in ode.rates)
    yield from (output.value for output in ode.outputs)
    yield from (check.condition for check in ode.checks)


def map_rate(rate: Rate, change: Change) -> Rate:
    """Return a rate with ``change`` applied to its value; itself if that changes nothing."""
    value = change(rate.value)
    return rate if value is rate.value else replace(rate, value=value)


def map_definition(item: Definition, change: Change) -> Definition:
    """Return a definition with ``change`` applied to every expression in it."""
    match item:
        case Binding():
            value = change(item.value)
            return item if value is item.value else replace(item, value=value)
        case LinearSolve():
            return replace(
                item,
                matrix=tuple(tuple(change(entry) for entry in row) for row in item.matrix),
                right=tuple(change(entry) for entry in item.right),
            )
    raise NotImplementedError(f"no rule for {type(item).__name__} in an augmented ODE")
