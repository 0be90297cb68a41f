"""The MODEL argument that the commands share."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import fields
from typing import TYPE_CHECKING, TypeVar

import click

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
    if argument == STANDARD_INPUT:
        return decode("<stdin>", sys.stdin.buffer.read(limits.size + 1), limits)
    return read(argument, limits)


def load(
    argument: str,
    limits: Limits = DEFAULT_LIMITS,
    *,
    friction: str | None = None,
    contact: str | None = None,
) -> Model:
    """Load the model that an argument names, under other laws if they are named.

    Raises
    ------
    ModelError
        If it cannot be read or is refused, also under these laws.
    """
    from nsode import compiler

    model = compiler.compile_source(source_of(argument, limits), limits)
    return model.with_law(friction=friction, contact=contact)


_Command = TypeVar("_Command", bound=Callable[..., int])


def law_options(command: _Command) -> _Command:
    """Give a command the options ``--friction`` and ``--contact``."""
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


def _limits(context: click.Context, parameter: click.Parameter, value: tuple[str, ...]) -> Limits:
    found: dict[str, int] = {}
    for item in value:
        name, _, number = item.partition("=")
        try:
            found[name.strip()] = int(float(number))
        except (ValueError, OverflowError):
            raise click.BadParameter(f"`{item}` is not NAME=NUMBER") from None
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
    auxiliary = f" + {added} auxiliary" if added else ""
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
