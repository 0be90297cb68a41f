"""What whole steps make of an impact: a step may be stable and yet too long for a bounce.

An impact begins and ends somewhere inside a step. The contact of :mod:`.restitution` is
integrated by the method itself, in units where ``sqrt(K W)`` and the speed are 1, from
touches at several places in a step.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nsode.integrators import RungeKutta
from nsode.integrators.splittings import Verlet

#: A method whose steps through an impact can be computed.
Stepper = RungeKutta | Verlet

_PLACES = 16  # of the touch in a step
_MOST_STEPS = 1000  # by then even a contact that creeps out has all but lost its speed
_FINE = 0.4  # step times frequency below which RK4 errs by less than 5 % of the speed


def gate(scheme: Stepper) -> float:
    """Return the step, times the frequency, below which impacts need no look."""
    return float(_FINE ** (4 / scheme.order))


def speeds(scheme: Stepper, step: float, ratio: float, kappa: float) -> tuple[float, float]:
    """Return the least and the greatest speed after an impact at speed 1, without gravity.

    Parameters
    ----------
    scheme : RungeKutta or Verlet
        The method.
    step : float
        Times ``sqrt(K W)``.
    ratio, kappa : float
        ``beta/alpha`` and ``alpha*sqrt(K W)``.
    """
    gap = step * (np.arange(_PLACES) + 0.5) / _PLACES
    state = np.stack([gap, np.full(_PLACES, -1.0), np.zeros(_PLACES)])
    with np.errstate(over="ignore", invalid="ignore"):
        for _ in range(_MOST_STEPS):
            state = _advance(scheme, step, ratio, kappa, state)
            force, _ = _response(ratio, kappa, state)
            if np.all((force == 0) & (state[1] >= 0)):
                break
    return float(state[1].min()), float(state[1].max())


def _advance(
    scheme: Stepper, step: float, ratio: float, kappa: float, state: NDArray[np.float64]
) -> NDArray[np.float64]:
    match scheme:
        case RungeKutta():
            return _by_stages(scheme, step, ratio, kappa, state)
        case Verlet():
            return _by_kicks(step, ratio, kappa, state)


def _by_stages(
    scheme: RungeKutta, step: float, ratio: float, kappa: float, state: NDArray[np.float64]
) -> NDArray[np.float64]:
    slopes: list[NDArray[np.float64]] = []
    for row in (*scheme.a, scheme.b):
        at = state + step * sum(float(w) * s for w, s in zip(row, slopes, strict=True))
        force, rate = _response(ratio, kappa, at)
        slopes.append(np.stack([at[1], force, rate]))
    return at


def _by_kicks(
    step: float, ratio: float, kappa: float, state: NDArray[np.float64]
) -> NDArray[np.float64]:
    gap, speed, e = state
    kicked = speed + step / 2 * _response(ratio, kappa, state)[0]
    halfway = gap + step / 2 * kicked
    parted = e + np.expm1(-step / (ratio * kappa)) * e
    pressed = e + np.expm1(-step / kappa) * (halfway + e)
    after = np.stack([gap + step * kicked, kicked, np.maximum(parted, pressed)])
    after[1] += step / 2 * _response(ratio, kappa, after)[0]
    return after


def _response(
    ratio: float, kappa: float, state: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the force of equation (25) and the rate of e, equation (24)."""
    gap, _, e = state
    pressed = (gap + e) / kappa
    force = np.maximum(0.0, e - ratio * kappa * pressed)
    return force, np.maximum(-e / (ratio * kappa), -pressed)
