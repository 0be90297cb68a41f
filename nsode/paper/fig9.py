"""Figure 9: two blocks, a wall and a conveyor, at the paper's step and at a stable one."""

from __future__ import annotations

import warnings

import numpy as np

from nsode.paper.sheet import Sheet, canvas, model
from nsode.simulate import RunWarning, Trajectory
from nsode.simulate.plot import shade

_PAPERS, _STABLE = 1e-3, 5e-4
_SECONDS = 2.0


def sheet() -> Sheet:
    """Return the figure of the paper at both steps."""
    ours = model("two_blocks_conveyor")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RunWarning)  # the point of the figure
        papers = ours.simulate(_SECONDS, _PAPERS)
        rested = ours.simulate(10.0, _PAPERS)
    stable = ours.simulate(_SECONDS, _STABLE)
    quiet = ours.simulate(10.0, _STABLE)
    panels = (
        ("p1.x", "$p_{1x}$ [m]"), ("v1.x", r"$\dot p_{1x}$ [m/s]"),
        ("p1.y", "$p_{1y}$ [m]"), ("p2.y", "$p_{2y}$ [m]"),
    )  # fmt: skip
    with canvas(6.0, len(panels)) as (figure, axes):
        for axis, (name, label) in zip(axes, panels, strict=True):
            axis.plot(papers.t, papers[name], color="#d55e00", lw=0.7, label="1 ms, the paper's")
            axis.plot(stable.t, stable[name], color="k", label="0.5 ms")
            axis.set_ylabel(label)
            shade(axis, stable, "N2")
        axes[0].legend()
        axes[-1].set_xlabel("$t$ [s]")
    limit = next(step for step in ours.analyze().steps if step.method == "rk4")
    rate, largest = limit.eigenvalue.real, 1e3 * limit.step
    text = f"""\
The gray bands are contact between the blocks, in the run at 0.5 ms.

The paper's step of 1 ms lies beyond the limit of RK4. While block 1 sticks on both sides the
fastest eigenvalue is {rate:.0f}/s, and RK4 takes steps up to {largest:.2f} ms.
At 1 ms the overall motion looks right, but the blocks never rest; at 0.5 ms they do:

| step | fastest speed of block 1 from 8 s to 10 s |
|-|-|
| 1 ms | {_unrest(rested):.0e} m/s |
| 0.5 ms | {_unrest(quiet):.0e} m/s |

The motion is sensitive: two correct solvers agree to 1e-6 until 0.7 s only. Where block 1
comes to rest depends on the step; friction holds it anywhere from -39 mm to 65 mm (here
{1e3 * quiet["p1.y"][-1]:.2f} mm)."""
    return Sheet(figure, text, {"1ms": papers, "0.5ms": stable})


def _unrest(run: Trajectory) -> float:
    return float(np.abs(run["v1"][run.t >= 8.0]).max())
