"""The command line. Each command is a module of its own, loaded when it is used."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import NoReturn

import click

from nsode import __version__

#: Every command with the line that stands for it in the help: a command ``name`` is the
#: object ``command`` of the module ``nsode.cli.name``.
COMMANDS: dict[str, str] = {
    "compile": "Write a model as code that integrates.",
    "simulate": "Run a model and show what happened.",
    "analyze": "Show what is known of a model before it runs.",
    "explain": "Show how the inclusion becomes an ODE.",
    "check": "Say whether models are sound, and what is wrong where they are not.",
    "new": "Write a model to start from.",
    "doctor": "Show what nsode finds on this machine.",
    "paper": "Repeat the figures of the paper.",
    "cache": "Show or clear what runs have compiled.",
    "code": "Explain a code such as NS201.",
}

_HELP = """Differential inclusions with dry friction and rigid contact, compiled to ODEs.

MODEL is a file such as rolling_sphere.di, or `-` for standard input."""

_EPILOG = "Start with: nsode new ball, then nsode compile ball.di -t c -o build"


class LazyGroup(click.Group):
    """A group whose help imports no command."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order of the table."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import one command; None where there is none of that name."""
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = import_module(f"nsode.cli.{cmd_name}").command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the table of commands."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that the arguments name, or say which one may be meant."""
        if not args[0].startswith("-") and args[0] not in COMMANDS:
            from nsode.diagnostics import suggest

            hint = suggest(args[0], COMMANDS)
            raise click.UsageError(f"no command `{args[0]}`" + (f": {hint}" if hint else ""), ctx)
        return super().resolve_command(ctx, args)


nsode = LazyGroup(
    "nsode",
    help=_HELP,
    epilog=_EPILOG,
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
click.version_option(__version__, prog_name="nsode", message="%(prog)s %(version)s")(nsode)


def run(arguments: Sequence[str]) -> int:
    """Run one command line and return its exit code; no exception leaves."""
    try:
        with nsode.make_context("nsode", list(arguments)) as context:
            status: int | None = nsode.invoke(context)
        sys.stdout.flush()
    except click.exceptions.Exit as end:
        return end.exit_code
    except (Exception, KeyboardInterrupt) as error:
        from nsode.cli.failure import report

        return report(error)
    return status or 0


def main() -> NoReturn:
    """Run the command line of this process."""
    if "_NSODE_COMPLETE" in os.environ:
        nsode.main(prog_name="nsode")
    _open_streams()
    if hasattr(sys.stdout, "reconfigure"):
        # A terminal that cannot show a character gets its number, not a traceback.
        sys.stdout.reconfigure(errors="backslashreplace")
    sys.exit(run(sys.argv[1:]))


def _open_streams() -> None:
    """Open what a shell closed, as in ``nsode ... >&-``, on nothing."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            stream = Path(os.devnull).open(mode, encoding="utf-8")  # noqa: SIM115 - to the end
            setattr(sys, name, stream)
