"""Units beyond SI, looked up in pint; it loads when a model first names one."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from nsode.dimension import ONE, Dimension, base, product

if TYPE_CHECKING:
    import pint

_BASE_OF = {
    "[mass]": "kg",
    "[length]": "m",
    "[time]": "s",
    "[current]": "A",
    "[temperature]": "K",
    "[substance]": "mol",
    "[luminosity]": "cd",
}


class Measure(NamedTuple):
    """What one of a unit is in SI: a number and a dimension."""

    scale: Fraction
    dimension: Dimension


class UnitError(Exception):
    """A unit that cannot be used: what is wrong with it, and the way out."""

    def __init__(self, message: str, help: str | None = None) -> None:
        self.message = message
        self.help = help
        super().__init__(message)


class UnknownUnitError(UnitError):
    """A name that nobody knows."""


def look_up(word: str) -> Measure:
    """Return what pint knows of a unit.

    Raises
    ------
    UnitError
        For a unit that pint does not know, one with a zero of its own (degC) or on a
        logarithmic scale (dB), and one outside SI (pixel).
    """
    try:
        import pint
    except ImportError:
        raise UnitError(
            f"`{word}` is no SI unit, and pint, which knows others, is not installed",
            "install it with `pip install pint`, or write the value in SI",
        ) from None
    registry = _registry()
    try:
        zero = registry.Quantity(0.0, word).to_base_units()
        one = registry.Quantity(1.0, word).to_base_units()
    except (pint.errors.PintError, ValueError):
        raise UnknownUnitError(
            f"unknown unit `{word}`", "write SI units, for example `{N/m}` or `{m/s^2}`"
        ) from None
    if zero.magnitude != 0:
        raise _no_factor(word, one.dimensionality)
    found = ONE
    for name, exponent in one.dimensionality.items():
        if name not in _BASE_OF:
            raise UnitError(f"`{word}` has no measure in SI", "leave it out, or write `{1}`")
        found = product(found, base(_BASE_OF[name], Fraction(str(exponent))))
    exact = f"{one.magnitude:.15g}"  # pint multiplies floats: what lies beyond is noise
    return Measure(Fraction(exact), found)


@cache
def _registry() -> pint.UnitRegistry[float]:
    import pint

    return pint.UnitRegistry()


def _no_factor(word: str, dimensionality: object) -> UnitError:
    if dimensionality == {"[temperature]": 1}:
        return UnitError(
            f"`{word}` has a zero of its own, so it cannot be multiplied",
            f"write temperatures in `{{K}}`, and differences in `{{delta_{word}}}`",
        )
    return UnitError(f"`{word}` is a logarithmic scale, no unit", "write the ratio itself")
