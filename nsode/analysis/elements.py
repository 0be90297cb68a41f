"""What each element does on its own: bounces, penetration, presliding, frequency, damping."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, nan, sqrt

import numpy as np

from nsode.analysis.local import ENDLESS, Constants, Element, Local
from nsode.analysis.mass import EffectiveMass
from nsode.analysis.restitution import impact, mapped_restitution
from nsode.analysis.scene import Scene

#: Below this damping ratio a load near the frequency of stick resonates (NUMERICS 3).
LEAST_DAMPING = 0.5
_TOUCH = 1e-6  # m/s: slower than this, the contact is touching already


@dataclass(frozen=True, slots=True)
class Contact:
    """A dio element at an impact of its own mass alone.

    Attributes
    ----------
    effective_mass : float
        1/W of this contact alone, in kg for forces on positions.
    frequency : float
        ``sqrt(K W)``, in rad/s.
    mapped_restitution : float
        Without gravity, the same at any speed.
    impact_speed : float
        Of the first impact from the start of the run, or as given; NaN if neither.
    restitution : float
        At that speed and under the load at the start, measured where the gap is zero.
    penetration : float
        Deepest, at that impact.
    static_penetration : float
        At rest under the load at the start.
    """

    name: str
    effective_mass: float
    frequency: float
    mapped_restitution: float
    impact_speed: float
    restitution: float
    penetration: float
    static_penetration: float


@dataclass(frozen=True, slots=True)
class Friction:
    """A sgn element in stick.

    Attributes
    ----------
    effective_mass : float
        1/W in its stiffest direction.
    frequency, damping : float
        Of stick: ``sqrt(K W)`` in rad/s, and ``beta*frequency/2``.
    limit : float
        chi under the load at the start.
    presliding : float
        ``chi/K``: how far it gives before it slips.
    """

    name: str
    effective_mass: float
    frequency: float
    damping: float
    limit: float
    presliding: float

    @property
    def may_resonate(self) -> bool:
        """Whether a load near the frequency of stick is amplified."""
        return self.damping < LEAST_DAMPING


def contacts(
    scene: Scene, local: Local, mass: EffectiveMass, load: list[float], speed: float | None
) -> tuple[Contact, ...]:
    """Return what is known of each dio element that acts on an acceleration."""
    return tuple(
        _contact(element, given, local, mass, load, speed)
        for element, given in zip(scene.elements, scene.constants, strict=True)
        if element.is_contact
        and given.known
        and degree(element, mass) == 2
        and 1 / ENDLESS < inverse_mass(element, mass) < ENDLESS
    )


def frictions(scene: Scene, local: Local, mass: EffectiveMass) -> tuple[Friction, ...]:
    """Return what is known of each sgn element that acts on its sliding velocity."""
    return tuple(
        _friction(element, given, local, mass)
        for element, given in zip(scene.elements, scene.constants, strict=True)
        if not element.is_contact
        and given.known
        and 1 / ENDLESS < inverse_mass(element, mass) < ENDLESS
    )


def degree(element: Element, mass: EffectiveMass) -> int:
    """Return how often an element's argument is derived until its multiplier shows."""
    return mass.degrees[element.rows[0]]


def inverse_mass(element: Element, mass: EffectiveMass) -> float:
    """Return the largest eigenvalue of an element's own block of W."""
    block = mass.array[np.ix_(element.rows, element.rows)]
    return float(np.linalg.eigvalsh(0.5 * (block + block.T)).max())


def _contact(
    element: Element,
    given: Constants,
    local: Local,
    mass: EffectiveMass,
    load: list[float],
    speed: float | None,
) -> Contact:
    (row,) = element.rows
    w = inverse_mass(element, mass)
    frequency = sqrt(given.stiffness * w)
    ratio, kappa = given.beta / given.alpha, given.alpha * frequency
    pressing = max(0.0, -float(local.motion[row] @ local.rates))
    met = _impact_speed(local, row, pressing) if speed is None else speed
    restitution = depth = nan
    if isfinite(met):
        seen = impact(ratio, kappa, pressing / (met * frequency))
        restitution, depth = seen.restitution, seen.penetration * met / frequency
    return Contact(
        element.name,
        1.0 / w,
        frequency,
        mapped_restitution(ratio, kappa),
        met,
        restitution,
        depth,
        load[row] / given.stiffness,
    )


def _impact_speed(local: Local, row: int, pressing: float) -> float:
    """Return the speed at which the gap closes under its constant load, NaN if it does not."""
    gap, velocity = float(local.argument[row]), float(local.velocity[row])
    if gap < 0 or (pressing == 0 and velocity >= 0):
        return nan
    met = sqrt(velocity**2 + 2.0 * pressing * gap)
    return met if met > _TOUCH else nan


def _friction(element: Element, given: Constants, local: Local, mass: EffectiveMass) -> Friction:
    w = inverse_mass(element, mass)
    frequency = sqrt(given.stiffness * w)
    limit = float(local.factor[element.number])
    return Friction(
        element.name,
        1.0 / w,
        frequency,
        0.5 * given.beta * frequency,
        limit,
        limit / given.stiffness,
    )
