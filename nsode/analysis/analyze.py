"""The course of an analysis."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from nsode.analysis.elements import Friction, contacts, frictions
from nsode.analysis.formulas import formulas
from nsode.analysis.local import Local, Scene
from nsode.analysis.mass import EffectiveMass, effective_mass, feeding, static_load
from nsode.analysis.minimality import coinciding, unread_states
from nsode.analysis.report import active_text
from nsode.analysis.result import Analysis, Unstable
from nsode.analysis.stability import bound, half_disc
from nsode.analysis.steps import Reachable, StableStep, reachable, stable_steps
from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.integrators import REGISTRY, Scheme
from nsode.limits import DEFAULT_LIMITS, Limits, either
from nsode.ode import AugmentedODE, DifferentialInclusion, size

#: States and multipliers beyond which a step is not checked on every compile.
LARGE = 300
#: Active sets beyond which a compile searches among them instead.
FEW_SETS = 256

_UNDEFINED = "the rates or their derivatives are not finite at the start"
_RESONANCE = "a load near {0:.3g} rad/s is amplified while it sticks"


def analyze(
    inclusion: DifferentialInclusion,
    ode: AugmentedODE,
    *,
    along: Iterable[Sequence[float]] = (),
    impact_speed: float | None = None,
    schemes: Mapping[str, Scheme] | None = None,
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
    begin = _at_start(scene)
    if begin is None:
        raise ModelError([Diagnostic("NS406", _UNDEFINED)], inclusion.source)
    local, mass, load = begin
    states = [np.asarray(x, dtype=float)[: len(scene.state_names)] for x in along]
    places = [reachable(scene, local)]
    places += [
        reachable(scene, scene.at(scene.point(x.tolist()), _preload(scene, load))) for x in states
    ]
    known = _is_known(scene)
    steps = stable_steps(places, REGISTRY if schemes is None else schemes) if known else {}
    sticking = frictions(scene, local, mass)
    sets, modes, growing = _modes(places[0]) if known else (None, (), None)
    return Analysis(
        name=inclusion.name,
        mass=replace(mass, formulas=formulas(scene, mass)),
        steps=tuple(steps.values()),
        sets=sets,
        own_modes=modes,
        growing=growing,
        contacts=contacts(scene, local, mass, load, impact_speed),
        frictions=sticking,
        passive=not feeding(scene, mass) and not mass.asymmetric() and _dissipates(scene),
        unread=unread_states(ode),
        coinciding=coinciding(scene, local),
        idle=_idle(scene, places[1:]),
        diagnostics=(
            *feeding(scene, mass),
            *_resonances(scene, sticking),
            *_unstable(inclusion, steps),
        ),
    )


def warnings(inclusion: DifferentialInclusion) -> tuple[Diagnostic, ...]:
    """Return the warnings that every compile should give: NS402 and NS407.

    Quick: it looks at the model's own method only, and at the sets only where a proven bound
    does not already allow the step. Large models are left out.
    """
    if not inclusion.terms or _places(inclusion) > LARGE:
        return ()
    scene = Scene(inclusion)
    begin = _at_start(scene)
    if begin is None:
        return ()
    local, mass, _ = begin
    found = feeding(scene, mass)
    method, step = inclusion.run.method or "rk4", inclusion.run.step
    if step is None or method not in REGISTRY or not _is_known(scene):
        return tuple(found)
    scheme = REGISTRY[method]
    if step * bound(local, scene.elements, scene.constants) > half_disc(scheme):
        place = reachable(scene, local, most=FEW_SETS)
        found += _unstable(inclusion, stable_steps([place], {method: scheme}))
    return tuple(found)


def _places(inclusion: DifferentialInclusion) -> int:
    """Return how many states and multipliers there are."""
    own = sum(map(size, inclusion.states))
    return own + sum(size(term) * len(term.multiplier) for term in inclusion.terms)


def _refuse_large(inclusion: DifferentialInclusion, limits: Limits) -> None:
    places = _places(inclusion)
    if places > limits.analysis:
        message = f"{places:,} states and multipliers are too many to analyze"
        way_out = f"analyze the same scene with fewer elements: at most {limits.analysis:,} in all"
        help_ = either(way_out, limits.raised("analysis", places))
        raise ModelError([Diagnostic("NS014", message, help=help_)], inclusion.source)


def _at_start(scene: Scene) -> tuple[Local, EffectiveMass, list[float]] | None:
    """Return the linear model at the start under the load there, W, and that load.

    None where something is not finite there.
    """
    unloaded = scene.at(scene.start)
    if not unloaded.is_finite:
        return None
    load = static_load(scene, unloaded, effective_mass(scene, unloaded))
    local = scene.at(scene.start, _preload(scene, load))
    return local, effective_mass(scene, local), load


def _preload(scene: Scene, load: list[float]) -> np.ndarray:
    """Return a load under which every contact presses, so that each chi shows its slope."""
    forces = np.array(load)
    rows = [row for e in scene.elements if e.is_contact for row in e.rows]
    forces[rows] = np.where(forces[rows] > 0, forces[rows], 1.0)
    return forces


def _is_known(scene: Scene) -> bool:
    """Whether every element has its constants and the paper's law."""
    return bool(scene.elements) and all(c.known for c in scene.constants)


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


def _unstable(
    inclusion: DifferentialInclusion, steps: Mapping[str, StableStep]
) -> list[Diagnostic]:
    """Return a warning where the model's own step is beyond its method's limit."""
    method, chosen = inclusion.run.method or "rk4", inclusion.run.step
    limit = steps.get(method)
    if chosen is None or limit is None:
        return []
    if chosen > limit.found:
        return [_beyond(inclusion, limit, chosen)]
    if limit.own is not None and 0 < limit.own < chosen:
        return [_beyond_own(inclusion, limit.own, chosen)]
    return []


def _beyond(inclusion: DifferentialInclusion, limit: StableStep, chosen: float) -> Diagnostic:
    mode = f"a mode of {limit.frequency:.4g} rad/s with damping ratio {limit.damping:.2g}"
    where = active_text(limit.modes) or "no element active"
    ways = [f"take a step of at most {_below(limit.found)} {{s}}"]
    for constant, power in limit.change[:1]:
        ways.append(f"{'lower' if power < 0 else 'raise'} `{constant}`")
    return Diagnostic(
        "NS407",
        f"the step {chosen:g} s is beyond what {limit.method} can take: {limit.found:.3g} s",
        (Label(inclusion.run.span, "where this set occurs, finite and wrong"),),
        notes=(f"the limit is set by {mode}, while {where}",),
        help=", or ".join(ways),
        severity="warning",
    )


def _beyond_own(inclusion: DifferentialInclusion, own: float, chosen: float) -> Diagnostic:
    method = inclusion.run.method or "rk4"
    return Diagnostic(
        "NS407",
        f"the step {chosen:g} s is beyond what {method} can take: {own:.3g} s",
        (Label(inclusion.run.span, "finite and wrong, or not even finite"),),
        notes=("the limit is set by the model's own equations, not by its approximation",),
        help=f"take a step of at most {_below(own)} {{s}}",
        severity="warning",
    )


def _below(step: float) -> str:
    """Return the step with two digits, rounded down."""
    power = 10.0 ** (math.floor(math.log10(step)) - 1)
    return f"{math.floor(step / power * (1 + 1e-12)) * power:.2g}"
