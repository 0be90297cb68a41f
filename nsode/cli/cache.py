"""``nsode cache``."""

from __future__ import annotations

import click

from nsode.cli.terminal import say


@click.group(invoke_without_command=True)
@click.pass_context
def command(context: click.Context) -> None:
    """Show where compiled models are kept, and how many."""
    if context.invoked_subcommand is None:
        from nsode.simulate import cache

        folder = cache.folder()
        entries = [path.stat().st_size for path in folder.glob("*.so")]
        say(f"{folder}: {len(entries)} compiled models, {sum(entries) / 1e6:.1f} MB")


@command.command()
def clear() -> None:
    """Remove every compiled model; runs compile again what they need."""
    from nsode.simulate import cache

    found = cache.clear()
    say(f"{cache.folder()}: {found.entries} removed, {found.size / 1e6:.1f} MB")
