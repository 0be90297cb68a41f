"""What a run records besides the outputs: gaps, modes, and forces that have no name.

They become further outputs of the model that is compiled, evaluated at rows only.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum

from nsode.expr import Call, Expr, If, Index, Name, Number, multiply, names
from nsode.ode import (
    AugmentedODE,
    Check,
    DifferentialInclusion,
    Input,
    Output,
    Parameter,
    SetValuedTerm,
    State,
    element_names,
)

#: Friction below its level by more than rounding sticks: K*(chi/K) is not quite chi.
_BELOW = 1 - 1e-13


class Mode(IntEnum):
    """What an element does: contact presses or is free; friction sticks, slips or is free."""

    FREE = 0
    CONTACT = 1
    STICK = 2
    SLIP = 3


@dataclass(frozen=True, slots=True)
class Observed:
    """A model with further outputs behind its own.

    ``gaps`` and ``modes`` name the elements that have one, in order; ``forces`` are the
    outputs that are values of set-valued terms.
    """

    ode: AugmentedODE
    outputs: tuple[str, ...]
    gaps: tuple[str, ...]
    modes: tuple[str, ...]
    forces: tuple[str, ...]


def observe(inclusion: DifferentialInclusion, ode: AugmentedODE) -> Observed:
    """Return a model that records what its elements do.

    The parameters' values are left out, which a run brings with it: one library serves
    them all.
    """
    terms = inclusion.terms
    given = {output.name for output in ode.outputs}
    unnamed = [output for output in _forces(terms) if output.name not in given]
    gaps = [
        Output(f"{term.name}.psi", term.argument[0], term.range, _unit(term.argument[0], inclusion))
        for term in terms
        if term.kind == "dio"
    ]
    modes = [Output(f"{term.name}.mode", _mode(term), term.range) for term in terms]
    own = (*ode.outputs, *unnamed)
    return Observed(
        replace(
            ode,
            parameters=tuple(replace(p, values=(0.0,) * len(p.values)) for p in ode.parameters),
            outputs=(*own, *gaps, *modes),
            checks=tuple(_running(ode)),
        ),
        tuple(element_names(own)),
        tuple(_elements(terms, "dio")),
        tuple(_elements(terms)),
        tuple(element_names(_forces(terms))),
    )


def _unit(sum_: Expr, inclusion: DifferentialInclusion) -> str | None:
    """Return the unit of a sum, which is that of each summand, where one of these has one."""
    match sum_:
        case Call("+" | "-" | "neg", args):
            return next((unit for arg in args if (unit := _unit(arg, inclusion))), None)
        case Name(name):
            known: list[State | Parameter | Input] = [*inclusion.states]
            known += [*inclusion.parameters, *inclusion.inputs]
            return next((item.unit for item in known if item.name == name), None)
        case _:
            return None


def settled(check: Check, ode: AugmentedODE) -> bool:
    """Whether a check reads parameters alone, so that it can be made before a run."""
    known = {parameter.name for parameter in ode.parameters}
    return all(name.id in known for name in names(check.condition))


def _running(ode: AugmentedODE) -> list[Check]:
    """Return the checks that every step must make.

    Those that read parameters alone are made once, before a run. A factor is proved
    nonnegative from these, from bounds of inputs and from assumptions: without the latter two
    there is nothing left to check, and looking would cost a step half of its time again.
    """
    open_ = [check for check in ode.checks if not settled(check, ode)]
    return open_ if any(check.kind != "factor" for check in open_) else []


def _forces(terms: Sequence[SetValuedTerm]) -> list[Output]:
    return [
        Output(name, Name(name, _at(term)), term.range)
        for term in terms
        for name in term.multiplier
    ]


def _elements(terms: Sequence[SetValuedTerm], kind: str | None = None) -> Iterator[str]:
    for term in terms:
        if kind in (None, term.kind):
            yield from element_names([Output(term.name, Number(0.0), term.range)])


def _mode(term: SetValuedTerm) -> Expr:
    values = tuple(Name(name, _at(term)) for name in term.multiplier)
    if term.kind == "dio":
        return If(Call("!=", (values[0], Number(0.0))), _code(Mode.CONTACT), _code(Mode.FREE))
    level = Number(1.0) if term.factor is None else term.factor
    force = Call("abs", values) if len(values) == 1 else Call("norm", values)
    below = Call("<", (force, multiply(Number(_BELOW), level)))
    moving = If(below, _code(Mode.STICK), _code(Mode.SLIP))
    return If(Call(">", (level, Number(0.0))), moving, _code(Mode.FREE))


def _code(mode: Mode) -> Number:
    return Number(float(mode))


def _at(term: SetValuedTerm) -> Index | None:
    return None if term.range is None else Index(term.range.variable)
