"""``nsode explain``."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from nsode.cli.failure import USAGE, io_diagnostic
from nsode.cli.model import law_options, limit_option, load
from nsode.cli.terminal import complain, paints, say
from nsode.files import write_all
from nsode.limits import Limits


@click.command()
@click.argument("model")
@click.option(
    "--format", "style", type=click.Choice(["text", "markdown", "latex"]), default="text",
    show_default=True, help="For a terminal, a notebook or a paper.",
)  # fmt: skip
@click.option(
    "-o", "--output", type=click.Path(path_type=Path),
    help="The file to write.  [default: standard output]",
)  # fmt: skip
@law_options
@limit_option
def command(
    model: str,
    style: str,
    output: Path | None,
    friction: str | None,
    contact: str | None,
    limits: Limits,
) -> int:
    """Show how the differential inclusion of MODEL becomes an ODE.

    The inclusion as it is written, each replacement with its line and its equation in
    the paper, the appended states, and the augmented ODE.
    """
    from nsode.explain import explain

    loaded = load(model, limits, friction=friction, contact=contact)
    explanation = explain(loaded.inclusion, loaded.ode)
    match style:
        case "text":
            shown = explanation.text(color=output is None and paints(sys.stdout))
        case "markdown":
            shown = explanation.markdown()
        case _:
            shown = explanation.latex()
    if output is None:
        say(shown.rstrip("\n"))
        return 0
    try:
        write_all({output.name: shown}, output.parent)
    except OSError as error:
        complain([io_diagnostic("NS602", error)])
        return USAGE
    return 0
