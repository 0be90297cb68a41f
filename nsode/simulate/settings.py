"""How long, how fine, by which method: settings of a run, refused before it starts."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib.util import find_spec
from numbers import Integral, Real

import numpy as np
from numpy.typing import NDArray

from nsode.diagnostics import Diagnostic, Label, ModelError, quoted, suggest
from nsode.integrators import REGISTRY
from nsode.integrators.pairs import PAIRS
from nsode.integrators.splittings import SPLITTINGS
from nsode.limits import DEFAULT_LIMITS, Limits, either
from nsode.ode import Run

#: Integrators of other libraries by name, with the library.
SOLVERS = {
    "cvodes": "casadi",
    "RK45": "scipy", "RK23": "scipy", "DOP853": "scipy",
    "Radau": "scipy", "BDF": "scipy", "LSODA": "scipy",
}  # fmt: skip

_USUAL_TOLERANCE = 1e-8
_SMALL = 1e-3  # below this a state is judged by its absolute error, in SI
_RESOLVED = 8  # the least step, in distances from one double to the next where a run is
_SECONDS_A_STEP = 1e-7  # of a small scene, for estimates
_DEFAULT_METHOD = next(iter(REGISTRY))


@dataclass(frozen=True, slots=True)
class Wish:
    """What a person asks of a run; None leaves it to the model.

    ``duration``, ``step`` and ``start`` are in seconds; ``every`` counts steps from one
    stored row to the next. ``tolerance`` is the relative error of a step of a method that
    chooses its own steps; to it, ``step`` only says where inputs are read and rows may lie.
    """

    duration: float | None = None
    step: float | None = None
    every: int | None = None
    method: str | None = None
    start: float = 0.0
    tolerance: float | None = None


@dataclass(frozen=True, slots=True)
class Settings:
    """A run that can be made: step ``i`` starts at ``start + i*step``."""

    start: float
    step: float
    steps: int
    every: int
    method: str
    tolerance: float

    @property
    def tolerances(self) -> NDArray[np.float64]:
        """The relative and the absolute error of a step that are tolerated."""
        return np.array([self.tolerance, self.tolerance * _SMALL])

    @property
    def duration(self) -> float:
        """The length of the run in seconds."""
        return self.steps * self.step

    @property
    def rows(self) -> int:
        """The number of stored rows: the start, every so many steps, and the end."""
        return -(-self.steps // self.every) + 1


def settle(
    wish: Wish, run: Run, columns: int, limits: Limits = DEFAULT_LIMITS
) -> tuple[Settings, list[Diagnostic]]:
    """Return the settings of a run and what is to be said about them.

    Parameters
    ----------
    wish
        What was asked for.
    run
        What the model says where nothing was asked for.
    columns
        The numbers in a row, for the limit on memory.
    limits
        How many steps and how much memory a run may take.

    Raises
    ------
    ModelError
        NS501 for settings out of range, NS502 for a run too large, NS503 for what neither
        the wish nor the model says.
    """
    duration = run.duration if wish.duration is None else wish.duration
    step = run.step if wish.step is None else wish.step
    method = wish.method or run.method or _DEFAULT_METHOD
    problems = [
        *_missing(duration, step),
        *_unsound("duration", duration),
        *_unsound("step", step),
        *_unknown(method, None if wish.method else run),
    ]
    if not _is_finite(wish.start):
        message = f"the start of a run is a finite time, not {wish.start!r}"
        problems.append(Diagnostic("NS501", message))
    if wish.every is not None and not (isinstance(wish.every, Integral) and wish.every >= 1):
        message = f"rows are stored every 1 or more whole steps, not every {wish.every}"
        problems.append(Diagnostic("NS501", message))
    tolerance = _USUAL_TOLERANCE if wish.tolerance is None else wish.tolerance
    if not (_is_finite(tolerance) and 1e-15 < tolerance < 1):
        message = f"a tolerance lies between 1e-15 and 1, {tolerance!r} does not"
        problems.append(Diagnostic("NS501", message))
    if problems or duration is None or step is None:
        raise ModelError(problems)
    steps = round(duration / step)
    every, remarks = _every(wish, run, step)
    settings = Settings(wish.start, step, steps, every, method, tolerance)
    problems = [
        *_too_short(duration, step, steps),
        *_too_late(settings),
        *_too_large(settings, columns, limits),
    ]
    if problems:
        raise ModelError(problems)
    if abs(duration / step - steps) > 1e-9 * steps and duration != run.duration:
        message = f"the duration is {duration / step:.6g} steps long; the run takes {steps:,}"
        remarks.append(Diagnostic("NS404", message, severity="note"))
    return settings, remarks


def methods() -> tuple[str, ...]:
    """Return the names of the methods that a run can be made with."""
    return (*REGISTRY, *SPLITTINGS, *PAIRS, *SOLVERS)


def _missing(duration: float | None, step: float | None) -> list[Diagnostic]:
    flags = (("--for SECONDS", duration), ("--step SECONDS", step))
    lacking = [flag for flag, value in flags if value is None]
    if not lacking:
        return []
    what = "how long a run takes" if duration is None else "how large a step is"
    if duration is None and step is None:
        what = "how long a run and its steps are"
    return [
        Diagnostic(
            "NS503",
            f"nothing says {what}",
            help=f"give {' and '.join(lacking)}, or write `simulate 1 {{s}} step 1e-3 {{s}}` "
            "into the model",
        )
    ]


def _is_finite(value: object) -> bool:
    return isinstance(value, Real) and math.isfinite(value)


def _unsound(what: str, value: float | None) -> list[Diagnostic]:
    if value is None or (_is_finite(value) and value > 0):
        return []
    message = f"the {what} of a run must be a finite number greater than 0, not {value!r}"
    return [Diagnostic("NS501", message)]


def _unknown(method: str, run: Run | None) -> list[Diagnostic]:
    library = SOLVERS.get(method)
    if library is not None and find_spec(library) is None:
        way_out = f"`pip install {library}`"
        return [Diagnostic("NS501", f"`{method}` needs `{library}`", help=way_out)]
    return [] if method in methods() else [_no_method(method, run)]


def _no_method(method: str, run: Run | None) -> Diagnostic:
    return Diagnostic(
        "NS501",
        f"there is no method `{method}`",
        () if run is None else (Label(run.span),),
        notes=("the methods are " + quoted(methods()),),
        help=suggest(method, methods()),
    )


def check_method(run: Run) -> None:
    """Refuse a model whose method there is not, installed or not.

    Raises
    ------
    ModelError
        NS501.
    """
    if run.method is not None and run.method not in methods():
        raise ModelError([_no_method(run.method, run)])


def _every(wish: Wish, run: Run, step: float) -> tuple[int, list[Diagnostic]]:
    if wish.every is not None:
        return wish.every, []
    if run.every is None:
        return 1, []
    steps = run.every / step
    every = max(1, round(steps))
    if abs(steps - every) <= 1e-9 * every:
        return every, []
    message = f"rows lie {steps:.6g} steps apart in the model; the run stores one every {every}"
    return every, [Diagnostic("NS404", message, (Label(run.span),), severity="note")]


def _too_short(duration: float, step: float, steps: int) -> list[Diagnostic]:
    if steps:
        return []
    message = f"a run of {duration:g} s is shorter than half a step of {step:g} s"
    return [Diagnostic("NS501", message)]


def _too_late(settings: Settings) -> list[Diagnostic]:
    far = max(abs(settings.start), abs(settings.start + settings.duration))
    if settings.step >= _RESOLVED * math.ulp(far):
        return []
    message = f"steps of {settings.step:g} s cannot be told apart at {far:g} s"
    why = f"times there are {math.ulp(far):.2g} s apart in double precision"
    help = "start nearer to zero, or take longer steps"
    return [Diagnostic("NS501", message, notes=(why,), help=help)]


def _too_large(settings: Settings, columns: int, limits: Limits) -> list[Diagnostic]:
    problems = []
    size = 8.0 * settings.rows * columns
    if settings.steps > limits.steps:
        took = _span(settings.steps * _SECONDS_A_STEP)
        problems.append(
            Diagnostic(
                "NS502",
                f"{settings.steps:.3g} steps are more than a run takes ({limits.steps:.0e})",
                notes=(f"at 0.1 us a step they would take {took} and store {_bytes(size)}",),
                help=either(
                    "choose a shorter duration, a larger step",
                    limits.raised("steps", settings.steps),
                ),
            )
        )
    if size > limits.memory:
        every = settings.every * math.ceil(size / limits.memory)
        problems.append(
            Diagnostic(
                "NS502",
                f"{settings.rows:.3g} rows of {columns} numbers are {_bytes(size)}",
                notes=(f"a run stores up to {_bytes(limits.memory)}",),
                help=either(
                    f"store fewer rows: `--every {every}`",
                    limits.raised("memory", math.ceil(size)),
                ),
            )
        )
    return problems


def _span(seconds: float) -> str:
    for unit, length in (("years", 31_557_600.0), ("days", 86_400.0), ("hours", 3600.0)):
        if seconds >= length:
            return f"{seconds / length:.2g} {unit}"
    return f"{seconds:.2g} s"


def _bytes(count: float) -> str:
    for unit in ("B", "kB", "MB", "GB", "TB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} PB"
