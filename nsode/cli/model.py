"""The MODEL argument that the commands share."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import fields
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import CompletionItem

from nsode.cli.failure import io_diagnostic
from nsode.cli.named import named
from nsode.diagnostics import ModelError
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.ode import Binding, SetValuedTerm, size
from nsode.regularizations import laws_of
from nsode.source import Source
from nsode.syntax.reading import decode, read

if TYPE_CHECKING:
    from nsode.compiler import Model


STANDARD_INPUT = "-"
_SHOWN = 6


def source_of(argument: str, limits: Limits = DEFAULT_LIMITS) -> Source:
    """Read the model that an argument names.

    Raises
    ------
    ModelError
        If it cannot be read.
    """
    if argument != STANDARD_INPUT:
        return read(argument, limits)
    try:
        content = sys.stdin.buffer.read(limits.size + 1)
    except OSError as error:
        raise ModelError([io_diagnostic("NS601", error)]) from error
    return decode("<stdin>", content, limits)


def load(argument: str, limits: Limits = DEFAULT_LIMITS) -> Model:
    """Load the model that an argument names.

    Raises
    ------
    ModelError
        If it cannot be read or is refused.
    """
    from nsode import compiler

    return compiler.compile_source(source_of(argument, limits), limits)


_Command = Callable[..., int]


def with_model(command: _Command) -> _Command:
    """Give a command the argument MODEL, and the options that say how to take it.

    The command gets the model itself, loaded and under the laws that are asked for.
    """

    @wraps(command)
    def loading(
        model: str, limits: Limits, friction: str | None, contact: str | None, **options: Any
    ) -> int:
        loaded = load(model, limits).with_law(friction=friction, contact=contact)
        return command(loaded, **options)

    argument = click.argument("model", shell_complete=complete_files)
    return argument(_law_options(limit_option(loading)))


def complete_files(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> list[CompletionItem]:
    """Let the shell complete an argument as the name of a file."""
    return [CompletionItem(incomplete, type="file")]


def _law_options(command: _Command) -> _Command:
    for option, kind in (("--contact", "dio"), ("--friction", "sgn")):
        laws = laws_of(kind)
        text = f"Another law for every {kind}: {', '.join(laws)}."
        command = click.option(option, type=click.Choice(laws), metavar="LAW", help=text)(command)
    return command


def limit_option(command: _Command) -> _Command:
    """Give a command the option ``--limit``, which becomes its argument ``limits``."""
    names = ", ".join(field.name for field in fields(Limits))
    return click.option(
        "--limit", "limits", callback=_limits, multiple=True, metavar="NAME=NUMBER",
        help=f"Raise a limit of what a model may take; may be repeated: {names}.",
    )(command)  # fmt: skip


def folder_option(command: _Command) -> _Command:
    """Give a command the option ``-o``, which becomes its argument ``folder``."""
    return click.option(
        "-o", "--output", "folder", callback=_folder, metavar="FOLDER",
        help="The folder to write into, made if need be.  [default: here]",
    )(command)  # fmt: skip


def _folder(context: click.Context, parameter: click.Parameter, value: str | None) -> Path:
    if value in ("", "-"):
        raise click.BadParameter(f"`{value}` is no folder")
    return Path(value or "")


_whole_numbers = named(lambda text: int(float(text)))


def _limits(context: click.Context, parameter: click.Parameter, value: tuple[str, ...]) -> Limits:
    found = _whole_numbers(context, parameter, value)
    try:
        return Limits.of(found)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None


def summary(model: Model) -> str:
    """Return how large the augmented ODE of a model is, on one line."""
    ode = model.ode
    kept = {item.name for item in ode.bindings if isinstance(item, Binding)}
    terms = tuple(term for term in model.inclusion.terms if not kept.isdisjoint(term.multiplier))
    added = sum(map(size, ode.auxiliary))
    own = sum(map(size, ode.states)) - added
    auxiliary = f" + {added:,} auxiliary" if added else ""
    return f"{_count(own, 'state')}{auxiliary}, {_terms(terms)}"


def _terms(terms: tuple[SetValuedTerm, ...]) -> str:
    count = sum(map(size, terms))
    if not count:
        return "no set-valued term"
    shown = ", ".join(f"{_family(term)}: {term.kind}" for term in terms[:_SHOWN])
    more = ", ..." if len(terms) > _SHOWN else ""
    return f"{_count(count, 'set-valued term')} ({shown}{more})"


def _family(term: SetValuedTerm) -> str:
    if term.range is None:
        return term.name
    return f"{term.name}[{term.range.first}..{term.range.last}]"


def _count(number: int, thing: str) -> str:
    return f"{number:,} {thing}" + ("" if number == 1 else "s")
