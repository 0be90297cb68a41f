"""The largest stable step of each method, what limits it, and what would change it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from nsode.analysis import amplification
from nsode.analysis.local import Constants, Element, Local
from nsode.analysis.reach import conflicts
from nsode.analysis.scene import Scene
from nsode.analysis.sets import CONTACT, MOST_SETS, ActiveSet, Family, matrix
from nsode.analysis.stability import Modes, Worst, bound, half_disc, reach
from nsode.integrators import Scheme
from nsode.integrators.splittings import Verlet

#: What a limit can be told of.
Method = Scheme | Verlet

_ROUNDS = 3
_EFFORT = 4e7  # tries in a round of the search, times the cube of the size
_DEARER = 100  # as many matrices are looked at for one set where a method is a splitting
_NUDGE = 0.99


@dataclass(frozen=True, slots=True)
class StableStep:
    """The largest step with which a method holds every mode that the regularization adds.

    Attributes
    ----------
    step : float
        In seconds. Where the sets are too many to look at each, the proven bound, or
        the least that a search found where the method has none.
    proven : bool
        Whether every active set is within ``step``.
    found : float
        The least limit among the sets that were looked at, whose mode follows.
    eigenvalue : complex
        Of the limiting mode, in 1/s.
    modes : tuple of (element, mode)
        The limiting active set.
    own : float, optional
        The same limit for the model's own modes; 0: no margin (an undamped spring).
    change : tuple of (constant, exponent)
        What moves the limit most: it grows as ``constant**exponent``.
    """

    method: str
    step: float
    proven: bool
    found: float
    eigenvalue: complex
    modes: tuple[tuple[str, str], ...]
    own: float | None
    change: tuple[tuple[str, float], ...]

    @property
    def frequency(self) -> float:
        """The magnitude of the eigenvalue, in rad/s."""
        return abs(self.eigenvalue)

    @property
    def damping(self) -> float:
        """The damping ratio of the limiting mode, 1 where it does not oscillate."""
        return 0.0 - self.eigenvalue.real / abs(self.eigenvalue)


@dataclass(frozen=True, slots=True)
class Reachable:
    """A scene at a point with its active sets; ``sets`` None where they are too many."""

    scene: Scene
    local: Local
    family: Family
    sets: tuple[ActiveSet, ...] | None

    @property
    def elements(self) -> Sequence[Element]:
        """The elements of the scene."""
        return self.scene.elements

    @property
    def constants(self) -> Sequence[Constants]:
        """Their constants."""
        return self.scene.constants

    def named(self, active: ActiveSet) -> tuple[tuple[str, str], ...]:
        """Return what each element does in a set, by names."""
        return tuple((e.name, str(mode)) for e, mode in zip(self.elements, active, strict=True))

    def modes(self, sets: Sequence[ActiveSet]) -> Modes:
        """Return the eigenvalues of some sets."""
        return Modes.of(self.local, self.elements, self.constants, sets)

    def worst(self, method: Method, modes: Modes, own: bool = False) -> Worst | None:
        """Return what limits a method among the modes of some sets, added ones or its own."""
        if isinstance(method, Verlet):
            return amplification.worst(self.scene, self.local, self.constants, modes, own)
        return modes.worst(method, own)


def reachable(scene: Scene, local: Local, most: int = MOST_SETS) -> Reachable:
    """Return the active sets of a scene that one state can reach.

    Gaps that are not affine in the state, or that move with time, exclude nothing. More
    than ``most`` sets are not listed.
    """
    rows = [row for e in scene.elements if e.is_contact for row in e.rows]
    excluded: list[frozenset[int]] = []
    if len(rows) > 1 and not scene.gaps_bend:
        slope = local.slope[rows]
        excluded = conflicts(slope, local.argument[rows] - slope @ scene.start_state)
    family = Family(scene.elements, local, tuple(excluded))
    sets = family.listed(most)
    return Reachable(scene, local, family, None if sets is None else tuple(sets))


def stable_steps(
    points: Sequence[Reachable], schemes: Mapping[str, Method]
) -> dict[str, StableStep]:
    """Return the least limit over some points for each method that has one."""
    found: dict[str, StableStep] = {}
    for place in points:
        whole = None if place.sets is None else place.modes(place.sets)
        for name, scheme in schemes.items():
            step = _stable_step(place, whole, name, scheme)
            if step is not None and (name not in found or step.step < found[name].step):
                found[name] = step
    return found


def _stable_step(
    place: Reachable, whole: Modes | None, name: str, scheme: Method
) -> StableStep | None:
    modes = whole or _searched(place, scheme)
    worst, own = place.worst(scheme, modes), place.worst(scheme, modes, own=True)
    if worst is None:
        return None
    step, proven = worst.step, whole is not None
    if not proven and not isinstance(scheme, Verlet) and half_disc(scheme) > 0:
        step = half_disc(scheme) / bound(place.local, place.elements, place.constants)
        proven = True
    return StableStep(
        name,
        step,
        proven,
        worst.step,
        worst.eigenvalue,
        place.named(worst.active),
        None if own is None else own.step,
        tuple(_elasticities(place, worst, scheme)),
    )


def _elasticities(place: Reachable, worst: Worst, scheme: Method) -> list[tuple[str, float]]:
    """Return how the limit follows each constant, the strongest first, weak ones left out."""
    found: dict[str, float] = {}
    if not 0 < worst.step < np.inf:
        return []
    for term in dict.fromkeys(element.term.name for element in place.elements):
        for word, field in (("K", "stiffness"), ("alpha", "alpha"), ("beta", "beta")):
            nudged = [
                replace(c, **{field: getattr(c, field) * _NUDGE}) if e.term.name == term else c
                for e, c in zip(place.elements, place.constants, strict=True)
            ]
            step = _limit(place, worst, scheme, nudged)
            if not 0 < step < np.inf:  # an elastic contact grows with any less of beta
                continue
            power = np.log(step / worst.step) / np.log(_NUDGE)
            found[f"{term}.{word}"] = round(float(power), 2) + 0.0
    strong = [(name, power) for name, power in found.items() if abs(power) >= 0.05]
    return sorted(strong, key=lambda pair: -abs(pair[1]))


def _limit(place: Reachable, worst: Worst, scheme: Method, constants: Sequence[Constants]) -> float:
    """Return where the limiting set leaves a method with other constants."""
    if isinstance(scheme, Verlet):
        modes = Modes.of(place.local, place.elements, constants, [worst.active])
        found = amplification.worst(place.scene, place.local, constants, modes)
        return np.inf if found is None else found.step
    values = np.linalg.eigvals(matrix(place.local, place.elements, constants, worst.active))
    near = values[np.argmin(np.abs(values - worst.eigenvalue))]
    return reach(scheme, complex(near))


def _searched(place: Reachable, scheme: Method) -> Modes:
    """Return the sets that a search met: all press, then one change at a time for the worse.

    The larger the scene, the fewer changes are tried.
    """
    places = sum(place.local.force.shape)
    dearer = _DEARER if isinstance(scheme, Verlet) else 1
    tries = max(2, int(_EFFORT / places**3 / dearer))
    best = place.modes(list(_beginnings(place.family)))
    worst = place.worst(scheme, best)
    for _ in range(_ROUNDS):
        if worst is None:
            break
        modes = place.modes(list(islice(_neighbors(place.family, worst.active), tries)))
        after = place.worst(scheme, modes)
        if after is None or after.step >= worst.step:
            break
        best, worst = modes, after
    return best


def _beginnings(family: Family) -> Iterator[ActiveSet]:
    pressing = set(range(len(family.contacts)))
    for conflict in family.excluded:
        if conflict <= pressing:
            pressing.discard(max(conflict))
    for chosen in (frozenset(pressing), frozenset[int]()):
        options = family.options(chosen)
        for k in range(max(map(len, options))):
            yield tuple(modes[min(k, len(modes) - 1)] for modes in options)


def _neighbors(family: Family, active: ActiveSet) -> Iterable[ActiveSet]:
    """Yield the sets in which one contact or one friction does something else."""
    contacts = [k for k, e in enumerate(family.elements) if e.is_contact]
    pressing = frozenset(n for n, k in enumerate(contacts) if active[k] == CONTACT)
    options = family.options(pressing)
    for k, modes in enumerate(options):
        yield from ((*active[:k], mode, *active[k + 1 :]) for mode in modes)
    for n in range(len(contacts)):
        changed = pressing ^ {n}
        if not any(conflict <= changed for conflict in family.excluded):
            after = family.options(changed)
            yield tuple(
                mode if mode in modes else modes[0]
                for mode, modes in zip(active, after, strict=True)
            )
