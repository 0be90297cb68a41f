"""The pieces of a model become one inclusion, definitions in an order that computes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from nsode.diagnostics import refuse
from nsode.expr import names
from nsode.inclusion.declare import Declarations
from nsode.inclusion.definitions import Definitions
from nsode.inclusion.elements import Elements, rename, rename_definition
from nsode.inclusion.order import loop, order
from nsode.inclusion.outputs import force_outputs
from nsode.inclusion.rows import Rows
from nsode.inclusion.solving import solve
from nsode.ode import (
    Check,
    Definition,
    DifferentialInclusion,
    Output,
    Rate,
    Run,
    State,
    defined,
    expressions,
)
from nsode.syntax import ast


@dataclass(frozen=True, slots=True)
class Pieces:
    """What the statements of a model amount to."""

    declared: Declarations
    definitions: Definitions
    rows: Rows
    elements: Elements
    outputs: tuple[Output, ...]
    checks: tuple[Check, ...]
    run: Run = Run()


def assemble(model: ast.Model, pieces: Pieces) -> DifferentialInclusion:
    """Solve the equations for the rates and put everything together.

    Raises
    ------
    ModelError
        NS106 for derivatives that depend on themselves, and what :func:`solve` refuses.
    """
    declared, elements, final = pieces.declared, pieces.elements, pieces.elements.renamed
    bindings = tuple(pieces.definitions.bindings.values())
    solved, rates = solve(pieces.rows.rows, declared.states, declared.parameters, bindings)
    provisional: list[Definition] = [*bindings, *solved]
    named = [rename_definition(item, final) for item in provisional] if final else provisional
    rates = [replace(rate, value=rename(rate.value, final)) for rate in rates]
    return DifferentialInclusion(
        model.name.text,
        model.source,
        tuple(declared.states),
        tuple(declared.inputs),
        tuple(declared.parameters),
        tuple(_ordered([*elements.terms, *named, *elements.aliases])),
        tuple(_in_order_of_states(rates, declared.states)),
        (
            *(replace(item, value=rename(item.value, final)) for item in pieces.outputs),
            *force_outputs(pieces.definitions),
        ),
        tuple(replace(c, condition=rename(c.condition, final)) for c in pieces.checks),
        pieces.run,
    )


def _ordered(items: Sequence[Definition]) -> list[Definition]:
    """Sort definitions so that each stands behind what it reads."""
    owner = {name: k for k, item in enumerate(items) for name in defined(item)}
    keys = sorted(range(len(items)), key=lambda k: items[k].span)
    reads = {
        k: {owner[n.id] for expr in expressions(items[k]) for n in names(expr) if n.id in owner}
        for k in keys
    }
    found = order(keys, reads)
    if len(found) < len(keys):
        first = items[loop(keys, reads)[0]]
        raise refuse(
            "NS106",
            "a derivative depends on itself",
            first.span,
            "in a loop with other definitions",
            help="solve the loop by hand",
        )
    return [items[k] for k in found]


def _in_order_of_states(rates: Sequence[Rate], states: Sequence[State]) -> list[Rate]:
    rank = {state.name: k for k, state in enumerate(states)}
    return sorted(rates, key=lambda r: (rank[r.state], r.range.first if r.range else 0))
