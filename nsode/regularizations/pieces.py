"""What the laws are written with: the names of a term, and conditions on its constants."""

from __future__ import annotations

from nsode.expr import Expr, Index, Name
from nsode.inclusion.units.laws import unit_in
from nsode.ode import AuxiliaryState, Binding, SetValuedTerm
from nsode.regularizations import Condition

STIFFNESS = Condition(">", 0.0, "it is a stiffness")
DAMPER = Condition(">=", 0.0, "a negative damper creates energy")


def constant(term: SetValuedTerm, name: str) -> Name:
    """Return the constant ``K`` of a term, one for a whole family."""
    return Name(f"{term.name}.{name}")


def own(term: SetValuedTerm, name: str) -> Name:
    """Return what a law calls ``name`` in a term: its state or a step on the way."""
    return Name(f"{term.name}.{name}", None if term.range is None else Index(term.range.variable))


def vector(term: SetValuedTerm, name: str) -> list[Name]:
    """Return one name of a law for each component of a term."""
    return [own(term, name + suffix) for suffix in term.suffixes]


def part(term: SetValuedTerm, name: Name, value: Expr) -> Binding:
    """Return a step on the way to the value of a term."""
    return Binding(name.id, value, term.range, "part", span=term.span)


def force(term: SetValuedTerm, component: int, value: Expr) -> Binding:
    """Return a component of the value of a term."""
    name = term.multiplier[component]
    return Binding(name, value, term.range, "term", span=term.span)


def state(term: SetValuedTerm, name: Name, rate: Expr, initial: Expr, text: str) -> AuxiliaryState:
    """Return an auxiliary state of a term, which was written as ``text``."""
    element = name.id.removeprefix(f"{term.name}.").partition(".")[0]
    return AuxiliaryState(
        name.id,
        rate,
        initial,
        term.name,
        text,
        term.range,
        unit_in(term, element),
        term.approximation.law,
        span=term.span,
    )
