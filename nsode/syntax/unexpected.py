"""Syntax errors in words that a person understands."""

from __future__ import annotations

from nsode.diagnostics import Diagnostic, Label, suggest
from nsode.source import Span
from nsode.syntax.hints import way_out
from nsode.syntax.misfit import OPERATORS, Misfit
from nsode.syntax.slips import short
from nsode.syntax.words import FUNCTION_NAMES, STATEMENT_KEYWORDS

_OPERAND = frozenset({"NUMBER", "NAME", "LPAR", "LSQB", "MINUS", "IF", "NOT", "SUM"})
_FOREIGN_WORDS = {
    "const": "constant",
    "def": "let",
    "param": "parameter",
    "real": "parameter",
    "var": "state",
    "variable": "state",
}


def explain(misfit: Misfit, texts: dict[str, str]) -> Diagnostic:
    """Return the diagnostic for a token that the grammar has no place for.

    ``texts`` has the text of each terminal that has a fixed one.
    """
    if misspelt := _misspelt_keyword(misfit):
        return misspelt
    expected = _in_words(misfit, texts)
    label = Label(_place(misfit), f"expected {expected}" if expected else "")
    what = (
        "unexpected end of the line" if misfit.bad is None else f"unexpected {short(misfit.text)}"
    )
    return Diagnostic("NS001", what, (label,), help=way_out(misfit))


def _place(misfit: Misfit) -> Span:
    if misfit.bad is not None:
        return misfit.bad.span
    end = misfit.before[-1].end
    return Span(end, end + 1)


def _misspelt_keyword(misfit: Misfit) -> Diagnostic | None:
    """Recognize ``paramter M = 1``: two words, of which the first is no keyword."""
    if len(misfit.before) != 1 or misfit.first.type != "NAME" or misfit.type != "NAME":
        return None
    word = misfit.first.text
    if word in FUNCTION_NAMES:
        return None
    meant = _FOREIGN_WORDS.get(word.lower())
    likely = f"did you mean `{meant}`?" if meant else suggest(word.lower(), STATEMENT_KEYWORDS)
    label = Label(misfit.first.span, "expected a keyword or an equation")
    return Diagnostic("NS001", f"{short(word)} begins no statement", (label,), help=likely)


def _in_words(misfit: Misfit, texts: dict[str, str]) -> str:
    """Return what may come next, the likeliest first."""
    if not misfit.before:
        return "a statement"
    rest = set(misfit.accepted)
    words = []
    if misfit.wants_operand:
        words.append("an expression")
        rest -= _OPERAND
    elif "NAME" in rest:
        words.append("a name")
        rest.discard("NAME")
    if misfit.follows_operand:
        rest -= OPERATORS
    words += sorted(f"`{texts[name]}`" for name in rest if name in texts)
    if misfit.follows_operand:
        words.append("an operator")
    words += [text for name, text in _DESCRIBED.items() if name in rest]
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]])) if words else ""


_DESCRIBED = {
    "INEQUALITY": "a bound",
    "EQUALITY": "a comparison",
    "UNIT": "a unit",
    "$END": "the end of the line",
}
