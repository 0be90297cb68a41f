"""What is wrong with single characters, names and brackets."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence

from nsode.diagnostics import Diagnostic, Label
from nsode.limits import Limits, either
from nsode.source import Source, Span
from nsode.syntax.tokens import Token

# characters

LOOKALIKES = {
    "\N{MINUS SIGN}": "-",
    "\N{EN DASH}": "-",
    "\N{EM DASH}": "-",
    "\N{MULTIPLICATION SIGN}": "*",
    "\N{MIDDLE DOT}": "*",
    "\N{DOT OPERATOR}": "*",
    "\N{DIVISION SIGN}": "/",
    "\N{DIVISION SLASH}": "/",
    "\N{LESS-THAN OR EQUAL TO}": "<=",
    "\N{GREATER-THAN OR EQUAL TO}": ">=",
    "\N{NOT EQUAL TO}": "!=",
    "\N{SUPERSCRIPT TWO}": "^2",
    "\N{SUPERSCRIPT THREE}": "^3",
    "\N{DEGREE SIGN}": "deg",
}
_QUOTES = "\u2018\u2019\u201c\u201d"
#: Cyrillic letters that look like Latin ones.
_TWINS = dict(
    zip(
        "\u0430\u0435\u043e\u0440\u0441\u0445\u0443\u0456\u0458\u0455"
        "\u0410\u0412\u0415\u041a\u041c\u041d\u041e\u0420\u0421\u0422\u0425",
        "aeopcxyijsABEKMHOPCTX",
        strict=True,
    )
)
_GREEK = re.compile(r"GREEK (SMALL|CAPITAL) LETTER (?:FINAL )?([A-Z]+)$")
_STRAY = {
    "&": "write `and`",
    "&&": "write `and`",
    "|": "a magnitude is written `abs(a)`, a choice `or`",
    "||": "write `or`",
    "!": "write `not`",
    ";": "a new line ends a statement",
    "?": "a choice is written `if c then a else b`",
    '"': "the language has no strings",
    "}": "a unit stands in braces, as in `{N/m}`",
    "%": "the remainder is `mod(a, b)`; a comment begins with `#`",
    "\\": "inside ( and [ a statement goes on in the next line by itself",
}


def foreign(piece: Token, before: Sequence[Token]) -> Diagnostic:
    """Return the error for characters that begin no token."""
    character = piece.text[0]
    if character == "{":
        return _unclosed_unit(piece)
    if character.isascii() and character.isprintable():
        help_ = _STRAY.get(piece.text)
        if character == "'" and before and before[-1].end == piece.start:
            help_ = f"a derivative is written `der({before[-1].text})`"
        label = Label(piece.span, "this has no place in the language")
        return Diagnostic("NS001", f"unexpected `{piece.text}`", (label,), help=help_)
    span = Span(piece.start, piece.start + 1)
    name = unicodedata.name(character, "control character")
    code = f"U+{ord(character):04X}"
    category = unicodedata.category(character)
    if not character.isprintable() or category in ("Mn", "Zs"):
        message = f"{code} {name} cannot be seen and is not part of the language"
        help_ = "write an ordinary space" if category == "Zs" else "delete it"
        return Diagnostic("NS002", message, (Label(span),), help=help_)
    message = f"`{character}` ({code} {name}) is not part of the language"
    return Diagnostic("NS002", message, (Label(span),), help=_in_ascii(character, name))


_HIDDEN = re.compile(r"[\u202a-\u202e\u2066-\u2069]|\r(?!\n)")


def hidden(source: Source) -> Diagnostic | None:
    """Return the error for characters that show a text otherwise than it is read."""
    match = _HIDDEN.search(source.text)
    if match is None:
        return None
    span = Span(*match.span())
    if match[0] == "\r":
        message = "this line ends with a carriage return alone"
        way_out = "save the file with line ends of Unix (LF) or of Windows (CR LF)"
        return Diagnostic("NS002", message, (Label(span),), help=way_out)
    code, name = f"U+{ord(match[0]):04X}", unicodedata.name(match[0])
    message = f"{code} {name} makes text look other than it is read, also in a comment"
    return Diagnostic("NS002", message, (Label(span),), help="delete it")


def _in_ascii(character: str, name: str) -> str:
    if character in LOOKALIKES:
        return f"write `{LOOKALIKES[character]}`"
    if greek := _GREEK.match(unicodedata.name(unicodedata.normalize("NFKC", character)[0], name)):
        word = greek[2].lower()
        return f"names are ASCII: write `{word if greek[1] == 'SMALL' else word.capitalize()}`"
    if character in _QUOTES:
        return "the language has no strings"
    plain = _TWINS.get(character) or unicodedata.normalize("NFKC", character)
    if plain.isascii():
        return f"it only looks like `{plain}`; write the ASCII character"
    if (base := unicodedata.normalize("NFD", character)[0]).isascii():
        return f"names are ASCII: write `{base}`"
    return "names and operators are ASCII; any text may stand in a comment, behind `#`"


def string(piece: Token) -> Diagnostic:
    """Return the error for a quoted text."""
    label = Label(piece.span, "the language has no strings")
    return Diagnostic("NS001", f"unexpected {short(piece.text)}", (label,))


def _unclosed_unit(piece: Token) -> Diagnostic:
    return Diagnostic(
        "NS004",
        "`{` is never closed",
        (Label(piece.span, "the line ends before its `}`"),),
        help="a unit stands in braces on one line, as in `{N/m}`",
    )


def short(text: str) -> str:
    """Return a text in back-ticks, its tail left out where it is long."""
    return f"`{text}`" if len(text) <= 24 else f"`{text[:20]}…`"


# names


def leading_underscore(piece: Token, limit: int) -> Diagnostic:
    """Return the error for a name that begins with an underscore."""
    name = piece.text.strip("_")
    usable = name[:1].isalpha() and len(name) <= limit
    return Diagnostic(
        "NS006",
        "a name begins with a letter, not with `_`",
        (Label(piece.span),),
        help=f"write `{name}`" if usable else None,
    )


def name_too_long(name: Token, limits: Limits) -> Diagnostic | None:
    """Return the error for a name beyond the limit; None for any other name."""
    length = len(name.text)
    if length <= limits.name:
        return None
    return Diagnostic(
        "NS010",
        f"the name {short(name.text)} has {length:,} characters",
        (Label(name.span, f"at most {limits.name} are allowed"),),
        help=either("shorten it", limits.raised("name", length)),
    )


# brackets and depth

_PARTNER = {"(": ")", "[": "]", ")": "(", "]": "["}


def nothing_to_close(bracket: Token) -> Diagnostic:
    """Return the error for a closing bracket without its opening one."""
    label = Label(bracket.span, f"no `{_PARTNER[bracket.text]}` is open here")
    return Diagnostic("NS004", f"`{bracket.text}` closes nothing", (label,))


def mismatched(opening: Token, closing: Token) -> Diagnostic:
    """Return the error for ``(`` closed by ``]`` or the other way round."""
    labels = (
        Label(closing.span, f"`{_PARTNER[opening.text]}` is wanted here"),
        Label(opening.span, "for this bracket"),
    )
    return Diagnostic("NS004", f"`{opening.text}` is closed by `{closing.text}`", labels)


def unclosed(opening: Token, why: str) -> Diagnostic:
    """Return the error for a bracket that is open where a statement must end."""
    label = Label(opening.span, f"{why} before its `{_PARTNER[opening.text]}`")
    return Diagnostic("NS004", f"`{opening.text}` is never closed", (label,))


def too_deep(place: Span, depth: int, limits: Limits, *notes: str) -> Diagnostic:
    """Return the error for brackets, signs or a tree of that depth."""
    return Diagnostic(
        "NS011",
        f"nested {depth:,} levels deep, and {limits.depth} are the limit",
        (Label(place, f"level {limits.depth + 1}"),),
        notes,
        help=either("name an intermediate result with `let`", limits.raised("depth", depth)),
    )
