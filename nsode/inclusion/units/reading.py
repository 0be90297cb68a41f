"""The text of a unit: products and powers of names.

The names of SI stand in a small table, so that most models never load pint.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from nsode.diagnostics import refuse, suggest
from nsode.dimension import BASE, ONE, base, power, product
from nsode.inclusion.units.library import Measure, UnitError, UnknownUnitError, look_up
from nsode.syntax.ast import Unit

_DERIVED = {
    "rad": "1",
    "sr": "1",
    "Hz": "1/s",
    "N": "kg*m/s^2",
    "Pa": "N/m^2",
    "J": "N*m",
    "W": "J/s",
    "C": "A*s",
    "V": "W/A",
    "F": "C/V",
    "ohm": "V/A",
    "S": "A/V",
    "Wb": "V*s",
    "T": "Wb/m^2",
    "H": "Wb/A",
}
_OTHERS = {
    "g": Measure(Fraction(1, 1000), base("kg")),
    "deg": Measure(Fraction(math.pi) / 180, ONE),
}
_PREFIXES = {"n": -9, "u": -6, "m": -3, "c": -2, "d": -1, "h": 2, "k": 3, "M": 6, "G": 9}
#: What pint would read as a yarn number, a dose of radiation, and pascals.
_TRAPS = {"Nm": "N*m", "rads": "rad/s", "Pas": "Pa*s"}
_SYMBOLS = (*BASE, *_DERIVED, *_OTHERS)

_TOKEN = re.compile(r"[A-Za-z_]\w*|\d+(?:\.\d+)?|\S")
_LONGEST = 200  # characters in a unit
_LARGEST = 64  # exponent
_BITS = 1000  # of a scale, which stays inside the range of a double
_EXAMPLE = "a unit is written like `{N/m}`, `{kg*m/s^2}` or `{1}`"
_END = ""


class MalformedError(UnitError):
    """A text that is no product of powers."""


def measure(unit: Unit) -> Measure:
    """Return what one of a unit is in SI.

    Raises
    ------
    ModelError
        NS008 for a malformed unit; NS114 for an unknown one, and for one that is no
        multiple of an SI unit.
    """
    try:
        return _measured(unit.text)
    except MalformedError as error:
        raise refuse("NS008", error.message, unit.span, help=error.help or _EXAMPLE) from None
    except UnitError as error:
        raise refuse("NS114", error.message, unit.span, help=error.help) from None


@cache
def _measured(text: str) -> Measure:
    if len(text) > _LONGEST:
        raise MalformedError(f"a unit of more than {_LONGEST} characters")
    return _Reader([*_TOKEN.findall(text), _END]).whole()


@dataclass(slots=True)
class _Reader:
    """Reads the tokens of one unit from left to right."""

    tokens: list[str]
    at: int = 0

    def whole(self) -> Measure:
        found = self._product()
        token = self._take()
        if token == _END:
            return found
        if token[0].isalnum():
            raise MalformedError(f"`{token}` follows without an operator", "write `N*m`, not `N m`")
        raise _unexpected(token)

    def _take(self) -> str:
        token = self.tokens[self.at]
        self.at = min(self.at + 1, len(self.tokens) - 1)
        return token

    def _taken(self, *wanted: str) -> str | None:
        return self._take() if self.tokens[self.at] in wanted else None

    def _product(self) -> Measure:
        found = self._power()
        while operator := self._taken("*", "/"):
            factor = self._power()
            found = _times(found, factor if operator == "*" else _to(factor, Fraction(-1)))
        return found

    def _power(self) -> Measure:
        found = self._factor()
        return _to(found, self._exponent()) if self._taken("^") else found

    def _factor(self) -> Measure:
        token = self._take()
        if token == "(":
            found = self._product()
            self._close()
            return found
        if token[:1].isdigit() and Fraction(token):
            return Measure(Fraction(token), ONE)
        if token[:1].isalpha() or token[:1] == "_":
            return _named(token)
        raise _unexpected(token)

    def _exponent(self) -> Fraction:
        if not self._taken("("):
            return self._signed()
        found = self._signed()
        if self._taken("/"):
            under = self._signed()
            if not under:
                raise _unexpected("0")
            found /= under
        self._close()
        return found

    def _signed(self) -> Fraction:
        minus = self._taken("-")
        token = self._take()
        if not token[:1].isdigit():
            raise _unexpected(token)
        return -Fraction(token) if minus else Fraction(token)

    def _close(self) -> None:
        token = self._take()
        if token != ")":
            raise _unexpected(token)


def _unexpected(token: str) -> MalformedError:
    if token == _END:
        return MalformedError("this unit ends too early")
    return MalformedError(f"`{token}` is out of place in a unit")


def _times(left: Measure, right: Measure) -> Measure:
    scale = left.scale * right.scale
    if max(scale.numerator.bit_length(), scale.denominator.bit_length()) > _BITS:
        raise MalformedError("this unit is too large or too small")
    return Measure(scale, product(left.dimension, right.dimension))


def _to(of: Measure, exponent: Fraction) -> Measure:
    bits = max(of.scale.numerator.bit_length(), of.scale.denominator.bit_length())
    if abs(exponent) > _LARGEST or (of.scale != 1 and bits * abs(exponent) > _BITS):
        raise MalformedError("this unit is too large or too small")
    if exponent.denominator == 1 or of.scale == 1:
        scale = of.scale ** int(exponent) if of.scale != 1 else of.scale
    else:
        scale = Fraction(float(of.scale) ** float(exponent))
    return Measure(scale, power(of.dimension, exponent))


@cache
def _named(word: str) -> Measure:
    if word in BASE:
        return Measure(Fraction(1), base(word))
    if word in _DERIVED:
        return _measured(_DERIVED[word])
    if word in _OTHERS:
        return _OTHERS[word]
    if word[0] in _PREFIXES and word[1:] in _SYMBOLS and word[1:] not in {"kg", "deg"}:
        tenfold = Measure(Fraction(10) ** _PREFIXES[word[0]], ONE)
        return _times(tenfold, _named(word[1:]))
    if word in _TRAPS:
        raise UnknownUnitError(f"`{word}` is no unit", f"did you mean `{_TRAPS[word]}`?")
    try:
        return look_up(word)
    except UnknownUnitError as error:
        raise UnknownUnitError(error.message, _meant(word) or error.help) from None


def _meant(word: str) -> str | None:
    """Return what a person may have meant by an unknown word, such as ``kgm2``."""
    letters, digit = word.rstrip("0123456789"), word[-1:] if word[-1:].isdigit() else ""
    for k in range(1, len(letters) + 1):
        parts = [part for part in (letters[:k], letters[k:]) if part]
        if all(part in _SYMBOLS for part in parts) and letters + digit == word:
            return f"did you mean `{'*'.join(parts)}{'^' + digit if digit else ''}`?"
    return suggest(word, _SYMBOLS)
