"""Units: values made of numbers alone are converted to SI.

Units that are coherent in SI need no conversion and no library; anything else is
looked up in pint, which loads when it is first needed.
"""

from __future__ import annotations

import re
from functools import lru_cache

from nsode.diagnostics import refuse, suggest
from nsode.evaluate import evaluate
from nsode.expr import Expr, Number, multiply, names
from nsode.syntax.ast import Unit

_COHERENT = frozenset(
    [
        "m",
        "kg",
        "s",
        "A",
        "K",
        "mol",
        "cd",
        "rad",
        "sr",
        "Hz",
        "N",
        "Pa",
        "J",
        "W",
        "C",
        "V",
        "F",
        "ohm",
        "S",
        "Wb",
        "T",
        "H",
        "1",
    ]
)
_WORD = re.compile(r"[A-Za-z_]\w*|\d+(?:\.\d+)?")


def in_si(value: Expr, unit: Unit | None) -> Expr:
    """Return a value in SI: numbers are converted, anything that reads a name stays.

    Raises
    ------
    ModelError
        NS114 for an unknown unit.
    """
    if unit is None:
        return value
    scale = factor(unit)
    if scale == 1.0 or any(True for _ in names(value)):
        return value
    return Number(evaluate(multiply(value, Number(scale)), _no_names), span=value.span)


def factor(unit: Unit) -> float:
    """Return what one of a unit is in SI.

    Raises
    ------
    ModelError
        NS114 for an unknown unit, or for one with a zero of its own (degC).
    """
    text = unit.text.strip()
    exponents_aside = re.sub(r"\^\s*-?\d+", "", text)
    if all(word in _COHERENT for word in _WORD.findall(exponents_aside)):
        return 1.0
    try:
        return _looked_up(text)
    except (AttributeError, ValueError, TypeError) as error:
        raise refuse(
            "NS114",
            f"unknown unit `{text}`",
            unit.span,
            str(error).split("\n")[0][:80],
            help=suggest(text, _COHERENT) or "write SI units, for example {N/m} or {m/s^2}",
        ) from None


@lru_cache(maxsize=256)
def _looked_up(text: str) -> float:
    import pint

    registry: pint.UnitRegistry[float] = pint.UnitRegistry(autoconvert_offset_to_baseunit=False)
    try:
        quantity = registry.Quantity(1.0, text.replace("^", "**"))
        return float(quantity.to_base_units().magnitude)
    except pint.errors.PintError as error:
        raise ValueError(str(error)) from None


def _no_names(name: str, at: int | None) -> float:
    raise AssertionError(name)
