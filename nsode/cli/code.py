"""``nsode code``."""

from __future__ import annotations

from importlib.resources import files

import click

from nsode.cli.terminal import bold, say
from nsode.diagnostics import CODES


@click.command()
@click.argument("code", required=False)
def command(code: str | None) -> None:
    """Explain CODE, such as NS201, with an example; without it, list all codes."""
    if code is None:
        for known, title in CODES.items():
            say(f"{bold(known)}  {title}")
        return
    page = files("nsode").joinpath("catalog", f"{_known(code)}.md")
    say(page.read_text(encoding="utf-8").rstrip("\n"))


def _known(code: str) -> str:
    full = f"NS{code.upper().removeprefix('NS'):0>3}"
    if full not in CODES:
        raise click.BadParameter(f"no code `{code}` (`nsode code` lists them)")
    return full
