"""``nsode simulate``."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nsode.cli.failure import missing, writing
from nsode.cli.options import named, with_model
from nsode.cli.progress import Bar
from nsode.cli.terminal import complain, quiet, say
from nsode.diagnostics import Diagnostic, ModelError, quoted

if TYPE_CHECKING:
    from nsode.compiler import Model
    from nsode.simulate import Trajectory
    from nsode.simulate.inputs import Signal

_INTERRUPTED = 130
_PICTURES = (".png", ".pdf", ".svg")
_UNNAMED = "-"  # what `--plot` without a file stands for


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """What the command line asks of a run."""

    duration: float | None
    step: float | None
    method: str | None
    tolerance: float | None
    every: int | None
    parameters: dict[str, float]
    inputs: dict[str, str]
    output: Path | None
    plot: str | None
    ledger: bool
    strict: bool
    no_guard: bool

    def picture(self, model: str) -> Path | None:
        """Return the file to draw into."""
        if self.plot is None:
            return None
        return Path(f"{model}.png" if self.plot == _UNNAMED else self.plot)


def _picture(context: click.Context, parameter: click.Parameter, value: str | None) -> str | None:
    if value in (None, _UNNAMED) or Path(str(value)).suffix in _PICTURES:
        return value
    endings = quoted(_PICTURES)
    raise click.BadParameter(f"`{value}` must end in one of {endings}")


@click.command()
@click.option("--for", "duration", type=float, metavar="SECONDS", help="How long.")
@click.option("--step", type=float, metavar="SECONDS", help="The size of a step.")
@click.option(
    "--method", metavar="NAME",
    help="rk4, heun, euler, verlet; dopri5, cvodes or SciPy's, which choose their own steps.  "
    "[default: the model's, or rk4]",
)  # fmt: skip
@click.option("--tol", "tolerance", type=float, help="Relative error of such a method's steps.")
@click.option(
    "-p", "--parameter", "parameters", callback=named(float), multiple=True, metavar="NAME=NUMBER",
    help="Another value of a parameter or a constant, such as N.K=1e6, in SI.",
)  # fmt: skip
@click.option(
    "-u", "--input", "inputs", callback=named(str), multiple=True, metavar="NAME=DATA",
    help="An input: a number, or a CSV file with times in its first column.",
)  # fmt: skip
@click.option("--every", type=int, metavar="STEPS", help="Store one row every so many steps.")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), metavar="FILE",
    help="Write what happened to a .npz or .csv file.",
)  # fmt: skip
@click.option(
    "--plot", is_flag=False, flag_value=_UNNAMED, callback=_picture, metavar="[FILE]",
    help="Draw it.  [default file: MODEL.png]",
)  # fmt: skip
@click.option(
    "--ledger", is_flag=True,
    help="Store also what each element stores, dissipates and is given; a figure shows it anyway.",
)  # fmt: skip
@click.option("--strict", is_flag=True, help="Refuse what draws a warning before the run.")
@click.option("--no-guard", is_flag=True, help="Go on where energy comes from nothing.")
@with_model
def command(model: Model, **options: Any) -> int:
    """Run MODEL as compiled C and show what happened.

    Exit code 0: it ran; 1: it is refused, or went wrong; 2: a file cannot be read or
    written; 130: Ctrl-C. Rows before that are kept.
    """
    from nsode.simulate import RunError
    from nsode.simulate.foresee import TOLD
    from nsode.simulate.panels import left_out, without_ledger

    order = Order(**options)
    drawing = order.picture(model.name)
    _check_places(order.output, drawing)
    complain([d for d in model.diagnostics if d.code not in TOLD], model.source)
    try:
        kept = order.ledger or drawing is not None
        trajectory = _run(model.with_ledger() if kept else model, order)
        status = _INTERRUPTED if trajectory.meta["run"]["interrupted"] else 0
    except RunError as error:
        trajectory, status = error.trajectory, 1
        complain(error.diagnostics, error.source)
    told = trajectory if order.ledger else without_ledger(trajectory)
    say(str(told))
    if order.output is not None:
        with writing():
            told.save(order.output)
        say(quiet(f"wrote {order.output}"))
    if drawing is not None:
        with writing():
            trajectory.plot(file=drawing)
        say(quiet(f"wrote {drawing}{left_out(trajectory)}"))
    return status


def _check_places(output: Path | None, drawing: Path | None) -> None:
    """Refuse, before a long run, a file that could not be written after it."""
    from nsode.simulate.storage import check_ending

    if output is not None:
        check_ending(output)
    if drawing is not None and find_spec("matplotlib") is None:
        raise ModelError([missing("matplotlib")])
    for path in (output, drawing):
        if path is None:
            continue
        if not path.parent.is_dir():
            raise _unwritable(path, f"there is no folder `{path.parent}`")
        if path.is_dir():
            raise _unwritable(path, "it is a folder")
        if not os.access(path.parent, os.W_OK):
            raise _unwritable(path, f"no right to write into `{path.parent}`")


def _unwritable(path: Path, why: str) -> ModelError:
    return ModelError([Diagnostic("NS602", f"cannot write `{path}`: {why}")])


def _run(model: Model, order: Order) -> Trajectory:
    from nsode.simulate import Manner, Wish, simulate

    def tell(diagnostic: Diagnostic) -> None:
        complain([diagnostic], model.source)

    bar = Bar() if sys.stderr.isatty() else None
    try:
        return simulate(
            model.inclusion,
            model.ode,
            Wish(order.duration, order.step, order.every, order.method, tolerance=order.tolerance),
            overrides=order.parameters,
            signals={name: _signal(name, text) for name, text in order.inputs.items()},
            manner=Manner(order.strict, not order.no_guard, tell, bar, model.limits),
        )
    except ModelError as error:
        error.source = error.source or model.source
        raise
    finally:
        if bar is not None:
            bar.wipe()


def _signal(name: str, text: str) -> Signal:
    from nsode.simulate.inputs import read

    try:
        return float(text)
    except ValueError:
        return read(Path(text), name)
