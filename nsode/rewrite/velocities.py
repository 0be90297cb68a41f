"""psi' for the laws that read it, by Lie derivatives, each where it can be computed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from nsode.derivative import Row, time_derivatives
from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import Expr, names
from nsode.inclusion.order import loop, order
from nsode.ode import (
    Definition,
    DifferentialInclusion,
    SetValuedTerm,
    defined,
    expressions,
)
from nsode.regularizations import LAWS

Velocities = Mapping[str, Expr]


def with_velocities(inclusion: DifferentialInclusion) -> tuple[DifferentialInclusion, Velocities]:
    """Return psi' of each term whose law reads it, and the inclusion with what psi' reads.

    Raises
    ------
    ModelError
        NS306 where psi' depends on the force itself.
    """
    terms = [t for t in inclusion.terms if LAWS[t.approximation.law].reads_velocity]
    if not terms:
        return inclusion, {}
    rows = (Row(term.name, term.argument[0], term.range) for term in terms)
    definitions, derived = time_derivatives(inclusion, *rows)
    velocities = {row.state: row.value for row in derived}
    bindings = _ordered(inclusion, [*inclusion.bindings, *definitions], velocities)
    return replace(inclusion, bindings=bindings), velocities


def _ordered(
    inclusion: DifferentialInclusion, items: list[Definition], velocities: Velocities
) -> tuple[Definition, ...]:
    """Return the definitions in an order that computes, terms behind their psi'."""
    places = {name: place for place, item in enumerate(items) for name in defined(item)}
    reads = {
        place: [places[name] for name in _reads(item, velocities) if name in places]
        for place, item in enumerate(items)
    }
    for place, others in reads.items():
        if place in others:  # a family whose elements read each other
            reads[place] = [other for other in others if other != place]
    found = order(range(len(items)), reads)
    if len(found) < len(items):
        round = [items[place] for place in loop(range(len(items)), reads)]
        raise ModelError([_first_order(round, velocities)], inclusion.source)
    return tuple(items[place] for place in found)


def _reads(item: Definition, velocities: Velocities) -> Iterator[str]:
    for expr in expressions(item):
        yield from (name.id for name in names(expr))
    if isinstance(item, SetValuedTerm) and item.name in velocities:
        yield from (name.id for name in names(velocities[item.name]))


def _first_order(items: list[Definition], velocities: Velocities) -> Diagnostic:
    """Return the error for a loop; one of its items is a term that reads its psi'."""
    term = next(t for t in items if isinstance(t, SetValuedTerm) and t.name in velocities)
    return Diagnostic(
        "NS306",
        f"`{term.approximation.law}` cannot stand for `{term.name}`",
        (Label(term.span, "the rate of this gap depends on the force itself"),),
        notes=("the force would depend on the velocity, and the velocity on the force",),
        help="choose `xiong2013`, which reads no velocity",
    )
