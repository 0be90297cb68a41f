"""``nsode paper``."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import click

from nsode.cli.failure import missing, writing
from nsode.cli.options import folder_option
from nsode.cli.terminal import bold, quiet, say
from nsode.diagnostics import ModelError

_FIGURES = ("fig3", "fig5", "fig7", "fig9", "fig11")


@click.command()
@click.argument("figure", type=click.Choice([*_FIGURES, "all"]), metavar="FIGURE")
@folder_option
def command(figure: str, folder: Path) -> int:
    """Repeat a FIGURE of the paper, and say in words what it shows.

    FIGURE is fig3, fig5, fig7, fig9, fig11, or all of them by `all`. Each is written as
    PDF and PNG, with its words as Markdown and its runs as .npz.
    """
    if find_spec("matplotlib") is None:
        raise ModelError([missing("matplotlib")])
    from nsode import paper

    for name in _FIGURES if figure == "all" else (figure,):
        sheet = paper.draw(name)
        with writing():
            written = paper.write(name, sheet, folder)
        say(f"{bold(paper.FIGURES[name])}\n\n{sheet.text}\n")
        say(quiet("wrote " + ", ".join(map(str, written))))
    return 0
