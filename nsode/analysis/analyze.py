"""The course of an analysis."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from nsode.analysis.elements import Friction, contacts, frictions
from nsode.analysis.formulas import formulas
from nsode.analysis.late import late
from nsode.analysis.mass import feeding
from nsode.analysis.minimality import coinciding, unread_states
from nsode.analysis.outset import UNDEFINED, at_start, places, preload, unknown
from nsode.analysis.remarks import unresolved, unstable
from nsode.analysis.result import Analysis, Unstable
from nsode.analysis.scene import Scene
from nsode.analysis.steps import Method, Reachable, reachable, stable_steps
from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.integrators import REGISTRY
from nsode.integrators.splittings import SPLITTINGS
from nsode.limits import DEFAULT_LIMITS, Limits, either
from nsode.ode import AugmentedODE, DifferentialInclusion

_ALL: Mapping[str, Method] = {**REGISTRY, **SPLITTINGS}
_RESONANCE = "a load near {0:.3g} rad/s is amplified while it sticks"


@np.errstate(all="ignore")
def analyze(
    inclusion: DifferentialInclusion,
    ode: AugmentedODE,
    *,
    along: Iterable[Sequence[float]] = (),
    impact_speed: float | None = None,
    schemes: Mapping[str, Method] | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Analysis:
    """Return what is known of a model before it runs.

    Parameters
    ----------
    inclusion, ode : DifferentialInclusion, AugmentedODE
        The model, before and after the rewrite.
    along : iterable of state vectors, optional
        States of the inclusion (the auxiliary ones may follow) at which the steps are looked
        at too, such as those of a run.
    impact_speed : float, optional
        In m/s; None takes the first impact from the start.
    schemes : mapping of str to Scheme, optional
        The methods; None takes all.
    limits : Limits, optional
        How large a model may be: beyond the usual, matrices take minutes.

    Raises
    ------
    ModelError
        NS014 where there are too many states and multipliers, NS406 where the start has
        no finite rates and derivatives.
    """
    _refuse_large(inclusion, limits)
    scene = Scene(inclusion, [p for p in ode.parameters if p.constant_of is not None])
    begin = at_start(scene)
    if begin is None:
        raise ModelError([Diagnostic("NS406", UNDEFINED)], inclusion.source)
    local, mass, load = begin
    states = [np.asarray(x, dtype=float)[: len(scene.state_names)] for x in along]
    visited = [reachable(scene, local)]
    visited += [
        reachable(scene, scene.at(scene.point(x.tolist()), preload(scene, load))) for x in states
    ]
    why = unknown(scene, local)
    known = why is None
    steps = stable_steps(visited, _ALL if schemes is None else schemes) if known else {}
    sticking = frictions(scene, local, mass)
    sets, modes, growing = _modes(visited[0]) if known else (None, (), None)
    return Analysis(
        name=inclusion.name,
        mass=replace(mass, formulas=formulas(scene, mass)),
        steps=tuple(steps.values()),
        unknown=why if steps or not known else "no active set has finite modes",
        along=len(states),
        sets=sets,
        own_modes=modes,
        growing=growing,
        contacts=contacts(scene, local, mass, load, impact_speed),
        frictions=sticking,
        passive=not feeding(scene, mass) and not mass.asymmetric() and _dissipates(scene),
        unread=unread_states(ode),
        coinciding=coinciding(scene, local),
        idle=_idle(scene, visited[1:]),
        diagnostics=(
            *feeding(scene, mass),
            *late(scene, local),
            *_resonances(scene, sticking),
            *(unstable(inclusion, steps) or unresolved(scene, mass)),
        ),
    )


def _refuse_large(inclusion: DifferentialInclusion, limits: Limits) -> None:
    count = places(inclusion)
    if count > limits.analysis:
        message = f"{count:,} states and multipliers are too many to analyze"
        way_out = f"analyze the same scene with fewer elements: at most {limits.analysis:,} in all"
        help_ = either(way_out, limits.raised("analysis", count))
        raise ModelError([Diagnostic("NS014", message, help=help_)], inclusion.source)


def _dissipates(scene: Scene) -> bool:
    return all(not given.alpha > given.beta for given in scene.constants)


def _modes(place: Reachable) -> tuple[int | None, tuple[complex, ...], Unstable | None]:
    if place.sets is None:
        return None, (), None
    modes = place.modes(place.sets)
    growing = modes.growing()
    unstable = None
    if growing is not None:
        unstable = Unstable(growing.eigenvalue, place.named(growing.active))
    return len(place.sets), tuple(modes.own()), unstable


def _idle(scene: Scene, places: Sequence[Reachable]) -> tuple[str, ...]:
    """Return the contacts whose gap never closes along the given states."""
    if not places:
        return ()
    gaps = np.array([place.local.argument for place in places])
    return tuple(
        e.name for e in scene.elements if e.is_contact and (gaps[:, list(e.rows)] > 0).all()
    )


def _resonances(scene: Scene, found: Sequence[Friction]) -> list[Diagnostic]:
    terms = {element.name: element.term for element in scene.elements}
    return [
        Diagnostic(
            "NS408",
            f"`{item.name}` sticks with a damping ratio of {item.damping:.2g}",
            (Label(terms[item.name].span, "this term"),),
            notes=(_RESONANCE.format(item.frequency),),
            help=f"a damping ratio of 0.8 wants beta = {1.6 / item.frequency:.3g} {{s}}",
            severity="warning",
        )
        for item in found
        if item.may_resonate
    ]
