"""Options such as ``-p N.K=1e6``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import click

_Value = TypeVar("_Value")
_Callback = Callable[[click.Context, click.Parameter, tuple[str, ...]], dict[str, _Value]]


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
