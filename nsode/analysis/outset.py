"""A scene where its run starts, and whether what the analysis of steps wants is there."""

from __future__ import annotations

import numpy as np

from nsode.analysis.local import ENDLESS, LAW, Constants, Element, Local
from nsode.analysis.mass import EffectiveMass, effective_mass, static_load
from nsode.analysis.scene import Scene
from nsode.ode import DifferentialInclusion, size

UNDEFINED = "the rates or their derivatives are not finite at the start"


def places(inclusion: DifferentialInclusion) -> int:
    """Return how many states and multipliers there are."""
    own = sum(map(size, inclusion.states))
    return own + sum(size(term) * len(term.multiplier) for term in inclusion.terms)


def at_start(scene: Scene) -> tuple[Local, EffectiveMass, list[float]] | None:
    """Return the linear model at the start under the load there, W, and that load.

    None where something is not finite there.
    """
    unloaded = scene.at(scene.start)
    if not unloaded.is_finite:
        return None
    load = static_load(scene, unloaded, effective_mass(scene, unloaded))
    local = scene.at(scene.start, preload(scene, load))
    return local, effective_mass(scene, local), load


def preload(scene: Scene, load: list[float]) -> np.ndarray:
    """Return a load under which every contact presses, so that each chi shows its slope."""
    forces = np.array(load)
    rows = [row for e in scene.elements if e.is_contact for row in e.rows]
    forces[rows] = np.where(forces[rows] > 0, forces[rows], 1.0)
    return forces


def unknown(scene: Scene, local: Local) -> str | None:
    """Return why steps cannot be told: huge numbers, no constants, or another law."""
    if not scene.elements:
        return "the model has no set-valued term"
    if not local.is_moderate:
        return f"the rates or their derivatives are beyond {ENDLESS:g}"
    reasons = map(_unknown, scene.elements, scene.constants)
    return next((reason for reason in reasons if reason is not None), None)


def _unknown(element: Element, given: Constants) -> str | None:
    name, law = element.term.name, element.term.approximation.law
    if given.known:
        return None
    if law != LAW:
        return f"`{name}` has the law `{law}`, whose steps are not known"
    if np.isnan(given.stiffness) or np.isnan(given.beta):
        return f"`{name}` has no constants: `approximate {name}: ...` gives them"
    return f"a constant of `{name}` is not finite, or no number that is of use"
