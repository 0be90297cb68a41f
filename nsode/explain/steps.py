"""Each replacement of Section 4.4 in closed form, read back from the augmented ODE."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from nsode.expr import Call, Expr, Name, divide, multiply, rebuild
from nsode.ode import AugmentedODE, Binding, DifferentialInclusion, Rate, SetValuedTerm


@dataclass(frozen=True, slots=True)
class Step:
    """One set-valued term and what became of it.

    ``values`` pairs the names that a term defines with its force; a vector by one
    ``sat`` has all of its names in one pair. ``rates`` are those of its states.
    ``numbers`` are the equations of the paper for the force and for the states.
    """

    term: SetValuedTerm
    line: int
    written: str
    values: tuple[tuple[tuple[str, ...], Expr], ...]
    rates: tuple[Rate, ...]
    numbers: tuple[str, str] | None

    @property
    def law(self) -> str:
        """The law that replaced the term."""
        return self.term.approximation.law


#: The paper's equations for force and state, by law and kind.
NUMBERS: Mapping[tuple[str, str], tuple[str, str]] = {
    ("xiong2013", "dio"): ("25", "24"),
    ("xiong2013", "sgn"): ("18b", "18a"),
    ("lugre", "sgn"): ("12b", "12a"),
    ("kelvin_voigt", "dio"): ("15", ""),
    ("clipped_kelvin_voigt", "dio"): ("16", ""),
    ("smoothing", "sgn"): ("50", ""),
}


def steps(inclusion: DifferentialInclusion, ode: AugmentedODE) -> tuple[Step, ...]:
    """Return what happened to each term, in the paper's order: first dio, then sgn."""
    ordered = sorted(inclusion.terms, key=lambda term: term.kind)
    return tuple(_step(term, ode) for term in ordered)


def _step(term: SetValuedTerm, ode: AugmentedODE) -> Step:
    own = {
        item.name: item.value
        for item in ode.bindings
        if isinstance(item, Binding)
        and (item.name in term.multiplier or item.name.startswith(f"{term.name}."))
    }
    forces = {name: own.pop(name) for name in term.multiplier}
    states = [Rate(a.name, a.rate, a.range) for a in ode.auxiliary if a.term == term.name]
    values, rates = _slider(term, forces, states, own) or _closed(forces, states, own)
    return Step(
        term,
        ode.source.position(term.span.start).line,
        ode.source.on_one_line(term.span),
        values,
        rates,
        NUMBERS.get((term.approximation.law, term.kind)),
    )


_Found = tuple[tuple[tuple[tuple[str, ...], Expr], ...], tuple[Rate, ...]]


def _closed(forces: Mapping[str, Expr], states: list[Rate], own: Mapping[str, Expr]) -> _Found:
    """Return everything in terms of what stands outside of the term."""
    return (
        tuple(((name,), _inline(value, own)) for name, value in forces.items()),
        tuple(Rate(rate.state, _inline(rate.value, own), rate.range) for rate in states),
    )


def _slider(
    term: SetValuedTerm, forces: Mapping[str, Expr], states: list[Rate], own: Mapping[str, Expr]
) -> _Found | None:
    """Return ``K*sat(chi/K, a + beta*theta)`` as one vector; a' by the force, as in (37)."""
    level = own.get(f"{term.name}.Z")
    z = [own.get(f"{term.name}.z{suffix}") for suffix in term.suffixes]
    first = forces[term.multiplier[0]]
    if level is None or None in z or not isinstance(first, Call) or first.function != "*":
        return None
    stiffness = first.args[0]
    known = [_inline(part, own) for part in (level, *z) if part is not None]
    force = multiply(stiffness, Call("sat", tuple(known)))
    at = next((name.at for name in _names(first) if name.id.startswith(f"{term.name}.s")), None)
    returned = {
        f"{term.name}.s{suffix}": divide(Name(name, at), stiffness)
        for suffix, name in zip(term.suffixes, term.multiplier, strict=True)
    }
    rates = tuple(Rate(r.state, _inline(r.value, returned), r.range) for r in states)
    return ((term.multiplier, force),), rates


def _names(call: Call) -> list[Name]:
    return [arg for arg in call.args if isinstance(arg, Name)]


def _inline(expr: Expr, values: Mapping[str, Expr]) -> Expr:
    """Return an expression with some names replaced by what they stand for."""
    if isinstance(expr, Name) and expr.id in values:
        return _inline(values[expr.id], values)
    return rebuild(expr, lambda child: _inline(child, values))
