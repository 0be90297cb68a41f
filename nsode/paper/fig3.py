"""Figure 3: the paper's law sticks where LuGre and Dahl drift."""

from __future__ import annotations

import numpy as np

from nsode.paper.sheet import Sheet, canvas, model
from nsode.simulate import Trajectory
from nsode.simulate.plot import COLORS

_SECONDS, _STEP = 20.0, 1e-3
_SETTLED = 10.0  # seconds, after which the start is forgotten


def sheet() -> Sheet:
    """Return the figure: 20 s, where the paper shows the first few."""
    ours = model("dry_friction")
    lugre = ours.with_law(friction="lugre")  # K and F0 are ours, B = K beta and D = 0
    runs = {
        "xiong2013": ours.simulate(_SECONDS, _STEP),
        "lugre": lugre.simulate(_SECONDS, _STEP),
        "dahl": lugre.simulate(_SECONDS, _STEP, parameters={"F.B": 0.0}),
    }
    long = ours.simulate(1e4, _STEP, every=50, parameters={"omega": 40 * np.pi})
    settled = long["p"][long.t >= _SETTLED]
    with canvas(3.6, 2) as (figure, (load, position)):
        t = runs["xiong2013"].t
        early = np.minimum(0.52, 0.8 * t)
        load.plot(t, np.where(t < 2, early, 0.336 + 0.144 * np.cos(100 * t)), color="0.4", lw=0.4)
        load.axhline(0.5, color="k", ls=":", lw=0.8)
        load.set_ylabel("$f_e$ [N]")
        labels = ("(18), this method", "LuGre, $B = K\\beta$", "Dahl, $B = 0$")
        for (name, run), label, color in zip(runs.items(), labels, COLORS, strict=False):
            position.plot(
                run.t, 1e3 * run["p"], label=label, color=color, lw=0.8, zorder=-len(name)
            )
        position.set_ylabel("$p$ [mm]")
        position.set_xlabel("$t$ [s]")
        position.legend()
    return Sheet(figure, _text(runs, float(np.ptp(settled))), runs)


def _text(runs: dict[str, Trajectory], drift: float) -> str:
    rates = {name: _rate(run) for name, run in runs.items()}
    damper = runs["lugre"].meta["parameters"]["F.B"]
    return f"""\
After t = 2 s the load swings below the level of friction, and a rigid law does not move at
all. Mean velocity from {_SETTLED:g} s to {_SECONDS:g} s:

| law | drift |
|-|-|
| (18), this method | {rates["xiong2013"]:.1e} m/s |
| LuGre (12), B = K*beta = {damper:g} N s/m, D = 0 | {rates["lugre"]:.1e} m/s |
| Dahl, B = D = 0 | {rates["dahl"]:.1e} m/s |

The paper does not state LuGre's B and D; these reproduce its drift. What is left of (18) is
no drift: the mass swings on the spring K, and 100 rad/s do not fit a whole number of steps.
At 40 pi rad/s, 50 steps a period, positions at equal phase differ by {drift:.0e} m over
10,000,000 steps.

The stick of (18) is a spring and a damper, and it resonates. With these constants it does so
near 71 rad/s with a damping ratio of 0.07: there the same load slides the mass, which a rigid
law would hold. A larger beta damps it."""


def _rate(run: Trajectory) -> float:
    """Return the mean velocity once settled, from means over whole periods."""
    late = run.t >= _SETTLED
    slope: float = np.polyfit(run.t[late], run["p"][late], 1)[0]
    return slope
