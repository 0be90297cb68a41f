"""``nsode paper``."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import click

from nsode.cli.failure import USAGE, io_diagnostic, missing
from nsode.cli.terminal import bold, complain, quiet, say
from nsode.diagnostics import ModelError

_FIGURES = ("fig3", "fig5", "fig7", "fig9", "fig11")


@click.command()
@click.argument("figure", type=click.Choice([*_FIGURES, "all"]))
@click.option(
    "-o", "--output", "folder", type=click.Path(path_type=Path), default=Path(),
    help="The folder to write into, made if need be.  [default: here]",
)  # fmt: skip
def command(figure: str, folder: Path) -> int:
    """Repeat a FIGURE of the paper, and say in words what it shows.

    Each is written as PDF and PNG, with its words as Markdown and its runs as .npz.
    """
    if find_spec("matplotlib") is None:
        raise ModelError([missing("matplotlib")])
    from nsode import paper

    for name in _FIGURES if figure == "all" else (figure,):
        sheet = paper.draw(name)
        try:
            written = paper.write(name, sheet, folder)
        except OSError as error:
            complain([io_diagnostic("NS602", error)])
            return USAGE
        say(f"{bold(paper.FIGURES[name])}\n\n{sheet.text}\n")
        say(quiet("wrote " + ", ".join(map(str, written))))
    return 0
