"""Only what was asked for: bindings, outputs and states that nothing kept reads go."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TypeVar

from nsode.diagnostics import Diagnostic, ModelError, suggest
from nsode.expr import Expr, Name, children
from nsode.ode import AugmentedODE, Definition, Placed, defined, expressions

_Definition = TypeVar("_Definition", bound=Definition)


def reads(*exprs: Expr) -> set[str]:
    """Return every name that some expressions read, families by their one name."""
    found: set[str] = set()
    stack = list(exprs)
    while stack:
        expr = stack.pop()
        if isinstance(expr, Name):
            found.add(expr.id)
        else:
            stack += children(expr)
    return found


def definition_reads(item: Definition) -> set[str]:
    """Return every name that a definition reads."""
    return reads(*expressions(item))


def needed(
    bindings: Sequence[_Definition],
    wanted: set[str],
    reads_of: Callable[[_Definition], set[str]] = definition_reads,
) -> tuple[_Definition, ...]:
    """Return the bindings that the wanted names rest on, in order.

    ``wanted`` grows by what these bindings read; ``reads_of`` may know that already.
    """
    kept = []
    for item in reversed(bindings):
        if not wanted.isdisjoint(defined(item)):
            wanted |= reads_of(item)
            kept.append(item)
    return tuple(reversed(kept))


def prune(ode: AugmentedODE, outputs: Iterable[str] | None = None) -> AugmentedODE:
    """Drop bindings that nothing reads and, if outputs are named, what they do not need.

    Parameters
    ----------
    ode
        What to reduce. Parameters and inputs all stay, so that ``p`` and ``u`` keep their
        layout; so do the values of everything that stays.
    outputs
        Names of outputs and states, a vector by its one name. Every state goes, auxiliary
        ones included, on which none of them depends; a vector stays whole where that takes
        no further state. None keeps all states and outputs.

    Raises
    ------
    ModelError
        NS101 for a name that is neither a state nor an output.
    """
    if outputs is not None:
        ode = _restrict(ode, tuple(outputs))
    wanted = reads(
        *(rate.value for rate in ode.rates),
        *(output.value for output in ode.outputs),
        *(check.condition for check in ode.checks),
        *(state.initial for state in ode.states),
    )
    return replace(ode, bindings=needed(ode.bindings, wanted))


def _restrict(ode: AugmentedODE, asked: tuple[str, ...]) -> AugmentedODE:
    placed: tuple[Placed, ...] = (*ode.states, *ode.outputs)
    for name in asked:
        if not any(_selects(name, item) for item in placed):
            message = f"`{name}` is neither a state nor an output"
            hint = suggest(name, (item.name for item in placed))
            raise ModelError([Diagnostic("NS101", message, help=hint)], ode.source)
    outputs = tuple(y for y in ode.outputs if any(_selects(name, y) for name in asked))
    graph = _dependencies(ode)
    wanted = reads(*(y.value for y in outputs))
    wanted |= {x.name for x in ode.states if any(_selects(name, x) for name in asked)}
    kept = _reach(graph, wanted)
    kept |= _completing(graph, kept, {x.name for x in ode.states})
    dropped = {x.name for x in ode.states} - kept
    return replace(
        ode,
        states=tuple(x for x in ode.states if x.name in kept),
        rates=tuple(r for r in ode.rates if r.state in kept),
        outputs=outputs,
        checks=tuple(c for c in ode.checks if not _reach(graph, reads(c.condition)) & dropped),
        auxiliary=tuple(a for a in ode.auxiliary if a.name in kept),
    )


def _selects(asked: str, item: Placed) -> bool:
    return item.name == asked or item.name.startswith((f"{asked}.", f"{asked}["))


def _dependencies(ode: AugmentedODE) -> dict[str, set[str]]:
    """Return what each binding reads, and each state for its rate and its start."""
    graph: dict[str, set[str]] = {}
    for item in ode.bindings:
        behind = definition_reads(item)
        for name in defined(item):
            graph.setdefault(name, set()).update(behind)
    for state in ode.states:
        graph[state.name] = reads(state.initial)
    for rate in ode.rates:
        graph[rate.state] |= reads(rate.value)
    return graph


def _reach(graph: Mapping[str, set[str]], start: set[str]) -> set[str]:
    """Return ``start`` and every name that it rests on."""
    found = set(start)
    front = list(start)
    while front:
        new = graph.get(front.pop(), set()) - found
        found |= new
        front.extend(new)
    return found


def _completing(graph: Mapping[str, set[str]], kept: set[str], states: set[str]) -> set[str]:
    """Return components that complete a kept vector and rest on nothing but what is kept."""
    begun = {_vector(name) for name in kept & states}
    missing = {name for name in states - kept if _vector(name) in begun}
    return {name for name in missing if _reach(graph, {name}) & states <= kept | {name}}


def _vector(component: str) -> str:
    """Return the name of the vector of which a name is a component: ``p`` of ``p.x``."""
    return component.rpartition("[" if component.endswith("]") else ".")[0] or component
