"""Figure 5: the ratio alpha/beta sets how much of the speed an impact returns."""

from __future__ import annotations

from nsode.paper.sheet import Sheet, canvas, model, zero_speeds

_ALPHAS = (1e-2, 7e-3, 5e-3, 1e-3)
_LOOKS = (("0.6", "--"), ("k", "--"), ("0.6", "-"), ("k", "-"))  # as the paper draws them


def sheet() -> Sheet:
    """Return the figure at the paper's step, and the restitution at a tenth of it."""
    ours = model("bouncing_mass")
    runs = {
        f"{1e3 * alpha:g}ms": ours.simulate(3.0, 1e-3, parameters={"f.alpha": alpha})
        for alpha in _ALPHAS
    }
    with canvas(2.6, 1) as (figure, [axis]):
        for run, alpha, (gray, line) in zip(runs.values(), _ALPHAS, _LOOKS, strict=True):
            axis.plot(run.t, run["p"], color=gray, ls=line, label=rf"$\alpha$ = {1e3 * alpha:g} ms")
        axis.set_xlabel("$t$ [s]")
        axis.set_ylabel("$p$ [m]")
        axis.legend(ncols=4, loc="upper center", bbox_to_anchor=(0.5, 1.18))
    rows = []
    for alpha in _ALPHAS:
        fine = ours.simulate(1.2, 1e-4, parameters={"f.alpha": alpha})
        speeds = zero_speeds(fine["p"], fine["v"])
        rows.append(f"| {1e3 * alpha:g} ms | {speeds[1] / speeds[0]:.4f} |")
    table = "\n".join(rows)
    text = f"""\
beta = 10 ms throughout. The ratio of the speeds at p = 0 after and before the first impact,
at a step of 0.1 ms:

| alpha | measured restitution |
|-|-|
{table}

alpha = beta is perfectly elastic; alpha > beta would create energy, and nsode refuses it.
While it presses, the contact is a Zener solid; without gravity its restitution depends on
beta/alpha and on alpha*sqrt(K/M) alone, not on the speed."""
    return Sheet(figure, text, runs)
