"""Which contacts can press at one and the same time.

A contact presses only while its gap is not positive. Gaps that are affine in the state,
``G x + c <= 0``, cannot all close iff some ``y >= 0`` has ``G^T y = 0`` and ``c^T y > 0``
(Farkas): floor and ceiling add up to a clearance whatever the state.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from nsode.analysis.point import Matrix, Vector

_TOLERANCE = 1e-9
_MOST_QUESTIONS = 3000  # beyond, further conflicts stay unknown: more sets, never fewer


def conflicts(slope: Matrix, clearance: Vector) -> list[frozenset[int]]:
    """Return the smallest sets of contacts that no state closes together.

    Parameters
    ----------
    slope : (m, n) array
        The gradients of the gaps, constant in the state.
    clearance : (m,) array
        The gaps at x = 0.
    """
    found: list[frozenset[int]] = []
    _search(slope, clearance, frozenset(range(len(clearance))), found, set())
    return found


def _search(
    slope: Matrix,
    clearance: Vector,
    closed: frozenset[int],
    found: list[frozenset[int]],
    seen: set[frozenset[int]],
) -> None:
    """Gather the smallest conflicts inside ``closed``: each is broken by dropping a member."""
    if closed in seen or len(seen) >= _MOST_QUESTIONS:
        return
    seen.add(closed)
    conflict = next((c for c in found if c <= closed), None)
    if conflict is None:
        conflict = _conflict(slope, clearance, closed)
        if conflict is None:
            return
        found.append(conflict)
    for member in sorted(conflict):
        _search(slope, clearance, closed - {member}, found, seen)


def _conflict(slope: Matrix, clearance: Vector, closed: frozenset[int]) -> frozenset[int] | None:
    members = sorted(closed)
    if not members:
        return None
    length = np.abs(slope[members]).max(axis=1, initial=0.0) + np.abs(clearance[members])
    scale = np.where(length > 0, length, 1.0)
    rows = np.vstack([(slope[members] / scale[:, None]).T, clearance[members] / scale])
    target = np.zeros(len(rows))
    target[-1] = 1.0
    weights = nonnegative_least_squares(rows, target)
    if np.linalg.norm(rows @ weights - target) > _TOLERANCE:
        return None
    used = weights > _TOLERANCE * weights.max()
    return frozenset(member for member, uses in zip(members, used, strict=True) if uses)


def nonnegative_least_squares(a: Matrix, b: Vector) -> Vector:
    """Return the ``x >= 0`` that minimizes ``|a x - b|`` (Lawson and Hanson, 1974, ch. 23)."""
    count = a.shape[1]
    x = np.zeros(count)
    free = np.zeros(count, dtype=bool)
    for _ in range(10 * count + 10):
        gain = a.T @ (b - a @ x)
        gain[free] = -np.inf
        if gain.max(initial=-np.inf) <= _TOLERANCE * 1e-3:
            return x
        free[int(np.argmax(gain))] = True
        while True:
            trial = np.zeros(count)
            trial[free] = np.linalg.lstsq(a[:, free], b, rcond=None)[0]
            if not (trial[free] < 0).any():
                x = trial
                break
            blocked = free & (trial < 0)
            step = (x[blocked] / (x[blocked] - trial[blocked])).min()
            x = x + step * (trial - x)
            free &= x > 1e-15
    return x


def subsets(count: int, excluded: list[frozenset[int]]) -> Iterator[frozenset[int]]:
    """Yield every set of contacts, small ones first, that holds no excluded set."""
    for size in range(count + 1):
        for chosen in map(frozenset, combinations(range(count), size)):
            if not any(bad <= chosen for bad in excluded):
                yield chosen
