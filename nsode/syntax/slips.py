"""What is wrong with single characters, numbers, names, units and brackets."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from math import isinf

from nsode.diagnostics import Diagnostic, Label
from nsode.source import Span

# characters


_LOOKALIKES = {
    "−": "-",
    "–": "-",
    "—": "-",
    "×": "*",
    "·": "*",
    "⋅": "*",
    "÷": "/",
    "∕": "/",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "≔": "=",
    "²": "^2",
    "³": "^3",
    "“": "",
    "”": "",
    "‘": "",
    "’": "",
}
_GREEK = re.compile(r"GREEK (?:SMALL|CAPITAL) LETTER (?:FINAL )?([A-Z]+)$")


def foreign(text: str, start: int, before: Sequence[str]) -> Diagnostic:
    """Return the error for a character that begins no token."""
    character = text[start]
    span = Span(start, start + 1)
    if character == "{":
        return _unclosed_unit(text, start)
    if character.isascii() and character.isprintable():
        return _stray(text, start, before)
    code = f"U+{ord(character):04X}"
    name = unicodedata.name(character, "")
    label = f"{code} {name}".rstrip()
    if not character.isprintable() or unicodedata.category(character) in ("Mn", "Cf", "Zs"):
        message = f"invisible character {label}"
        return Diagnostic("NS002", message, (Label(span, code),), help="delete it")
    message = f"`{character}` ({label}) is not part of the language"
    return Diagnostic("NS002", message, (Label(span, code),), help=_ascii_way_out(character, name))


def _ascii_way_out(character: str, name: str) -> str:
    if character in _LOOKALIKES:
        plain = _LOOKALIKES[character]
        return f"write `{plain}`" if plain else "the language has no strings; leave it out"
    if greek := _GREEK.match(name):
        word = greek[1].lower()
        return f"names are ASCII; write `{word if 'SMALL' in name else word.capitalize()}`"
    compatible = unicodedata.normalize("NFKC", character)
    if compatible.isascii():
        return f"it only looks like `{compatible}`; write the ASCII character"
    return "names and operators are ASCII; any text may stand in a comment after `#`"


_STRAY_HELP = {
    "'": "the language has no strings",
    '"': "the language has no strings",
    ";": "a new line ends a statement",
    "&": "write `and`",
    "|": "write `or`",
    "!": "write `not`",
    "_": "a name begins with a letter",
    "}": "a unit is written `{N/m}`",
    "%": "write `mod(a, b)`; a comment begins with `#`",
    "\\": "a line goes on by itself inside ( and [",
}


def _stray(text: str, start: int, before: Sequence[str]) -> Diagnostic:
    character = text[start]
    if character == "_":
        return _leading_underscore(text, start)
    length = 2 if character in "&|" and text[start + 1 : start + 2] == character else 1
    span = Span(start, start + length)
    return Diagnostic(
        "NS001",
        f"unexpected `{text[start : start + length]}`",
        (Label(span, "this character has no place in the language"),),
        help=_STRAY_HELP.get(character),
    )


def _unclosed_unit(text: str, start: int) -> Diagnostic:
    end = text.find("\n", start)
    end = len(text) if end < 0 else end
    return Diagnostic(
        "NS004",
        "`{` is never closed",
        (Label(Span(start, start + 1), "the line ends before its `}`"),),
        help="a unit stands in braces on one line, as in `{N/m}`",
    )


# names

_WORD = re.compile(r"[A-Za-z0-9_]+")


def _leading_underscore(text: str, start: int) -> Diagnostic:
    word = _WORD.match(text, start)
    end = word.end() if word else start + 1
    name = text[start:end].strip("_")
    fine = name and name[0].isalpha() and len(name) < 64
    return Diagnostic(
        "NS006",
        "a name begins with a letter, not with `_`",
        (Label(Span(start, end)),),
        help=f"write `{name}`" if fine else None,
    )


def name_too_long(name: str, start: int, limit: int) -> Diagnostic:
    """Return the error for a name beyond the limit."""
    return Diagnostic(
        "NS010",
        f"the name `{name[:16]}…` has {len(name)} characters",
        (Label(Span(start, start + len(name)), f"at most {limit} are allowed"),),
    )


# numbers

_REST = re.compile(r"[A-Za-z0-9_]|\.(?!\.)")
_ALL = re.compile(r"[A-Za-z0-9_.]+")


def malformed_number(text: str, span: Span) -> Diagnostic | None:
    """Return the error for the number at ``span``; None where it is sound."""
    literal = text[span.start : span.end]
    if _REST.match(text, span.end):
        return _number_runs_on(text, span)
    if len(literal) > 1 and literal[0] == "0" and literal[1].isdigit():
        plain = literal.lstrip("0")
        plain = plain if plain and plain[0].isdigit() else "0" + plain
        return _number(
            f"`{_short(literal)}` begins with a zero, which means octal in C",
            span,
            f"write `{_short(plain)}`",
        )
    value = float(literal)
    if isinf(value):
        return _number(
            f"`{_short(literal)}` is too large for a double",
            span,
            "the largest is about 1.8e308",
        )
    if value == 0 and re.search(r"[1-9]", re.split("[eE]", literal)[0]):
        return _number(
            f"`{_short(literal)}` is zero as a double",
            span,
            "the smallest is about 2.2e-308; write `0` where zero is meant",
        )
    if 0 < value < 2.2250738585072014e-308:
        return _number(
            f"`{_short(literal)}` is subnormal: a double holds it with fewer digits",
            span,
            "the smallest full double is about 2.2e-308",
        )
    return None


def _number_runs_on(text: str, span: Span) -> Diagnostic:
    whole = _ALL.match(text, span.start)
    end = whole.end() if whole else span.end
    literal, rest = text[span.start : span.end], text[span.end : end]
    span = Span(span.start, end)
    if literal == "0" and rest[0] in "xXbBoO":
        return _number(f"`{_short(literal + rest)}` is not decimal", span, "write it in decimal")
    if rest[0] == "." or rest[0].isdigit():
        return _number(f"`{_short(literal + rest)}` has two decimal points", span, None)
    if rest in ("e", "E"):
        return _number(f"`{literal}{rest}` lacks its exponent", span, f"write `{literal}e3`")
    return _number(
        f"`{_short(literal + rest)}` is neither a number nor a name",
        span,
        f"write `{_short(literal)}*{_short(rest)}` for a product; a name begins with a letter",
    )


def _number(message: str, span: Span, help_: str | None) -> Diagnostic:
    return Diagnostic("NS003", message, (Label(span),), help=help_)


def _short(text: str) -> str:
    return text if len(text) <= 24 else f"{text[:20]}…"


# units

_UNIT = re.compile(
    r"\s*(?:(?:[A-Za-z_][A-Za-z0-9_]*|[0-9]+(?:\.[0-9]+)?|[*/^()]|-(?=\s*[0-9]))\s*)*"
)


def malformed_unit(text: str, start: int) -> Diagnostic | None:
    """Return the error for a unit in braces; None where its characters are sound."""
    inner = text[1:-1]
    match = _UNIT.match(inner)
    sound = match.end() if match else 0
    example = "a unit is written like `{N/m}`, `{kg*m/s^2}` or `{1}`"
    if not inner.strip():
        span = Span(start, start + len(text))
        return Diagnostic("NS008", "empty unit", (Label(span),), help=example)
    if sound == len(inner):
        return None
    place = start + 1 + sound
    return Diagnostic(
        "NS008",
        f"`{inner[sound]}` has no place in a unit",
        (Label(Span(place, place + 1)),),
        help=example,
    )


# brackets and depth

_PARTNER = {"(": ")", "[": "]", ")": "(", "]": "["}


def nothing_to_close(bracket: str, span: Span) -> Diagnostic:
    """Return the error for a closing bracket without its opening one."""
    message = f"`{bracket}` closes nothing"
    return Diagnostic("NS004", message, (Label(span, f"no `{_PARTNER[bracket]}` is open here"),))


def mismatched(opening: str, closing: str, span: Span) -> Diagnostic:
    """Return the error for ``(`` closed by ``]`` or the other way round."""
    start = opening.start_pos  # type: ignore[attr-defined]
    labels = (
        Label(span, f"`{_PARTNER[opening]}` is wanted here"),
        Label(Span(start, start + 1), "for this bracket"),
    )
    return Diagnostic("NS004", f"`{opening}` is closed by `{closing}`", labels)


def unclosed(opening: str, why: str) -> Diagnostic:
    """Return the error for a bracket that is open where a statement must end."""
    start = opening.start_pos  # type: ignore[attr-defined]
    return Diagnostic(
        "NS004",
        f"`{opening}` is never closed",
        (Label(Span(start, start + 1), f"{why} before its `{_PARTNER[opening]}`"),),
    )


def too_deep(span: Span, limit: int) -> Diagnostic:
    """Return the error for brackets, signs or a tree beyond the limit."""
    return Diagnostic(
        "NS011",
        f"nested deeper than {limit} levels",
        (Label(span),),
        help="name an intermediate result with `let`",
    )
