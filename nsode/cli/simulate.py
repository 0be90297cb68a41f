"""``nsode simulate``."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import click

from nsode.cli.failure import USAGE, io_diagnostic, missing
from nsode.cli.model import law_options, limit_option, load
from nsode.cli.terminal import complain, quiet, say
from nsode.diagnostics import Diagnostic, ModelError
from nsode.limits import Limits

if TYPE_CHECKING:
    from nsode.compiler import Model
    from nsode.simulate import Manner, Trajectory, Wish
    from nsode.simulate.inputs import Signal

_T = TypeVar("_T")

_INTERRUPTED = 130
_PICTURES = (".png", ".pdf", ".svg")
_PLOT = "-"  # what `--plot` without a file stands for


@click.command()
@click.argument("model")
@click.option("--for", "duration", type=float, metavar="SECONDS", help="How long.")
@click.option("--step", type=float, metavar="SECONDS", help="The size of a step.")
@click.option(
    "--method", metavar="NAME",
    help="rk4, heun, euler, verlet; dopri5, cvodes or SciPy's, which choose their own steps.  "
    "[default: the model's, or rk4]",
)  # fmt: skip
@click.option("--tol", "tolerance", type=float, help="Relative error of such a method's steps.")
@click.option(
    "-p", "--parameter", "parameters", multiple=True, metavar="NAME=VALUE",
    help="Another value of a parameter or a constant, such as N.K=1e6, in SI.",
)  # fmt: skip
@click.option(
    "-u", "--input", "inputs", multiple=True, metavar="NAME=DATA",
    help="An input: a number, or a CSV file with times in its first column.",
)  # fmt: skip
@click.option("--every", type=int, metavar="STEPS", help="Store one row every so many steps.")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), metavar="FILE",
    help="Write what happened to a .npz or .csv file.",
)  # fmt: skip
@click.option(
    "--plot", is_flag=False, flag_value=_PLOT, metavar="[FILE]",
    help="Draw it.  [default file: MODEL.png]",
)  # fmt: skip
@click.option(
    "--ledger", is_flag=True,
    help="Store also what each element stores, dissipates and is given.",
)  # fmt: skip
@click.option("--strict", is_flag=True, help="Refuse what draws a warning before the run.")
@click.option("--no-guard", is_flag=True, help="Go on where energy comes from nothing.")
@law_options
@limit_option
def command(
    model: str,
    duration: float | None,
    step: float | None,
    method: str | None,
    tolerance: float | None,
    parameters: tuple[str, ...],
    inputs: tuple[str, ...],
    every: int | None,
    output: Path | None,
    plot: str | None,
    ledger: bool,
    strict: bool,
    no_guard: bool,
    friction: str | None,
    contact: str | None,
    limits: Limits,
) -> int:
    """Run MODEL as compiled C and show what happened.

    Exit code 0: it ran; 1: it is refused, or went wrong; 2: a file cannot be read or
    written; 130: Ctrl-C. Rows before that are kept.
    """
    from nsode.simulate import Manner, RunError, Wish
    from nsode.simulate.foresee import TOLD

    loaded = load(model, limits, friction=friction, contact=contact)
    if ledger:
        loaded = loaded.with_ledger()
    drawing = None if plot is None else Path(f"{loaded.name}.png" if plot == _PLOT else plot)
    _check_places(output, drawing)
    complain([d for d in loaded.diagnostics if d.code not in TOLD], loaded.source)
    wish = Wish(duration, step, every, method, tolerance=tolerance)

    def tell(diagnostic: Diagnostic) -> None:
        complain([diagnostic], loaded.source)

    manner = Manner(strict, not no_guard, tell, _Bar() if sys.stderr.isatty() else None, limits)
    try:
        trajectory = _run(loaded, wish, parameters, inputs, manner)
        status = _INTERRUPTED if trajectory.meta["run"]["interrupted"] else 0
    except RunError as error:
        trajectory, status = error.trajectory, 1
        complain(error.diagnostics, error.source)
    say(str(trajectory))
    return _write(trajectory, output, drawing) or status


def _check_places(output: Path | None, drawing: Path | None) -> None:
    """Refuse, before a long run, a file that could not be written after it."""
    from nsode.simulate.storage import check_ending

    if output is not None:
        check_ending(output)
    if drawing is not None:
        if drawing.suffix not in _PICTURES:
            known = ", ".join(f"`{ending}`" for ending in _PICTURES)
            raise _unwritable(drawing, f"the name must end in one of {known}")
        if find_spec("matplotlib") is None:
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


def _run(
    model: Model, wish: Wish, parameters: tuple[str, ...], inputs: tuple[str, ...], manner: Manner
) -> Trajectory:
    from nsode.simulate import simulate

    overrides = dict(_pair(text, _number) for text in parameters)
    signals = dict(_pair(text, _signal) for text in inputs)
    try:
        return simulate(
            model.inclusion, model.ode, wish, overrides=overrides, signals=signals, manner=manner
        )
    except ModelError as error:
        error.source = error.source or model.source
        raise
    finally:
        if isinstance(manner.progress, _Bar):
            manner.progress.wipe()


def _pair(text: str, read: Callable[[str, str], _T]) -> tuple[str, _T]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        raise click.UsageError(f"`{text}` is not NAME=VALUE")
    return name.strip(), read(name.strip(), value.strip())


def _number(name: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise click.UsageError(f"the value of `{name}` must be a number, not `{text}`") from None


def _signal(name: str, text: str) -> Signal:
    from nsode.simulate.inputs import read

    try:
        return float(text)
    except ValueError:
        return read(Path(text), name)


def _write(trajectory: Trajectory, output: Path | None, drawing: Path | None) -> int:
    try:
        if output is not None:
            trajectory.save(output)
            say(quiet(f"wrote {output}"))
        if drawing is not None:
            trajectory.plot(file=drawing)
            from nsode.simulate.plot import left_out

            say(quiet(f"wrote {drawing}{left_out(trajectory)}"))
    except OSError as error:
        complain([io_diagnostic("NS602", error)])
        return USAGE
    return 0


class _Bar:
    """How far a run is, on a terminal, once it takes longer than a moment."""

    _AFTER = 0.5  # seconds
    _WIDTH = 30  # characters

    def __init__(self) -> None:
        self.begin = time.monotonic()
        self.shown = False

    def __call__(self, taken: int, steps: int) -> None:
        passed = time.monotonic() - self.begin
        if passed < self._AFTER:
            return
        self.shown = True
        share = taken / steps
        bar = ("#" * round(share * self._WIDTH)).ljust(self._WIDTH)
        left = passed * (1 - share) / share if share else float("inf")
        click.echo(f"\r[{bar}] {100 * share:3.0f} %, {left:.0f} s left \033[K", nl=False, err=True)

    def wipe(self) -> None:
        """Leave the line as it was."""
        if self.shown:
            click.echo("\r\033[K", nl=False, err=True)
