"""``nsode analyze``."""

from __future__ import annotations

import json

import click

from nsode.cli.model import limit_option, load
from nsode.cli.terminal import complain, say
from nsode.limits import Limits


@click.command()
@click.argument("model")
@click.option(
    "--format", "style", type=click.Choice(["text", "json"]), default="text", show_default=True,
    help="For a person, or for a script.",
)  # fmt: skip
@click.option(
    "--impact-speed", type=click.FloatRange(min=0, min_open=True), metavar="M/S",
    help="Of the impacts that are shown.  [default: the first from the start]",
)  # fmt: skip
@limit_option
def command(model: str, style: str, impact_speed: float | None, limits: Limits) -> int:
    """Show what is known of MODEL before it runs.

    Effective mass, the largest stable step of each method and what limits it, restitution,
    penetration and presliding, and what the scene could do without.
    """
    loaded = load(model, limits)
    found = loaded.analyze(impact_speed=impact_speed)
    said = {(d.code, d.message) for d in loaded.diagnostics}
    fresh = [d for d in found.diagnostics if (d.code, d.message) not in said]
    complain([*loaded.diagnostics, *fresh], loaded.source)
    say(json.dumps(found.as_json()) if style == "json" else str(found))
    return 0
