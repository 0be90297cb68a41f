"""The options and arguments that the commands share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from functools import wraps
from pathlib import Path
from typing import Any, TypeVar

import click
from click.shell_completion import CompletionItem

from nsode.cli.model import load
from nsode.limits import Limits
from nsode.regularizations import laws_of

_Command = Callable[..., int]
_Value = TypeVar("_Value")
_Callback = Callable[[click.Context, click.Parameter, tuple[str, ...]], dict[str, _Value]]


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


def named(read: Callable[[str], _Value]) -> _Callback[_Value]:
    """Return the callback of an option that may be repeated as ``NAME=VALUE``.

    ``read`` makes a value of its text, or raises ValueError or OverflowError.
    """

    def gather(
        context: click.Context, parameter: click.Parameter, given: tuple[str, ...]
    ) -> dict[str, _Value]:
        return dict(one(parameter, text) for text in given)

    def one(parameter: click.Parameter, text: str) -> tuple[str, _Value]:
        name, equals, value = (part.strip() for part in text.partition("="))
        try:
            if name and equals:
                return name, read(value)
        except (ValueError, OverflowError):
            pass
        raise click.BadParameter(f"`{text}` is not {parameter.metavar}")

    return gather


_whole_numbers = named(lambda text: int(float(text)))


def _limits(context: click.Context, parameter: click.Parameter, value: tuple[str, ...]) -> Limits:
    found = _whole_numbers(context, parameter, value)
    try:
        return Limits.of(found)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None
