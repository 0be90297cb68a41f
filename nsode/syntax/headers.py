"""What is judged line by line before parsing: ``model NAME``, and what would read a file."""

from __future__ import annotations

import re
from collections.abc import Iterator

from nsode.diagnostics import Diagnostic, Label
from nsode.source import Source, Span
from nsode.syntax.scanner import StatementTokens
from nsode.syntax.words import FILE_KEYWORDS, RESERVED

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_REST_OF_LINE = re.compile(r"[ \t]*([^\n#]*)")
_HELP = "begin the file with `model NAME`"


def judge(source: Source, statements: list[StatementTokens]) -> list[Diagnostic]:
    """Return what is wrong with the frame of a model.

    A line that is judged as raw text gets its verdict here, in place of what the scanner
    found inside it.
    """
    for statement in statements:
        first = statement.tokens[0].text
        if first in FILE_KEYWORDS:
            statement.errors = [_reads_a_file(source, statement)]
        elif first == "model" and (problem := _malformed_name(source, statement)):
            statement.errors = [problem]
    return list(_missing_or_late(source, statements))


def _rest_of_line(source: Source, statement: StatementTokens) -> Span:
    match = _REST_OF_LINE.match(source.text, statement.tokens[0].end)
    assert match is not None
    return Span(match.start(1), match.start(1) + len(match[1].rstrip()))


def _reads_a_file(source: Source, statement: StatementTokens) -> Diagnostic:
    word = statement.tokens[0]
    return Diagnostic(
        "NS007",
        f"`{word.text}`: nsode reads no files from inside a model",
        (Label(word.span.to(_rest_of_line(source, statement))),),
        help="copy what you need into this file; data enter as an `input` when the model runs",
    )


def _malformed_name(source: Source, statement: StatementTokens) -> Diagnostic | None:
    span = _rest_of_line(source, statement)
    text = source.slice(span)
    if _NAME.fullmatch(text):
        return None
    if not text:
        return Diagnostic("NS006", "the model has no name", (Label(statement.span),), help=_HELP)
    likely = re.sub(r"[^A-Za-z0-9]+", "_", text).strip("_")
    usable = _NAME.fullmatch(likely) and len(likely) <= 32 and likely not in RESERVED
    return Diagnostic(
        "NS006",
        "the name of a model is a letter followed by letters, digits and `_`",
        (Label(span, "files and functions will be named after it"),),
        help=f"write `model {likely}`" if usable else None,
    )


def _missing_or_late(source: Source, statements: list[StatementTokens]) -> Iterator[Diagnostic]:
    if not statements:
        what = "holds only comments" if source.text.strip() else "is empty"
        yield Diagnostic("NS005", f"no model: the file {what}", help=_HELP)
        return
    models = [s for s in statements if s.tokens[0].text == "model"]
    others = [s for s in statements if s.tokens[0].text not in {"model", *FILE_KEYWORDS}]
    if not models:
        start = Label(statements[0].span, "a file begins with `model NAME`")
        yield Diagnostic("NS005", "no model", (start,), help=_HELP)
    elif others and others[0].span.start < models[0].span.start:
        labels = (Label(models[0].span), Label(others[0].span, "this stands before it"))
        yield Diagnostic("NS005", "`model` must come first", labels, help="move it to the top")
    for extra in models[1:]:
        labels = (Label(extra.span), Label(models[0].span, "the first one"))
        yield Diagnostic("NS102", "a second `model`", labels, help="a file holds one model")
