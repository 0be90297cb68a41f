"""How one contact bounces: the cubic of (24)-(25) for one mass, solved by its exponential.

While the contact presses, ``psi'' = W f - g`` with ``f = K (e - r (psi + e))`` and
``e' = -(psi + e)/alpha``, which is linear. Three coefficients of restitution differ: mapped
(no gravity, the speed where f returns to zero), released (the same under gravity), and
measured (the speed where the gap is zero again, which is what an observer sees).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nsode.analysis.point import Matrix, Vector

_TERMS = 18  # of the Taylor series of exp, for matrices of norm 1/2


@dataclass(frozen=True, slots=True)
class Impact:
    """An impact as seen by an observer.

    Attributes
    ----------
    restitution : float
        Speed when the gap is zero again, over the speed of the impact; 0 where it never is.
    released : float
        The same where the force returns to zero; 0 where it never does.
    penetration : float
        Deepest penetration, in the unit of the gap.
    duration : float
        Time from touch to release, in seconds; infinite where the contact lasts.
    """

    restitution: float
    released: float
    penetration: float
    duration: float


def mapped_restitution(ratio: float, kappa: float) -> float:
    """Return the coefficient of restitution without gravity, which knows no speed.

    Parameters
    ----------
    ratio : float
        ``beta/alpha``, at least 1.
    kappa : float
        ``alpha*sqrt(K W)``.
    """
    return impact(ratio, kappa, 0.0).released


def impact(ratio: float, kappa: float, weight: float) -> Impact:
    """Return what an impact at speed 1 does, in units where ``sqrt(K W)`` is 1.

    All is NaN where the constants are too far apart for double precision.

    Parameters
    ----------
    ratio, kappa : float
        As in :func:`mapped_restitution`.
    weight : float
        ``g/(v sqrt(K W))``: the acceleration that presses the contact, without unit.
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return _impact(ratio, kappa, weight)


def _impact(ratio: float, kappa: float, weight: float) -> Impact:
    system = _system(ratio, kappa, weight)
    times = _grid(ratio * kappa, weight)
    begin = np.array([0.0, -1.0, 0.0, 1.0])
    path = exponential(system[None] * times[:, None, None]) @ begin
    if not np.isfinite(path).all():
        return Impact(np.nan, np.nan, np.nan, np.nan)
    force = path @ _force(ratio)
    ends = np.flatnonzero(force[1:] <= 0)
    if not len(ends):
        return Impact(0.0, 0.0, float(-path[:, 0].min()), np.inf)
    last = int(ends[0])
    step, state = _release(system, path[last], times[last + 1] - times[last], ratio)
    during = np.vstack([path[: last + 1], state])
    depth = _deepest(system, during, times)
    left = state[1] ** 2 + 2.0 * weight * min(state[0], 0.0) if state[1] > 0 else 0.0
    return Impact(
        float(np.sqrt(max(left, 0.0))), float(max(state[1], 0.0)), depth, float(times[last] + step)
    )


def _system(ratio: float, kappa: float, weight: float) -> Matrix:
    """Return the matrix of (psi, psi', e, 1)."""
    system = np.zeros((4, 4))
    system[0, 1] = 1.0
    system[1] = _force(ratio)
    system[1, 3] -= weight
    system[2, [0, 2]] = -1.0 / kappa
    return system


def _force(ratio: float) -> Vector:
    """Return the coefficients of f/K, equation (25)."""
    return np.array([-ratio, 0.0, 1.0 - ratio, 0.0])


def _grid(damping: float, weight: float) -> Vector:
    """Return times that are close together while the contact moves, and reach its rest."""
    fine = np.arange(0.0, 20.0, 0.01)
    slow = 60.0 * max(1.0, damping, 1.0 / max(damping, 0.02))
    coarse = np.geomspace(20.0, max(slow, 40.0), 1500)[1:]
    return np.concatenate([fine, coarse])


def _release(system: Matrix, state: Vector, width: float, ratio: float) -> tuple[float, Vector]:
    """Return when, after ``state``, the force returns to zero, and the state there."""
    inner, outer = 0.0, width
    for _ in range(60):
        middle = 0.5 * (inner + outer)
        moved = exponential((system * middle)[None])[0] @ state
        inner, outer = (middle, outer) if _force(ratio) @ moved > 0 else (inner, middle)
    return outer, exponential((system * outer)[None])[0] @ state


def _deepest(system: Matrix, path: Matrix, times: Vector) -> float:
    """Return the deepest penetration, from the first sign change of the velocity."""
    turns = np.flatnonzero(path[:, 1] >= 0)
    if not len(turns) or turns[0] == 0:
        return float(-path[:, 0].min())
    before = path[turns[0] - 1]
    inner, outer = 0.0, float(times[turns[0]] - times[turns[0] - 1])
    for _ in range(60):
        middle = 0.5 * (inner + outer)
        moved = exponential((system * middle)[None])[0] @ before
        inner, outer = (middle, outer) if moved[1] < 0 else (inner, middle)
    return float(-(exponential((system * outer)[None])[0] @ before)[0])


def exponential(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the exponentials of a stack of matrices, by scaling and squaring.

    Every matrix is halved as often as its own norm asks for.
    """
    norms = np.abs(matrices).sum(axis=2).max(axis=1)
    halvings = np.maximum(0, np.ceil(np.log2(np.maximum(norms, 1e-300))) + 1).astype(int)
    small = matrices / (2.0**halvings)[:, None, None]
    total = np.broadcast_to(np.eye(matrices.shape[1]), matrices.shape).copy()
    term = total.copy()
    for k in range(1, _TERMS):
        term = term @ small / k
        total += term
    for k in range(int(halvings.max(initial=0))):
        rows = halvings > k
        total[rows] = total[rows] @ total[rows]
    return total
