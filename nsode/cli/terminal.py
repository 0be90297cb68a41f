"""What the commands share to speak to a person."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TextIO

import click

from nsode.diagnostics import Diagnostic, render
from nsode.source import Source


def paints(stream: TextIO) -> bool:
    """Whether a stream wants colors: a terminal, unless ``NO_COLOR`` is set."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return False
    return stream.isatty()


def complain(diagnostics: Sequence[Diagnostic], source: Source | None = None) -> None:
    """Show diagnostics on standard error."""
    if diagnostics:
        text = render(diagnostics, source, color=paints(sys.stderr))
        with suppress(OSError):  # there is no other place to complain
            click.echo(text, err=True, color=True)


def bold(text: str) -> str:
    """Return ``text`` in bold where standard output is a terminal."""
    return click.style(text, bold=True) if paints(sys.stdout) else text


def quiet(text: str) -> str:
    """Return ``text`` toned down where standard output is a terminal."""
    return click.style(text, dim=True) if paints(sys.stdout) else text


def typed(path: Path) -> str:
    """Return a path as a person types it into a shell."""
    text = str(path)
    return shlex.quote(f"./{text}" if text.startswith("-") else text)


def say(text: str = "") -> None:
    """Write a line on standard output."""
    click.echo(text, color=True)
