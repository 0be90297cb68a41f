"""What a failed command says and the exit code it leaves."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

import click

from nsode.cli.terminal import complain
from nsode.diagnostics import Diagnostic, ModelError

REFUSED = 1
USAGE = 2
_INTERRUPTED = 130
_BROKEN_PIPE = 141

#: Libraries that nsode does without until somebody asks for what they do.
OPTIONAL = ("casadi", "sympy", "pint", "scipy", "matplotlib")

_DEEDS = {"NS601": ("read", "standard input"), "NS602": ("write", "standard output")}
_OUTSIDE = frozenset({"NS601", "NS602", "NS603"})


def report(error: BaseException) -> int:
    """Show an error to a person and return the exit code."""
    match error:
        case ModelError():
            complain(error.diagnostics, error.source)
            return status_of(error)
        case click.exceptions.NoArgsIsHelpError():
            click.echo(error.ctx.get_help() if error.ctx else error.message, err=True)
        case click.UsageError():
            complain([_usage(error)])
        case click.ClickException():
            complain([Diagnostic("NS603", _lowered(error.format_message()))])
        case KeyboardInterrupt():
            return _INTERRUPTED
        case BrokenPipeError():
            _let_go_of_stdout()
            return _BROKEN_PIPE
        case ModuleNotFoundError(name=str(name)) if name in OPTIONAL:
            complain([missing(name)])
        case MemoryError():
            message = "this does not fit into the memory of the machine"
            complain([Diagnostic("NS014", message, help="take fewer elements, or store less")])
        case OSError(filename=None):
            complain([io_diagnostic("NS602", error)])
        case OSError():
            complain([io_diagnostic("NS601", error)])
        case _:
            _internal(error)
    return USAGE


def status_of(error: ModelError) -> int:
    """Return the exit code for a refused model: 2 where it is the file and not the model."""
    errors = [d.code for d in error.diagnostics if d.severity == "error"]
    return USAGE if errors and _OUTSIDE.issuperset(errors) else REFUSED


@contextmanager
def writing() -> Iterator[None]:
    """Refuse with NS602 what the system does not let us write.

    Raises
    ------
    ModelError
        In place of an OSError.
    """
    try:
        yield
    except OSError as error:
        raise ModelError([io_diagnostic("NS602", error)]) from error


def io_diagnostic(code: Literal["NS601", "NS602"], error: OSError) -> Diagnostic:
    """Return what the system says of a file, or of a standard stream, as a message."""
    deed, stream = _DEEDS[code]
    named = isinstance(error.filename, str | bytes)
    place = f"`{os.fsdecode(error.filename)}`" if named else stream
    reason = (error.strerror or str(error) or type(error).__name__).lower()
    return Diagnostic(code, f"cannot {deed} {place}: {reason}")


def missing(module: str) -> Diagnostic:
    """Return the message for an optional library that is not installed."""
    return Diagnostic("NS603", f"`{module}` is not installed", help=f"`pip install {module}`")


def _usage(error: click.UsageError) -> Diagnostic:
    path = error.ctx.command_path if error.ctx else "nsode"
    return Diagnostic("NS603", _lowered(error.format_message()), help=f"see `{path} --help`")


def _lowered(message: str) -> str:
    """Return a message of click's in the look of nsode's own."""
    first = message.split(maxsplit=1)[0] if message else ""
    lowered = message if first.isupper() else message[:1].lower() + message[1:]
    return lowered.rstrip(".").replace("'", "`")


def _let_go_of_stdout() -> None:
    """Keep the interpreter from flushing into a pipe that nobody reads."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _internal(error: BaseException) -> None:
    if os.environ.get("NSODE_DEBUG"):
        import traceback

        traceback.print_exception(error)
    what = f"{type(error).__name__}: {error}".splitlines()[0]
    click.echo(
        f"internal error: {what} (a bug of nsode: please report it with the model; "
        "NSODE_DEBUG=1 shows where)",
        err=True,
    )
