"""What is wrong with numbers and units."""

from __future__ import annotations

import re
from math import isinf
from sys import float_info

from nsode.diagnostics import Diagnostic, Label
from nsode.source import Span
from nsode.syntax.slips import LOOKALIKES, short
from nsode.syntax.tokens import Token

_MANTISSA = re.compile(r"[0-9.]*")
_NUMBER = re.compile(r"[0-9]*\.?[0-9]*(?:[eE][+-]?[0-9]+)?")


def unsound_number(number: Token) -> Diagnostic | None:
    """Return the error for a number that another language or a double would not hold."""
    text = number.text
    if len(text) > 1 and text[0] == "0" and text[1].isdigit():
        plain = text.lstrip("0")
        plain = plain if plain[:1].isdigit() else f"0{plain}"
        message = f"{short(text)} begins with a zero, which means octal in C"
        return _error(number, message, f"write {short(plain)}")
    value = float(text)
    if isinf(value):
        message = f"{short(text)} is too large for a double"
        return _error(number, message, f"the largest is about {float_info.max:.2g}")
    mantissa = _MANTISSA.match(text)
    if value == 0 and mantissa and mantissa[0].strip("0."):
        message = f"{short(text)} is zero as a double"
        least = f"the smallest is about {float_info.min:.2g}"
        return _error(number, message, f"{least}; write `0` where zero is meant")
    if 0 < value < float_info.min:
        message = f"{short(text)} is subnormal: a double holds it with fewer digits"
        return _error(number, message, f"the smallest full one is about {float_info.min:.2g}")
    return None


def malformed_number(piece: Token) -> Diagnostic:
    """Return the error for what begins like a number and goes on otherwise."""
    text = piece.text
    match = _NUMBER.match(text)
    literal = match[0] if match else ""
    rest = text[len(literal) :]
    if literal == "0" and rest[:1] in tuple("xXbBoO"):
        return _error(piece, f"{short(text)} is not decimal", "write it in decimal")
    if rest.startswith("."):
        return _error(piece, f"{short(text)} has two decimal points", None)
    if rest in ("e", "E"):
        return _error(piece, f"{short(text)} lacks its exponent", f"write {short(text + '3')}")
    if (digits := text.replace("_", "")).isdigit() and "_" in text:
        return _error(piece, f"{short(text)} holds `_`", f"write `{digits}`")
    way_out = f"a product is written {short(f'{literal}*{rest}')}; a name begins with a letter"
    return _error(piece, f"{short(text)} is neither a number nor a name", way_out)


def _error(number: Token, message: str, way_out: str | None) -> Diagnostic:
    return Diagnostic("NS003", message, (Label(number.span),), help=way_out)


_UNIT = re.compile(
    r"\s*(?:(?:[A-Za-z_][A-Za-z0-9_]*|[0-9]+(?:\.[0-9]+)?|[*/^()]|-(?=\s*[0-9]))\s*)*"
)
_EXAMPLE = "a unit is written like `{N/m}`, `{kg*m/s^2}` or `{1}`"


_IN_UNITS = {".": "*", "%": "0.01", "\N{MICRO SIGN}": "u", "\N{GREEK SMALL LETTER MU}": "u"}


def malformed_unit(unit: Token) -> Diagnostic | None:
    """Return the error for a unit in braces; None where its characters are sound."""
    inner = unit.text[1:-1]
    if not inner.strip():
        return Diagnostic("NS008", "empty unit", (Label(unit.span),), help=_EXAMPLE)
    match = _UNIT.match(inner)
    sound = match.end() if match else 0
    if sound == len(inner):
        return None
    start = unit.start + 1 + sound
    label = Label(Span(start, start + 1))
    message = f"`{inner[sound]}` has no place in a unit"
    meant = LOOKALIKES.get(inner[sound], _IN_UNITS.get(inner[sound]))
    way_out = f"write `{meant}`" if meant else _EXAMPLE
    return Diagnostic("NS008", message, (label,), help=way_out)
