"""NS115 in its forms: both units, where each comes from, and the way out."""

from __future__ import annotations

from nsode.diagnostics import Diagnostic, Label
from nsode.dimension import ONE, quotient, simple
from nsode.inclusion.units.quantity import Quantity
from nsode.source import Span


def disagreement(
    odd: Quantity, at: Span, first: Quantity, beside: Span, relation: str, *places: Label
) -> Diagnostic:
    """Return the error for two parts; ``relation`` says what they cannot be."""
    labels = (Label(at, f"this is {odd}"), Label(beside, f"this is {first}"), *places)
    return _misfit(f"{_both(first, odd)} cannot be {relation}", labels, _apart(first, odd))


def no_number(what: str, value: Quantity, at: Span, *places: Label) -> Diagnostic:
    """Return the error for something that must be dimensionless."""
    return _misfit(
        f"{what} must be dimensionless, not {value}",
        (Label(at, f"this is {value}"), *places),
        f"divide it by a quantity {value}",
    )


def no_value(what: str, value: Quantity, at: Span, declared: Quantity, unit: Span) -> Diagnostic:
    """Return the error for a value in another unit than was declared for it."""
    return _misfit(
        f"{what} is declared {declared}, but its value is {value}",
        (Label(at, f"this is {value}"), Label(unit, f"declared {declared}")),
        _apart(declared, value),
    )


def no_rate(
    state: str, value: Quantity, equation: Span, wanted: Quantity, unit: Span
) -> Diagnostic:
    """Return the error for an equation whose sides differ."""
    return _misfit(
        f"the units of this equation do not fit: `der({state})` is {wanted}, not {value}",
        (Label(equation, f"here it is {value}"), Label(unit, f"so `der({state})` is {wanted}")),
        _apart(wanted, value),
    )


def no_constant(
    what: str, value: Quantity, at: Span, wanted: Quantity, *reasons: Label
) -> Diagnostic:
    """Return the error for a setting; ``reasons`` are where its unit follows from."""
    text = wanted.text or wanted.dimension
    return _misfit(
        f"{what} is {wanted}, not {value}",
        (Label(at, f"this is {value}"), *reasons),
        f"write it in `{{{text}}}`, or correct the unit that this follows from"
        if reasons
        else f"write it in `{{{text}}}`",
    )


def unconverted(number: Span, unit: Span, declared: Quantity) -> Diagnostic:
    """Return the error for a formula in a unit beyond SI: its numbers would be read in SI."""
    return _misfit(
        f"`{declared.text}` converts a value made of numbers alone, and this one is a formula",
        (
            Label(number, f"read in `{declared.dimension}`"),
            Label(unit, f"not in `{declared.text}`"),
        ),
        f"write `{{{declared.dimension}}}`, or declare the number: "
        f"`parameter a = 1 {{{declared.text}}}`",
    )


def _both(first: Quantity, odd: Quantity) -> str:
    shown = [
        "a dimensionless value" if q.dimension is ONE else f"`{q.text or q.dimension}`"
        for q in (first, odd)
    ]
    return " and ".join(shown)


def _apart(one: Quantity, other: Quantity) -> str:
    assert one.dimension is not None
    assert other.dimension is not None
    ratio = quotient(one.dimension, other.dimension)
    if not simple(ratio):
        return "look for a wrong name, or for a wrong unit where one is declared"
    factor = min(str(ratio), str(quotient(ONE, ratio)), key=len)
    return f"they differ by a factor in `{factor}`: one is missing, or a declared unit is wrong"


def _misfit(message: str, labels: tuple[Label, ...], help: str) -> Diagnostic:
    return Diagnostic("NS115", message, labels, help=help)
