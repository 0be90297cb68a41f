"""Numbers that a double holds and a float does not."""

from __future__ import annotations

from collections.abc import Iterator
from ctypes import c_float
from math import isfinite

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import Number, walk
from nsode.ode import AugmentedODE, element_names
from nsode.passes.expressions import all_expressions
from nsode.source import Span


def check_single(ode: AugmentedODE) -> None:
    """Refuse a model with numbers that would be infinite or zero as a float.

    Raises
    ------
    ModelError
        NS116 with every such number.
    """
    problems = [_unfit(*number) for number in _numbers(ode) if not _fits(number[1])]
    if problems:
        raise ModelError(dict.fromkeys(problems), ode.source)


def _numbers(ode: AugmentedODE) -> Iterator[tuple[str, float, Span]]:
    """Yield every number with its name, if it has one, and its place."""
    for parameter in ode.parameters:
        names = element_names([parameter])
        for name, value in zip(names, parameter.values, strict=True):
            yield f"`{name}` = ", value, parameter.span
    for item in ode.inputs:
        if item.default is not None:
            yield f"`{item.name}` = ", item.default, item.span
    for expr in all_expressions(ode):
        yield from (("", n.value, n.span) for n in walk(expr) if isinstance(n, Number))


def _fits(value: float) -> bool:
    single = c_float(value).value
    return not isfinite(value) or (isfinite(single) and (single != 0) == (value != 0))


def _unfit(name: str, value: float, place: Span) -> Diagnostic:
    what = "infinite" if abs(value) > 1 else "0"
    return Diagnostic(
        "NS116",
        f"{name}{value:g} does not fit into a float",
        (Label(place, f"{what} as a float"),),
        notes=("a float holds magnitudes from 1e-45 to 3.4e38",),
        help="choose other units, or write the C with `--real double`",
    )
