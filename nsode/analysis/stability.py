"""How far a method's step reaches: stability regions, and the eigenvalues that set it.

The limit counts the eigenvalues that the regularization adds. They are told from the
model's own by making the regularization faster: with K s^2, alpha/s and beta/s its
eigenvalues move with s, and the model's own stay where they are. A mode that grows by
itself (friction can feed contacts that press at the same time) is no matter of the step;
such modes are listed apart.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from nsode.analysis.local import Constants, Element, Local
from nsode.analysis.point import Vector
from nsode.analysis.sets import ActiveSet, matrix
from nsode.integrators import RungeKutta, Scheme

Spectrum = NDArray[np.complex128]

FASTER = 1.0371  # any factor that no model has between two of its own eigenvalues
_ZERO = 1e-6  # of the largest eigenvalue: what rounding leaves of a zero
_GROWING = 1e-9  # of its magnitude: what rounding leaves of a real part of zero
_CLOSEST = 64  # candidates that are looked at exactly


@dataclass(frozen=True, slots=True)
class Worst:
    """The largest step of a method, and what sets it: an eigenvalue in an active set."""

    step: float
    eigenvalue: complex
    active: ActiveSet


@dataclass(frozen=True, slots=True)
class Growing:
    """A mode that grows by itself, and the active set in which it does."""

    eigenvalue: complex
    active: ActiveSet


def reach(scheme: Scheme, eigenvalue: complex) -> float:
    """Return the largest ``h`` with ``|R(h' eigenvalue)| <= 1`` for all ``h' <= h``.

    A mode that grows by itself has 0, one that does not move has no limit.
    """
    if eigenvalue == 0:
        return np.inf
    return radius(scheme, float(np.angle(eigenvalue))) / abs(eigenvalue)


def radius(scheme: Scheme, angle: float) -> float:
    """Return how far the stability region reaches from 0 in the direction ``angle``."""
    match scheme:
        case RungeKutta():
            return _polynomial_radius(_coefficients(scheme), angle)
        case _:
            return _scanned_radius(scheme.stability, angle)


@lru_cache(maxsize=64)
def _coefficients(scheme: RungeKutta) -> tuple[float, ...]:
    return tuple(map(float, scheme.stability_polynomial))


@lru_cache(maxsize=100_000)
def _polynomial_radius(coefficients: tuple[float, ...], angle: float) -> float:
    """Return the first positive root of ``|R(r e^(i angle))|^2 - 1``, a polynomial in r."""
    excess = np.zeros(2 * len(coefficients) - 1)
    for j, a in enumerate(coefficients):
        for k, b in enumerate(coefficients):
            excess[j + k] += a * b * np.cos((j - k) * angle)
    excess[0] -= 1.0
    excess[np.abs(excess) < 1e-14] = 0.0
    present = np.flatnonzero(excess)
    if not len(present):
        return np.inf
    lowest = present[0]
    if excess[lowest] > 0:
        return 0.0
    roots = np.roots(excess[lowest:][::-1])
    real = roots.real[(np.abs(roots.imag) < 1e-9 * np.abs(roots)) & (roots.real > 0)]
    return float(real.min()) if len(real) else np.inf


def _scanned_radius(stability: Callable[[complex], complex], angle: float) -> float:
    direction = complex(np.cos(angle), np.sin(angle))

    def leaves(r: float) -> bool:
        return abs(stability(r * direction)) > 1.0 + 1e-12

    grid = np.concatenate([np.geomspace(1e-6, 0.01, 60), np.arange(0.02, 60.0, 0.02)])
    outside = next((k for k, r in enumerate(grid) if leaves(float(r))), None)
    if outside is None:
        return np.inf
    if outside == 0:
        return 0.0
    inner, outer = float(grid[outside - 1]), float(grid[outside])
    for _ in range(50):
        middle = 0.5 * (inner + outer)
        inner, outer = (inner, middle) if leaves(middle) else (middle, outer)
    return inner


def half_disc(scheme: Scheme) -> float:
    """Return the radius of the largest half disc in the left half-plane that is stable."""
    return min(radius(scheme, float(angle)) for angle in np.linspace(np.pi / 2, np.pi, 181))


def _table(scheme: Scheme) -> tuple[Vector, Vector]:
    angles = np.linspace(np.pi / 2, np.pi, 181)
    return angles, np.array([min(radius(scheme, float(a)), 1e9) for a in angles])


@dataclass(frozen=True, slots=True)
class Modes:
    """The eigenvalues of a number of active sets, one row for each set.

    ``added`` tells those that the regularization adds, ``present`` those that are not zero.
    """

    sets: Sequence[ActiveSet]
    values: Spectrum
    added: NDArray[np.bool_]
    present: NDArray[np.bool_]

    @classmethod
    def of(
        cls,
        local: Local,
        elements: Sequence[Element],
        constants: Sequence[Constants],
        sets: Sequence[ActiveSet],
    ) -> Modes:
        """Return the eigenvalues of each set."""
        faster = [sped_up(given) for given in constants]
        stack = np.array([matrix(local, elements, constants, s) for s in sets])
        moved = np.array([matrix(local, elements, faster, s) for s in sets])
        values, after = np.linalg.eigvals(stack) + 0j, np.linalg.eigvals(moved) + 0j
        values.real[np.abs(values.real) <= _GROWING * np.abs(values)] = 0.0
        with_it = np.abs(after[:, None, :] - FASTER * values[:, :, None]).min(axis=2)
        behind = np.abs(after[:, None, :] - values[:, :, None]).min(axis=2)
        present = np.abs(values) > _ZERO * np.abs(values).max(axis=1, keepdims=True)
        return cls(sets, values, (with_it < behind) & present, present)

    def only(self, chosen: NDArray[np.bool_]) -> Modes:
        """Return the same of fewer sets."""
        sets = [active for active, taken in zip(self.sets, chosen, strict=True) if taken]
        return Modes(sets, self.values[chosen], self.added[chosen], self.present[chosen])

    def worst(self, scheme: Scheme, own: bool = False) -> Worst | None:
        """Return what limits the step; with ``own``, among the model's own modes."""
        chosen = (~self.added if own else self.added) & self.present & (self.values.real <= 0)
        rows, columns = np.nonzero(chosen)
        if not len(rows):
            return None
        found = self.values[rows, columns]
        angles, radii = _table(scheme)
        guess = np.interp(np.abs(np.angle(found)), angles, radii) / np.abs(found)
        steps = [
            (reach(scheme, upper(found[k])), int(k))
            for k in np.argsort(guess, kind="stable")[:_CLOSEST]
        ]
        least = min(step for step, _ in steps)
        step, k = min((pair for pair in steps if pair[0] <= least * (1 + 1e-9)), key=_order)
        return Worst(step, upper(found[k]), self.sets[int(rows[k])])

    def growing(self) -> Growing | None:
        """Return the added mode that grows fastest by itself, whatever the step."""
        rates = np.where(self.added, self.values.real, 0.0)
        row, column = divmod(int(np.argmax(rates)), rates.shape[1])
        if rates[row, column] <= 0:
            return None
        return Growing(upper(self.values[row, column]), self.sets[row])

    def own(self) -> list[complex]:
        """Return the model's own modes, each once, fast ones first."""
        modes = self.values[~self.added & self.present]
        distinct: list[complex] = []
        for mode in map(upper, modes[np.argsort(-np.abs(modes), kind="stable")]):
            if not any(abs(mode - other) <= 1e-6 * abs(mode) for other in distinct):
                distinct.append(mode)
        return distinct


def _order(pair: tuple[float, int]) -> int:
    return pair[1]


def upper(eigenvalue: complex) -> complex:
    """Return the one of a conjugate pair that has no negative imaginary part."""
    return complex(eigenvalue.real, abs(eigenvalue.imag))


def sped_up(given: Constants, by: float = FASTER) -> Constants:
    """Return the constants with which the same element is faster."""
    return Constants(given.stiffness * by**2, given.alpha / by, given.beta / by)


def bound(local: Local, elements: Sequence[Element], constants: Sequence[Constants]) -> float:
    """Return a proven bound of all eigenvalues in all active sets, slip in any direction.

    Entry by entry, the matrix of every set is at most that of the sums of magnitudes built
    here; and the spectral radius of a nonnegative matrix bounds that of all matrices below
    it (Perron and Frobenius). It is the best of Gershgorin's row sums over all scalings
    of the states.
    """
    n, m = local.force.shape
    force, rates = np.zeros((m, n + m)), np.zeros((m, n + m))
    for element, given in zip(elements, constants, strict=True):
        rows = list(element.rows)
        own = np.zeros((len(rows), n + m))
        own[range(len(rows)), [n + row for row in rows]] = 1.0
        slope = np.abs(np.hstack([local.slope[rows], np.zeros((len(rows), m))]))
        if element.is_contact:
            ratio = given.beta / given.alpha
            force[rows] = given.stiffness * (abs(1.0 - ratio) * own + ratio * slope)
            rates[rows] = np.maximum(own / given.beta, (own + slope) / given.alpha)
        else:
            sticking = given.stiffness * (own + given.beta * slope)
            factor = np.abs(local.factor_force[element.number]) @ force
            factor[:n] += np.abs(local.factor_state[element.number])
            turning = np.eye(len(rows)) + 0.5 * (1 - np.eye(len(rows)))
            sliding = factor + (turning @ sticking if len(rows) > 1 else 0.0)
            force[rows] = np.maximum(sticking, sliding)
            rates[rows] = np.maximum(slope, (sliding / given.stiffness + own) / given.beta)
    motion = np.hstack([np.abs(local.state), np.zeros((n, m))]) + np.abs(local.force) @ force
    return float(np.abs(np.linalg.eigvals(np.vstack([motion, rates]))).max(initial=0.0))
