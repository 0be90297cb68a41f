"""Stage 3, Section 4.4: dio, then sgn with its factor, then append the auxiliary states.

The first step replaces every ``dio(psi)``; the second every ``chi*sgn(theta)``, whose
factor may now read the forces of the first; the third appends the states of both, first
the e's, then the a's. The result is the paper's (32).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from nsode.expr import Expr
from nsode.ode import (
    AugmentedODE,
    AuxiliaryState,
    Definition,
    DifferentialInclusion,
    Rate,
    SetValuedTerm,
    State,
)
from nsode.regularizations import law
from nsode.rewrite.conditions import guards
from nsode.rewrite.constants import by_kind, constants
from nsode.rewrite.refusals import check_laws
from nsode.rewrite.velocities import with_velocities

__all__ = ["rewrite"]


def rewrite(inclusion: DifferentialInclusion) -> AugmentedODE:
    """Return the augmented ODE of a differential inclusion.

    Raises
    ------
    ModelError
        NS301 to NS308 for constants that a law cannot use, and for terms that a law
        cannot represent.
    """
    parameters = constants(inclusion)
    check_laws(inclusion)
    differentiated, velocities = with_velocities(inclusion)
    without_dio, deformations = replace_terms(differentiated, "dio", velocities)
    single_valued, displacements = replace_terms(without_dio, "sgn")
    single_valued = replace(
        single_valued,
        parameters=(*inclusion.parameters, *parameters),
        checks=(*inclusion.checks, *guards(by_kind(inclusion))),
    )
    return append(single_valued, [*deformations, *displacements])


def replace_terms(
    inclusion: DifferentialInclusion, kind: str, velocities: Mapping[str, Expr] = {}
) -> tuple[DifferentialInclusion, list[AuxiliaryState]]:
    """Replace the terms of one kind, steps 1 and 2; return their auxiliary states too."""
    bindings: list[Definition] = []
    states: list[AuxiliaryState] = []
    for item in inclusion.bindings:
        if isinstance(item, SetValuedTerm) and item.kind == kind:
            text = inclusion.source.on_one_line(item.span)
            replacement = law(item.approximation.law).replace(item, text, velocities.get(item.name))
            bindings.extend(replacement.bindings)
            states.extend(replacement.states)
        else:
            bindings.append(item)
    return replace(inclusion, bindings=tuple(bindings)), states


def append(system: DifferentialInclusion, auxiliary: Sequence[AuxiliaryState]) -> AugmentedODE:
    """Step 3: append the auxiliary states and their rates."""
    return AugmentedODE(
        system.name,
        system.source,
        (
            *system.states,
            *(State(a.name, a.initial, a.range, a.unit, span=a.span) for a in auxiliary),
        ),
        system.inputs,
        system.parameters,
        system.bindings,
        (*system.rates, *(Rate(a.name, a.rate, a.range, span=a.span) for a in auxiliary)),
        system.outputs,
        system.checks,
        system.run,
        auxiliary=tuple(auxiliary),
    )
