"""How far Verlet's splitting reaches: its amplification in each active set.

It has no stability function of one variable, for positions, velocities and auxiliary states
are stepped each in its way. Inside an active set every part is linear, so a whole step is a
matrix, and its eigenvalues tell. Those of modes that the regularization adds are told from
the model's own as in :mod:`nsode.analysis.stability`: with K s^2, alpha/s, beta/s and h/s an
added mode is multiplied by the same number, and one of the model's own by its s-th root.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nsode.analysis.local import Constants, Local
from nsode.analysis.point import Matrix
from nsode.analysis.scene import Scene
from nsode.analysis.sets import CONTACT, STICK, ActiveSet, Mode, matrix
from nsode.analysis.stability import FASTER, Modes, Worst, sped_up, upper
from nsode.integrators.verlet import velocities

_FIRST, _RATIO, _LAST = 0.1, 1.2, 1e6  # steps that are tried, times the fastest eigenvalue
_ROUNDING = 1e-6  # of a multiplier: what is left of a double one, as a free flight has
_HALVINGS = 24
_LARGE = 0.3  # of the largest share of a mode in what leaves


class _Kinds(NamedTuple):
    """Which rows are velocities, positions, e's and a's; ones and zeros."""

    kicked: Matrix
    moved: Matrix
    pressed: Matrix
    slid: Matrix


@dataclass(frozen=True, slots=True)
class Split:
    """A step of Verlet in a number of active sets, the first axis of the arrays.

    A flow is ``gain*tau*rate`` with ``gain = 1 - exp(-h/tau)``; where friction sticks, or
    turns, the sliding velocity is followed over all of the step instead.
    """

    rates: Matrix
    times: Matrix
    followed: Matrix
    kinds: _Kinds

    @classmethod
    def of(
        cls, scene: Scene, local: Local, constants: Sequence[Constants], sets: Sequence[ActiveSet]
    ) -> Split:
        """Return the parts of a step in some sets."""
        parts = [_flows(scene, local, constants, active) for active in sets]
        return cls(
            np.array([matrix(local, scene.elements, constants, active) for active in sets]),
            np.array([times for times, _ in parts]),
            np.array([followed for _, followed in parts]),
            _kinds(scene),
        )

    def only(self, chosen: NDArray[np.bool_]) -> Split:
        """Return the same of fewer sets."""
        return Split(self.rates[chosen], self.times[chosen], self.followed[chosen], self.kinds)

    def multipliers(self, h: float) -> NDArray[np.complex128]:
        """Return by what a step multiplies each mode, a row for each set."""
        return np.linalg.eigvals(self.step(h)).astype(np.complex128)

    def step(self, h: float) -> Matrix:
        """Return the matrix of a whole step: kick, drift, flows and kick."""
        kinds, one = self.kinds, np.eye(self.rates.shape[-1])
        lasting = -np.expm1(-h / self.times)[..., None] * self.times[..., None]
        flow = lasting * self.rates + (h - lasting) * self.followed
        kick = one + h / 2 * kinds.kicked * self.rates
        halfway = kick + h / 2 * kinds.moved * (self.rates @ kick)
        drifted = h * kinds.moved * (self.rates @ halfway)
        pressed = kinds.pressed * (flow @ halfway)
        slid = kinds.slid * (flow @ (halfway + pressed / 2))
        after: Matrix = kick @ (kick + drifted + pressed + slid)
        return after


def _kinds(scene: Scene) -> _Kinds:
    kicked = velocities(scene.inclusion)
    moving = [
        state.name in kicked
        for state in scene.inclusion.states
        for _ in range(1 if state.range is None else len(state.range))
    ]
    contact = [element.is_contact for element in scene.elements for _ in element.rows]
    own, added = np.zeros(len(moving), dtype=bool), np.zeros(len(contact), dtype=bool)
    columns = (
        [*moving, *added],
        [*(not one for one in moving), *added],
        [*own, *contact],
        [*own, *(not one for one in contact)],
    )
    return _Kinds(*(np.array(column, dtype=float)[:, None] for column in columns))


def _flows(
    scene: Scene, local: Local, constants: Sequence[Constants], active: ActiveSet
) -> tuple[Matrix, Matrix]:
    """Return the time constant of each row, 1 where there is none, and what is followed."""
    n, m = local.force.shape
    times, followed = np.ones(n + m), np.zeros((n + m, n + m))
    for element, mode, given in zip(scene.elements, active, constants, strict=True):
        rows = [n + row for row in element.rows]
        times[rows] = given.alpha if mode is CONTACT else given.beta
        if not element.is_contact:
            followed[rows, :n] = _sticking(mode, len(rows)) @ local.slope[list(element.rows)]
    return times, followed


def _sticking(mode: Mode, dimension: int) -> Matrix:
    """Return the projection on the directions in which friction does not slip."""
    if mode is STICK:
        return np.eye(dimension)
    if not mode.direction:
        return np.zeros((dimension, dimension))
    direction = np.array(mode.direction)
    return np.eye(dimension) - np.outer(direction, direction)


@dataclass(frozen=True, slots=True)
class Search:
    """The search for the step at which a mode of some sets leaves the unit circle.

    ``chosen`` tells the modes that count, in the places of their eigenvalues.
    """

    modes: Modes
    split: Split
    faster: Split
    own: bool

    @property
    def chosen(self) -> NDArray[np.bool_]:
        """The modes that count: those of the model itself, or those that are added."""
        modes = self.modes
        kind = ~modes.added if self.own else modes.added
        return kind & modes.present & (modes.values.real <= 0)

    def among(self, sets: NDArray[np.bool_]) -> Search:
        """Return the same search among fewer sets."""
        split, faster = self.split.only(sets), self.faster.only(sets)
        return Search(self.modes.only(sets), split, faster, self.own)

    def leaves(self, h: float) -> NDArray[np.bool_]:
        """Tell in which sets a step multiplies a mode by more than one that grows by itself."""
        found = self.split.multipliers(h)
        growth = self.modes.values.real.max(axis=1, initial=0.0)
        with np.errstate(over="ignore"):
            most = np.exp(2 * h * growth)[:, None] * (1 + _ROUNDING)
        out = (np.abs(found) > most) & (np.abs(found - 1) > _ROUNDING**0.5)
        sets = out.any(axis=1)
        if sets.any():
            after = self.faster.only(sets).multipliers(h / FASTER)
            out[sets] &= _are_added(found[sets], after) != self.own
        gone: NDArray[np.bool_] = out.any(axis=1) & self.chosen.any(axis=1)
        return gone

    def worst(self) -> Worst:
        """Return the first to leave; where none does, the fastest mode and no limit."""
        unit = 1 / float(np.abs(self.modes.values).max())
        inner, outer = 0.0, _FIRST * unit
        while not (out := self.leaves(outer)).any():
            inner, outer = outer, outer * _RATIO
            if outer > _LAST * unit:
                return self._without_limit()
        first = self.among(out)
        for _ in range(_HALVINGS if inner else 0):
            middle = (inner + outer) / 2
            out = first.leaves(middle)
            if out.any():
                outer, first = middle, first.among(out)
            else:
                inner = middle
        return Worst(inner, first.eigenvalue(outer), first.modes.sets[0])

    def _without_limit(self) -> Worst:
        found = np.where(self.chosen, np.abs(self.modes.values), 0.0)
        place, k = np.unravel_index(int(np.argmax(found)), found.shape)
        return Worst(np.inf, upper(self.modes.values[place, k]), self.modes.sets[int(place)])

    def eigenvalue(self, h: float) -> complex:
        """Return the fastest mode of the first set that has a large share in what leaves."""
        values, vectors = np.linalg.eig(self.split.rates[0])
        multipliers, shapes = np.linalg.eig(self.split.step(h)[0])
        adjoint, shape = vectors.conj().T, shapes[:, np.argmax(np.abs(multipliers))]
        independent = adjoint @ vectors + _ROUNDING**2 * np.eye(len(values))  # in a free flight too
        shares = np.abs(np.linalg.solve(independent, adjoint @ shape))
        counted = self.modes.values[0][self.chosen[0]]
        apart = np.abs(values[:, None] - counted).min(axis=1)
        shares[apart > _ROUNDING * np.abs(values).max()] = 0.0
        return upper(complex(max(values[shares >= _LARGE * shares.max()], key=abs)))


def worst(
    scene: Scene,
    local: Local,
    constants: Sequence[Constants],
    modes: Modes,
    own: bool = False,
) -> Worst | None:
    """Return what limits the step of Verlet in some sets; None where nothing moves.

    Parameters
    ----------
    modes
        The eigenvalues of the sets.
    own
        Look at the model's own modes, not at those that the regularization adds.
    """
    split, faster = (
        Split.of(scene, local, given, modes.sets)
        for given in (constants, [sped_up(given) for given in constants])
    )
    search = Search(modes, split, faster, own)
    return search.worst() if search.chosen.any() else None


def _are_added(found: NDArray[np.complex128], after: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """Tell which multipliers stay as they are where the regularization is faster."""
    same = np.abs(after[:, None, :] - found[:, :, None]).min(axis=2)
    root = np.abs(after[:, None, :] - (found ** (1 / FASTER))[:, :, None]).min(axis=2)
    added: NDArray[np.bool_] = same < root
    return added
