"""``nsode explain``."""

from __future__ import annotations

import sys
from operator import methodcaller
from pathlib import Path
from typing import TYPE_CHECKING

import click

from nsode.cli.failure import writing
from nsode.cli.options import with_model
from nsode.cli.terminal import complain, paints, say
from nsode.files import write_binary

if TYPE_CHECKING:
    from nsode.compiler import Model


@click.command()
@click.option(
    "--format", "style", type=click.Choice(["text", "markdown", "latex"]), default="text",
    show_default=True, help="For a terminal, a notebook or a paper.",
)  # fmt: skip
@click.option(
    "-o", "--output", default="-", metavar="FILE",
    help="The file to write.  [default: standard output]",
)  # fmt: skip
@with_model
def command(model: Model, style: str, output: str) -> int:
    """Show how the differential inclusion of MODEL becomes an ODE.

    The inclusion as it is written, each replacement with its line and its equation in
    the paper, the appended states, and the augmented ODE.
    """
    complain(model.diagnostics, model.source)
    explanation = model.explain()
    match style:
        case "text":
            shown = explanation.text(color=output == "-" and paints(sys.stdout))
        case "markdown":
            shown = explanation.markdown()
        case _:
            shown = explanation.latex()
    if output == "-":
        say(shown.rstrip("\n"))
        return 0
    with writing():
        write_binary(Path(output), methodcaller("write", shown.encode()))
    return 0
