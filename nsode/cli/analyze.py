"""``nsode analyze``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from nsode.cli.options import with_model
from nsode.cli.terminal import complain, say

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from nsode.compiler import Model

_MOST = 100  # states of a run that are looked at


@click.command()
@click.option(
    "--format", "style", type=click.Choice(["text", "json"]), default="text", show_default=True,
    help="For a person, or for a script.",
)  # fmt: skip
@click.option(
    "--impact-speed", type=click.FloatRange(min=0, min_open=True), metavar="M/S",
    help="Of the impacts that are shown.  [default: the first from the start]",
)  # fmt: skip
@click.option(
    "--along", "run", type=click.Path(path_type=Path), metavar="RUN.npz",
    help=f"Look also at {_MOST} states of a run that was saved.",
)  # fmt: skip
@with_model
def command(model: Model, style: str, impact_speed: float | None, run: Path | None) -> int:
    """Show what is known of MODEL before it runs.

    Effective mass, the largest stable step of each method and what limits it, restitution,
    penetration and presliding, and what the scene could do without.
    """
    states = () if run is None else _states(model, run)
    found = model.analyze(along=states, impact_speed=impact_speed)
    said = {(d.code, d.message) for d in model.diagnostics}
    fresh = [d for d in found.diagnostics if (d.code, d.message) not in said]
    complain([*model.diagnostics, *fresh], model.source)
    say(json.dumps(found.as_json()) if style == "json" else str(found))
    return 0


def _states(model: Model, path: Path) -> NDArray[np.float64]:
    """Return states of a saved run from its start to its end, as many as are looked at."""
    import numpy as np

    from nsode.ode import element_names
    from nsode.simulate.storage import load as saved

    run = saved(path)
    names = element_names(model.inclusion.states)
    if list(run.x_names[: len(names)]) != list(names):
        raise click.UsageError(f"`{path}` is no run of `{model.name}`: its states are others")
    rows = np.unique(np.linspace(0, len(run) - 1, min(len(run), _MOST)).astype(int))
    return run.x[rows, : len(names)]
