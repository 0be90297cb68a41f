"""How far a run is, for those who wait."""

from __future__ import annotations

import time

import click

_AFTER = 0.5  # seconds
_WIDTH = 30  # characters


class Bar:
    """A bar on standard error, once a run takes longer than a moment."""

    def __init__(self) -> None:
        self.begin = time.monotonic()
        self.shown = False

    def __call__(self, taken: int, steps: int) -> None:
        """Show that so many steps of all are taken."""
        passed = time.monotonic() - self.begin
        if passed < _AFTER:
            return
        self.shown = True
        share = taken / steps
        bar = ("#" * round(share * _WIDTH)).ljust(_WIDTH)
        left = passed * (1 - share) / share if share else float("inf")
        click.echo(f"\r[{bar}] {100 * share:3.0f} %, {left:.0f} s left \033[K", nl=False, err=True)

    def wipe(self) -> None:
        """Leave the line as it was."""
        if self.shown:
            click.echo("\r\033[K", nl=False, err=True)
