"""``nsode compile``."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast

import click

from nsode.backends import TARGETS, Options
from nsode.cli.failure import writing
from nsode.cli.model import summary
from nsode.cli.options import folder_option, named, with_model
from nsode.cli.terminal import bold, complain, quiet, say, typed
from nsode.ode import Placed
from nsode.passes.count import operations

if TYPE_CHECKING:
    from nsode.compiler import Model

_SHOWN = 12
_PREFIX = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")


def _prefix(context: click.Context, parameter: click.Parameter, value: str | None) -> str | None:
    """Accept a C identifier: it begins every name in the C, and the names of the files."""
    if value is not None and not _PREFIX.fullmatch(value):
        raise click.BadParameter("a letter, then up to 63 letters, digits and underscores")
    return value


def _names(
    context: click.Context, parameter: click.Parameter, value: str | None
) -> list[str] | None:
    return None if value is None else [name.strip() for name in value.split(",")]


@click.command()
@click.option(
    "-t", "--target", type=click.Choice(list(TARGETS)), default="c", show_default=True,
    help="What to write.",
)  # fmt: skip
@folder_option
@click.option(
    "--real", type=click.Choice(["double", "float"]), default="double", show_default=True,
    help="The numbers of the C.",
)  # fmt: skip
@click.option("--prefix", callback=_prefix, help="What names begin with.  [default: the model's]")
@click.option(
    "--outputs", callback=_names, metavar="NAMES",
    help="Keep only what these outputs and states, such as p,v, depend on.",
)  # fmt: skip
@click.option(
    "--bake", callback=named(float), multiple=True, metavar="NAME=NUMBER",
    help="Write a parameter as this number, in SI, for good; may be repeated.",
)  # fmt: skip
@click.option(
    "--ledger", is_flag=True,
    help="Add what each element stores, dissipates and is given to the outputs.",
)  # fmt: skip
@with_model
def command(
    model: Model,
    target: str,
    folder: Path,
    real: str,
    prefix: str | None,
    outputs: list[str] | None,
    bake: dict[str, float],
    ledger: bool,
) -> int:
    """Write MODEL as code that integrates.

    The C is plain C99 without allocation: copy it anywhere. Every file is written
    whole, or none is.
    """
    complain(model.diagnostics, model.source)
    if ledger:
        model = model.with_ledger()
    whole = model
    if outputs is not None:
        model = model.only(outputs)
    if bake:
        model = model.baked(bake)
    options = Options(prefix=prefix, real=cast(Literal["double", "float"], real))
    with writing():
        paths = model.compile(target, folder, options)
    say(f"{bold(model.name)}: {_size(model)}")
    if model is not whole:
        _show_reduction(whole, model, bake)
    _show(paths)
    return 0


def _size(model: Model) -> str:
    return f"{summary(model)}, {operations(model.ode):,} operations"


def _show_reduction(whole: Model, kept: Model, baked: Mapping[str, float]) -> None:
    """Say what the model was, and what has become of the rest."""
    if _size(whole) != _size(kept):
        say(f"  before: {_size(whole)}")
    _show_list("states left out", _dropped(whole.ode.states, kept.ode.states))
    _show_list("outputs left out", _dropped(whole.ode.outputs, kept.ode.outputs))
    units = {parameter.name: parameter.unit for parameter in whole.ode.parameters}
    shown = (f"{name} = {value!r} {units[name] or ''}" for name, value in baked.items())
    _show_list("baked in", [text.rstrip() for text in shown])


def _dropped(before: Sequence[Placed], after: Sequence[Placed]) -> list[str]:
    kept = {item.name for item in after}
    return [item.name for item in before if item.name not in kept]


def _show_list(title: str, items: list[str]) -> None:
    if items:
        more = f" and {len(items) - _SHOWN:,} more" if len(items) > _SHOWN else ""
        say(f"  {title}: {', '.join(items[:_SHOWN])}{more}")


def _show(paths: list[Path]) -> None:
    width = max(len(str(path)) for path in paths)
    for path in paths:
        say(f"  {path!s:<{width}}  {_bytes(path.stat().st_size):>8}")
    hint = _next(paths)
    if hint is not None:
        say(quiet(f"next: {hint}"))


def _bytes(count: float) -> str:
    for unit in ("B", "kB", "MB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} GB"


def _next(paths: list[Path]) -> str | None:
    """Return the command that uses what was written."""
    for path in paths:
        match path.suffix:
            case ".c":
                return f"gcc -O2 -I {typed(path.parent)} main.c {typed(path)} -lm"
            case ".py":
                return f"PYTHONPATH={typed(path.parent)} python -c 'import {path.stem}'"
    return None
