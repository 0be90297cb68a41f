"""Syntax errors in words that a person understands."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from nsode.diagnostics import Diagnostic, Label, suggest
from nsode.source import Span
from nsode.syntax.slips import short
from nsode.syntax.tokens import Token
from nsode.syntax.words import FUNCTION_NAMES, KEYWORDS, STATEMENT_KEYWORDS

_OPERAND = frozenset({"NUMBER", "NAME", "LPAR", "LSQB", "MINUS", "IF", "NOT", "SUM"})
_OPERATOR = frozenset(
    {"PLUS", "MINUS", "STAR", "SLASH", "CIRCUMFLEX", "INEQUALITY", "EQUALITY", "AND", "OR"}
    | {"DOT", "LSQB", "LPAR"}
)
_FOREIGN_WORDS = {
    "const": "constant",
    "def": "let",
    "param": "parameter",
    "real": "parameter",
    "var": "state",
    "variable": "state",
}


@dataclass(frozen=True, slots=True)
class Slip:
    """A statement up to the token that has no place in it.

    Attributes
    ----------
    before, bad, after
        The tokens that were understood, the one that was not (None: the statement ends),
        and the rest.
    accepted
        The terminals that could have stood in its place.
    """

    before: Sequence[Token]
    bad: Token | None
    after: Sequence[Token]
    accepted: set[str]

    @property
    def type(self) -> str:
        """Return the type of the bad token."""
        return self.bad.type if self.bad else "$END"

    @property
    def text(self) -> str:
        """Return the text of the bad token."""
        return self.bad.text if self.bad else ""

    @property
    def first(self) -> Token:
        """Return the first token of the statement."""
        return self.before[0] if self.before else self.bad  # type: ignore[return-value]

    @property
    def last(self) -> Token | None:
        """Return the token in front of the bad one."""
        return self.before[-1] if self.before else None

    @property
    def wants_operand(self) -> bool:
        """Tell whether an expression could have begun here."""
        return "NUMBER" in self.accepted

    @property
    def follows_operand(self) -> bool:
        """Tell whether an operator could have stood here."""
        return "STAR" in self.accepted


def explain(slip: Slip, texts: dict[str, str]) -> Diagnostic:
    """Return the diagnostic for a token that the grammar has no place for.

    ``texts`` has the text of each terminal that has a fixed one.
    """
    if misspelt := _misspelt_keyword(slip):
        return misspelt
    expected = _in_words(slip, texts)
    label = Label(_place(slip), f"expected {expected}" if expected else "")
    what = "unexpected end of the line" if slip.bad is None else f"unexpected {short(slip.text)}"
    way_out = next(filter(None, (hint(slip) for hint in _HINTS)), None)
    return Diagnostic("NS001", what, (label,), help=way_out)


def _place(slip: Slip) -> Span:
    if slip.bad is not None:
        return slip.bad.span
    end = slip.before[-1].end
    return Span(end, end + 1)


def _misspelt_keyword(slip: Slip) -> Diagnostic | None:
    """Recognize ``paramter M = 1``: two words, of which the first is no keyword."""
    if len(slip.before) != 1 or slip.first.type != "NAME" or slip.type != "NAME":
        return None
    word = slip.first.text
    if word in FUNCTION_NAMES:
        return None
    meant = _FOREIGN_WORDS.get(word.lower())
    way_out = f"did you mean `{meant}`?" if meant else suggest(word.lower(), STATEMENT_KEYWORDS)
    label = Label(slip.first.span, "expected a keyword or an equation")
    return Diagnostic("NS001", f"{short(word)} begins no statement", (label,), help=way_out)


def _in_words(slip: Slip, texts: dict[str, str]) -> str:
    """Return what may come next, the likeliest first."""
    if not slip.before:
        return "a statement"
    rest = set(slip.accepted)
    words = []
    if slip.wants_operand:
        words.append("an expression")
        rest -= _OPERAND
    elif "NAME" in rest:
        words.append("a name")
        rest.discard("NAME")
    if slip.follows_operand:
        rest -= _OPERATOR
    words += sorted(f"`{texts[name]}`" for name in rest if name in texts)
    if slip.follows_operand:
        words.append("an operator")
    words += [text for name, text in _DESCRIBED.items() if name in rest]
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]])) if words else ""


_DESCRIBED = {
    "INEQUALITY": "a bound",
    "EQUALITY": "a comparison",
    "UNIT": "a unit",
    "$END": "the end of the line",
}


# One hint for each slip that people make; the first that recognizes its slip speaks.


def _decimal_comma(slip: Slip) -> str | None:
    if slip.type != "COMMA" or slip.last is None or slip.last.type != "NUMBER" or not slip.after:
        return None
    digits = slip.after[0].text
    if "RSQB" in slip.accepted:
        return None
    return f"write `{slip.last.text}.{digits}`" if digits.isdigit() else None


def _comma(slip: Slip) -> str | None:
    if slip.type != "COMMA":
        return None
    if "RSQB" in slip.accepted:
        return "an element of a matrix is written `R[1][2]`"
    return "a line holds one statement, a declaration one name"


def _comparison(slip: Slip) -> str | None:
    if slip.type == "EQUAL" and "EQUALITY" in slip.accepted:
        return "a comparison is written `==`"
    if slip.type in ("EQUALITY", "INEQUALITY") and "EQUAL" in slip.accepted:
        return "a value is given, and an equation written, with `=`"
    if slip.type == "COLON" and "EQUAL" in slip.accepted:
        return "write `=`"
    if slip.type in ("EQUALITY", "INEQUALITY") and slip.follows_operand:
        return "comparisons do not chain: write `a < b and b < c`"
    return None


def _conditional(slip: Slip) -> str | None:
    if "THEN" in slip.accepted or "ELSE" in slip.accepted:
        return "a choice is written `if c then a else b`, and always has its `else`"
    if slip.type == "IF":
        return "inside an expression `if c then a else b` stands in parentheses"
    return None


def _power(slip: Slip) -> str | None:
    if slip.text == "*" and slip.last is not None and slip.last.text == "*":
        return "a power is written `^`"
    return None


def _comment(slip: Slip) -> str | None:
    slash = slip.text == "/" and (slip.last is None or slip.last.text == "/")
    star = slip.text == "*" and slip.last is not None and slip.last.text == "/"
    return "a comment begins with `#`" if slash or star else None


def _unit(slip: Slip) -> str | None:
    if slip.type == "UNIT":
        return "a unit ends a declaration or a setting; for use in a formula declare a `parameter`"
    if slip.last is not None and slip.last.type == "UNIT":
        return "a unit never stands inside an expression, only at its end"
    if slip.type == "NAME" and slip.last is not None and slip.last.type == "NUMBER":
        if "UNIT" in slip.accepted:
            return f"a unit stands in braces: `{{{slip.text}}}`; a product needs its `*`"
        return f"a product needs its `*`: `{slip.last.text}*{slip.text}`"
    return None


def _application(slip: Slip) -> str | None:
    last = slip.last
    if last is None or not slip.follows_operand:
        return None
    if last.text in FUNCTION_NAMES and slip.type in ("NAME", "NUMBER"):
        return f"write `{last.text}({slip.text})`"
    if slip.type == "NUMBER" and slip.text.startswith(".") and slip.text[1:].isdigit():
        return f"an element is written `{last.text}[{slip.text[1:]}]`"
    return None


def _loop(slip: Slip) -> str | None:
    if slip.first.type == "FOR" and (slip.bad is None or slip.text in ("=", ":", "in")):
        return "write `for i in 1..n: der(x[i]) = v[i]`, all on one line"
    if slip.first.type == "FOR" and "COLON" in slip.accepted:
        return "a `:` stands between the range and the equation"
    if slip.type == "COLON" and "_RANGE" in slip.accepted:
        return "a range is written `1..n`"
    if slip.type == "_RANGE":
        return "an element is selected by one index"
    return None


def _settings(slip: Slip) -> str | None:
    if slip.first.type == "APPROXIMATE" and "COLON" in slip.accepted:
        return "write `approximate N: K = 1e5, beta = 4e-3`"
    return None


def _product(slip: Slip) -> str | None:
    if slip.follows_operand and slip.type in ("NAME", "NUMBER", "LPAR"):
        return "a product needs its `*`, and each statement its own line"
    return None


def _keyword(slip: Slip) -> str | None:
    if slip.text in KEYWORDS and slip.wants_operand:
        return f"`{slip.text}` is a word of the language and has no value"
    if slip.text in STATEMENT_KEYWORDS:
        return "each statement begins on its own line"
    return None


def _plus(slip: Slip) -> str | None:
    return "leave out the `+`" if slip.type == "PLUS" and slip.wants_operand else None


def _continued(slip: Slip) -> str | None:
    if slip.bad is None and slip.wants_operand:
        return "a statement goes on in the next line only inside ( and ["
    return None


_HINTS: tuple[Callable[[Slip], str | None], ...] = (
    _decimal_comma,
    _comma,
    _comparison,
    _conditional,
    _power,
    _comment,
    _unit,
    _application,
    _loop,
    _settings,
    _product,
    _keyword,
    _plus,
    _continued,
)
