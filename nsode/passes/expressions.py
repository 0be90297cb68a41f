"""Every expression of an ODE, changed by one function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from nsode.expr import Expr
from nsode.ode import AugmentedODE, Binding, Definition, LinearSolve

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
        bindings=tuple(_definition(item, change) for item in ode.bindings),
        rates=tuple(replace(r, value=change(r.value)) for r in ode.rates),
        outputs=tuple(replace(o, value=change(o.value)) for o in ode.outputs),
        checks=tuple(replace(c, condition=change(c.condition)) for c in ode.checks),
        auxiliary=tuple(
            replace(a, rate=change(a.rate), initial=change(a.initial)) for a in ode.auxiliary
        ),
    )


def _definition(item: Definition, change: Change) -> Definition:
    match item:
        case Binding():
            return replace(item, value=change(item.value))
        case LinearSolve():
            return replace(
                item,
                matrix=tuple(tuple(change(entry) for entry in row) for row in item.matrix),
                right=tuple(change(entry) for entry in item.right),
            )
    raise NotImplementedError(f"no rule for {type(item).__name__} in an augmented ODE")
