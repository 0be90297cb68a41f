"""What the text of a unit means; pint is the oracle for the table of SI."""

from __future__ import annotations

import sys
from fractions import Fraction
from itertools import product

import pint
import pytest

from nsode.diagnostics import ModelError
from nsode.dimension import BASE, ONE, Dimension, dimension, power
from nsode.expr import Number, divide
from nsode.inclusion.units import in_si
from nsode.inclusion.units.reading import _DERIVED, _PREFIXES, measure
from nsode.source import Span
from nsode.syntax.ast import Unit

REGISTRY = pint.UnitRegistry()
QUANTITIES = ("mass", "length", "time", "current", "temperature", "substance", "luminosity")
PINT_BASE = {symbol: f"[{name}]" for symbol, name in zip(BASE, QUANTITIES, strict=True)}
PLAIN = [*BASE, *_DERIVED, "g"]
PREFIXED = [a + b for a, b in product(_PREFIXES, PLAIN) if b != "kg"]
#: pint reads it as a thousandth of a day, in hundredths.
MILLICANDELA = "mcd"


def of_pint(text: str) -> tuple[float, Dimension]:
    """Return scale and dimension of a unit as pint knows it."""
    quantity = REGISTRY.Quantity(1.0, text.replace("^", "**")).to_base_units()
    exponents = tuple(
        Fraction(quantity.dimensionality.get(PINT_BASE[symbol], 0)).limit_denominator(100)
        for symbol in BASE
    )
    return quantity.magnitude, dimension(exponents)


def refused(text: str) -> tuple[str, str, str | None]:
    with pytest.raises(ModelError) as caught:
        measure(Unit(text, span=Span(3, 9)))
    [diagnostic] = caught.value.diagnostics
    assert diagnostic.labels[0].span == Span(3, 9)
    return diagnostic.code, diagnostic.message, diagnostic.help


@pytest.mark.parametrize(
    "text",
    [
        *PLAIN,
        *(word for word in PREFIXED if word not in (*PLAIN, MILLICANDELA)),
        *("deg", "rpm", "ft", "inch", "min", "hour", "lbf", "km/hour", "delta_degC", "percent"),
        *("kg*m/s^2", "N*s/m", "N/m^3", "1/s", "J/(kg*K)", "m^(1/2)", "m^0.5", "mm^2", "s^-1"),
        *("N/m/s", "(m/s)^2", "rad/s", "1", "m/(s*(kg/m))"),
    ],
)
def test_a_unit_is_what_pint_says_it_is(text: str) -> None:
    scale, of = of_pint(text)
    found = measure(Unit(text))
    assert found.dimension is of
    assert float(found.scale) == pytest.approx(scale, rel=1e-14, abs=0)


def test_a_millicandela_is_no_time() -> None:
    assert measure(Unit(MILLICANDELA)) == (Fraction(1, 1000), measure(Unit("cd")).dimension)


def test_units_of_si_do_not_load_pint(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pint", None)
    for text in ("N/m", "mm", "kg*m^2/ms", "deg", "1", "MPa"):
        measure(Unit(text))


def test_without_pint_other_units_say_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pint", None)
    code, message, help = refused("furlong/s")
    assert (code, message) == (
        "NS114",
        "`furlong` is no SI unit, and pint, which knows others, is not installed",
    )
    assert help == "install it with `pip install pint`, or write the value in SI"


@pytest.mark.parametrize(
    ("text", "message", "help"),
    [
        ("degC", "`degC` has a zero of its own, so it cannot be multiplied", "{delta_degC}"),
        ("degF/s", "`degF` has a zero of its own, so it cannot be multiplied", "{K}"),
        ("dB", "`dB` is a logarithmic scale, no unit", "the ratio itself"),
        ("pixel", "`pixel` has no measure in SI", "{1}"),
        ("Nm", "`Nm` is no unit", "did you mean `N*m`?"),
        ("rads", "`rads` is no unit", "did you mean `rad/s`?"),
        ("Ns/m", "unknown unit `Ns`", "did you mean `N*s`?"),
        ("m2", "unknown unit `m2`", "did you mean `m^2`?"),
        ("kgm2", "unknown unit `kgm2`", "did you mean `kg*m^2`?"),
        ("ohms_", "unknown unit `ohms_`", "did you mean `ohm`?"),
        ("blorps", "unknown unit `blorps`", "{N/m}"),
        ("__class__", "unknown unit `__class__`", "{N/m}"),
    ],
)
def test_an_unknown_unit_is_refused_with_a_way_out(text: str, message: str, help: str) -> None:
    code, said, way_out = refused(text)
    assert (code, said) == ("NS114", message)
    assert way_out is not None
    assert help in way_out


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("N m", "`m` follows without an operator"),
        ("m^", "this unit ends too early"),
        ("(N/m", "this unit ends too early"),
        ("m)", "`)` is out of place in a unit"),
        ("m**2", "`*` is out of place in a unit"),
        ("/s", "`/` is out of place in a unit"),
        ("m/0", "`0` is out of place in a unit"),
        ("m^(1/0)", "`0` is out of place in a unit"),
        ("m^s", "`s` is out of place in a unit"),
        ("m^1000", "this unit is too large or too small"),
        ("Gm^50", "this unit is too large or too small"),
        ("Gm^30*Gm^30", "this unit is too large or too small"),
        ("m*" * 100 + "m", "a unit of more than 200 characters"),
    ],
)
def test_a_malformed_unit_is_refused(text: str, message: str) -> None:
    assert refused(text)[:2] == ("NS008", message)


@pytest.mark.parametrize("text", ["(" * 190 + "m", "m^64^64^64", "Gm^(63/64)^64^64"])
def test_no_unit_is_too_much_to_read(text: str) -> None:
    assert refused(text)[0] == "NS008"


@pytest.mark.parametrize(
    ("written", "unit", "in_si_units"),
    [
        (0.3, "mm", 3e-4),
        (5.7, "um", 5.7e-6),
        (2.1, "kN", 2100.0),
        (12.7, "inch", 0.32258),
        (180.0, "deg", 3.141592653589793),
        (20.0, "ms", 0.02),
        (-7.0, "g", -0.007),
        (1.5, "min", 90.0),
        (0.1, "N", 0.1),
    ],
)
def test_numbers_are_converted_as_decimals(written: float, unit: str, in_si_units: float) -> None:
    assert in_si(Number(written), Unit(unit)) == Number(in_si_units)


def test_a_value_of_numbers_is_converted_as_a_whole() -> None:
    assert in_si(divide(Number(1.0), Number(4.0)), Unit("mm")) == Number(2.5e-4)


def test_a_value_that_leaves_the_doubles_is_refused() -> None:
    with pytest.raises(ModelError, match="too large for a double"):
        in_si(Number(1e300), Unit("Gm"))


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("kg*m/s^2", "N"),
        ("kg/s^2", "N/m"),
        ("m/s^2", "m/s^2"),
        ("J", "N*m"),
        ("kg/s", "kg/s"),
        ("W/A", "V"),
        ("ohm", "V/A"),
        ("kg^2", "kg^2"),
        ("1/s", "1/s"),
        ("m/(s*K)", "m/(s*K)"),
        ("m^(1/2)", "m^(1/2)"),
        ("rad", "1"),
    ],
)
def test_a_dimension_is_shown_in_the_shortest_words(text: str, shown: str) -> None:
    assert str(measure(Unit(text)).dimension) == shown
    assert measure(Unit(shown)).dimension is measure(Unit(text)).dimension


def test_a_huge_power_is_shown_without_its_digits() -> None:
    metre = measure(Unit("m")).dimension
    assert str(power(metre, Fraction(64**3))) == "a huge power"


def test_a_dimension_is_one_object() -> None:
    assert measure(Unit("m/m")).dimension is ONE
