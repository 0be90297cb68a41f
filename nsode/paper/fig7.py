"""Figure 7: a sphere falls, bounces, slips and rolls."""

from __future__ import annotations

import numpy as np

from nsode.paper.sheet import Sheet, canvas, model
from nsode.simulate import Mode
from nsode.simulate.plot import shade


def sheet() -> Sheet:
    """Return the figure: height, velocities, slip."""
    run = model("rolling_sphere").simulate(4.0, 1e-3)
    slip = run["v.x"] - 0.5 * run["w.y"]
    with canvas(4.6, 3) as (figure, (height, speed, sliding)):
        height.plot(run.t, run["p.z"], "k")
        height.axhline(0.5, color="0.5", ls=":", lw=0.8)
        height.set_ylabel("$p_z$ [m]")
        speed.plot(run.t, run["v.x"], "k", label=r"$\dot p_x$")
        speed.plot(run.t, 0.5 * run["w.y"], "k--", label=r"$R\,\omega_y$")
        speed.axhline(5.5 * 5 / 7, color="0.5", ls=":", lw=0.8)
        speed.set_ylabel("[m/s]")
        speed.legend()
        sliding.plot(run.t, slip, "k")
        sliding.set_ylabel("slip [m/s]")
        sliding.set_xlabel("$t$ [s]")
        for axis in (height, speed, sliding):
            shade(axis, run, "N")
    rolling = run.t[np.flatnonzero(run.mode("F") == Mode.SLIP)[-1]]
    final = run["v.x"][-1] / (5.5 * 5 / 7) - 1
    text = f"""\
The gray bands are contact. Each bounce takes a share of the slip; it ends at {rolling:.3f} s,
and from there on the sphere rolls. Its speed is then 5/7 of the one it came with, whatever mu
and however often it bounced: off by {abs(final):.0e} of it at the end of this run.

Deepest penetration {1e3 * max(-run["N.psi"]):.2f} mm, at rest {1e3 * -run["N.psi"][-1]:.3f} mm
(M*g/K): the price of an approximation by a stiff element."""
    return Sheet(figure, text, {"run": run})
