"""Editors color a model as the scanner cuts it: Pygments lexer and TextMate grammar."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from importlib.metadata import entry_points
from importlib.resources import files

import pytest

from nsode.inclusion.functions import ARITY
from nsode.limits import DEFAULT_LIMITS
from nsode.source import Source
from nsode.syntax.parser import parser
from nsode.syntax.scanner import scan
from nsode.syntax.words import CONSTANT_NAMES, FUNCTION_NAMES, KEYWORDS
from support import MODELS

Piece = tuple[str, int, int]

EVERYTHING = "model m\n" + "\n".join(
    [
        *(f"let a = {word} b" for word in sorted(KEYWORDS | FUNCTION_NAMES | CONSTANT_NAMES)),
        "let b1_ = x.y[i..2] + .5 - 2.*1e-3/1E5^3..n {N/m^2} # c {",
        "let c: (1, 2) < <= > >= == != =",
    ]
)
TEXTS = [*(path.read_text(encoding="utf-8") for path in MODELS), EVERYTHING]


def scanned(text: str) -> Iterator[Piece]:
    """Yield what the scanner makes of a text, by coarse kind."""
    tokens = [
        token
        for statement in scan(Source("m.di", text), parser().vocabulary, DEFAULT_LIMITS)
        for token in statement.tokens
    ]
    last = ""
    for token in tokens:
        kind = {"NAME": "name", "NUMBER": "number", "UNIT": "unit"}.get(token.type, "symbol")
        if token.text in KEYWORDS and last != ".":
            kind = "keyword"
        if last == "model":
            kind = "name"
        last = token.text
        yield kind, token.start, token.end


def pygmentized(text: str) -> Iterator[Piece]:
    pygments = pytest.importorskip("pygments")
    types = pygments.token
    kinds = [
        (types.Operator.Word, "keyword"),
        (types.Keyword, "keyword"),
        (types.Name, "name"),
        (types.Number, "number"),
        (types.String, "unit"),
        (types.Operator, "symbol"),
        (types.Punctuation, "symbol"),
    ]
    from nsode.syntax.pygments_lexer import DiLexer

    for start, found, value in DiLexer().get_tokens_unprocessed(text):
        if found in types.Whitespace or found in types.Comment:
            continue
        kind = next((kind for type_, kind in kinds if found in type_), "error")
        yield kind, start, start + len(value)


SCOPES = {
    "comment": None,
    "keyword.operator.nsode": "symbol",
    "keyword.": "keyword",
    "entity.": "name",
    "support.function": "name",
    "constant.language": "name",
    "variable.": "name",
    "constant.numeric": "number",
    "string.": "unit",
    "punctuation.": "symbol",
}


def textmate() -> dict[str, list[dict[str, str]]]:
    text = files("nsode.grammar").joinpath("di.tmLanguage.json").read_text(encoding="utf-8")
    return json.loads(text)


def textmated(text: str) -> Iterator[Piece]:
    """Apply the patterns as an editor does: line by line, leftmost match, first of equals."""
    patterns = [(re.compile(p["match"]), p) for p in textmate()["patterns"]]
    offset = 0
    for line in text.splitlines(keepends=True):
        place = 0
        while matches := [(m, p) for r, p in patterns if (m := r.search(line, place))]:
            match, pattern = min(matches, key=lambda found: found[0].start())
            scopes = {0: {"name": pattern["name"]}} if "name" in pattern else pattern["captures"]
            for group, scope in scopes.items():
                kind = next(k for start, k in SCOPES.items() if scope["name"].startswith(start))
                if kind:
                    yield kind, offset + match.start(int(group)), offset + match.end(int(group))
            place = match.end()
        offset += len(line)


@pytest.mark.parametrize("text", TEXTS, ids=[*(path.stem for path in MODELS), "everything"])
def test_pygments_cuts_a_text_as_the_scanner_does(text: str) -> None:
    assert list(pygmentized(text)) == list(scanned(text))


@pytest.mark.parametrize("text", TEXTS, ids=[*(path.stem for path in MODELS), "everything"])
def test_textmate_cuts_a_text_as_the_scanner_does(text: str) -> None:
    assert list(textmated(text)) == list(scanned(text))


def test_pygments_marks_what_is_not_in_the_language() -> None:
    assert [kind for kind, *_ in pygmentized("let a = $ 'x' &")].count("error") == 4


def test_the_functions_are_those_of_stage_2() -> None:
    assert set(ARITY) == FUNCTION_NAMES


def test_pygments_finds_the_lexer_by_its_entry_point() -> None:
    (entry,) = entry_points(group="pygments.lexers", name="nsode")
    assert "*.di" in entry.load().filenames
