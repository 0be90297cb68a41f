"""Syntax errors in words that a person understands."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token
from lark.exceptions import UnexpectedToken

from nsode.diagnostics import Diagnostic, Label, suggest
from nsode.source import Span
from nsode.syntax.words import KEYWORDS, STATEMENT_KEYWORDS


def explain(error: UnexpectedToken, tokens: Sequence[Token], symbols: dict[str, str]) -> Diagnostic:
    """Return the diagnostic for a token that the grammar has no place for.

    Parameters
    ----------
    error
        What the parser raised.
    tokens
        The statement.
    symbols
        The text of each terminal that has a fixed one.
    """
    accepted = error.interactive_parser.accepts()  # type: ignore[union-attr]
    at_end = error.token.type == "$END"
    index = len(tokens) if at_end else _index(tokens, error.token)
    expected = _in_words(accepted, symbols)
    end = tokens[-1].end_pos
    span = Span(end, end + 1) if at_end else _span(error.token)
    what = "the statement ends too early" if at_end else f"unexpected {_quoted(error.token)}"
    return Diagnostic(
        "NS001",
        what,
        (Label(span, f"expected {expected}" if expected else ""),),
        help=_way_out(tokens, index, accepted),
    )


def _index(tokens: Sequence[Token], token: Token) -> int:
    return next(i for i, t in enumerate(tokens) if t is token)


def _span(token: Token) -> Span:
    return Span(token.start_pos, token.end_pos)  # type: ignore[arg-type]


def _quoted(text: str) -> str:
    return f"`{text}`" if len(text) <= 24 else f"`{text[:20]}…`"


_OPERATORS = {
    "PLUS",
    "MINUS",
    "STAR",
    "SLASH",
    "CIRCUMFLEX",
    "INEQUALITY",
    "EQUALITY",
    "AND",
    "OR",
    "DOT",
    "LSQB",
    "LPAR",
}
_OPERAND = {"NUMBER", "NAME", "LPAR", "LSQB", "MINUS", "IF", "NOT", "SUM"}
_STATEMENT = {"MODEL", "PARAMETER", "LET", "STATE"}


def _in_words(accepted: set[str], symbols: dict[str, str]) -> str:
    """Return what may come next, the likeliest first."""
    if accepted >= _STATEMENT:
        return "a statement"
    words = []
    rest = set(accepted)
    if "NUMBER" in accepted:
        words.append("an expression")
        rest -= _OPERAND
    elif "NAME" in accepted:
        words.append("a name")
        rest.discard("NAME")
    after_operand = "STAR" in accepted
    if after_operand:
        rest -= _OPERATORS
    unit = "UNIT" in rest
    end = "$END" in rest
    rest -= {"UNIT", "$END", "INEQUALITY"} if end else {"UNIT", "$END"}
    words += sorted(f"`{symbols.get(name, name.lower())}`" for name in rest)
    if after_operand:
        words.append("an operator")
    if unit:
        words.append("a unit")
    if end:
        words.append("the end of the line")
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]])) if words else ""


def _way_out(tokens: Sequence[Token], index: int, accepted: set[str]) -> str | None:
    token = tokens[index] if index < len(tokens) else Token("$END", "")
    before = tokens[index - 1] if index else Token("", "")
    first = tokens[0]
    if token.type == "COMMA" and before.type == "NUMBER" and "RPAR" not in accepted:
        after = tokens[index + 1] if index + 1 < len(tokens) else ""
        return f"write `{before}.{after}`" if str(after).isdigit() else None
    if token.type == "EQUAL" and ("INEQUALITY" in accepted or "EQUALITY" in accepted):
        return "`==` compares"
    if token == "*" and before == "*":
        return "a power is written `^`"
    if index <= 1 and first.type == "NAME":
        return suggest(first, STATEMENT_KEYWORDS)
    if token in KEYWORDS and "NUMBER" in accepted:
        return f"put `{token}` and what belongs to it in parentheses" if token == "if" else None
    return None
