"""The lines that are judged as raw text: ``model NAME``, and what would read a file."""

from __future__ import annotations

import re

from nsode.diagnostics import Diagnostic, Label
from nsode.source import Source, Span
from nsode.syntax import ast
from nsode.syntax.limits import Limits
from nsode.syntax.scanner import StatementTokens
from nsode.syntax.slips import name_too_long
from nsode.syntax.words import FILE_KEYWORDS, RESERVED

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_HELP = "begin the file with `model NAME`"


def take(
    source: Source, statements: list[StatementTokens], limits: Limits, errors: list[Diagnostic]
) -> tuple[ast.Identifier | None, list[StatementTokens]]:
    """Return the name of the model and the statements that are left to parse."""
    names: list[ast.Identifier | None] = []
    rest = []
    first = statements[0] if statements else None
    for statement in statements:
        word = statement.tokens[0] if statement.tokens else ""
        if word == "model":
            errors.extend(_too_late(statement, first, names))
            names.append(_model_name(source, statement, limits, errors))
        elif word in FILE_KEYWORDS:
            errors.append(_reads_a_file(source, statement))
        else:
            rest.append(statement)
    if not names:
        errors.append(_no_model(source, first))
    return (names[0] if names else None), rest


def _raw(source: Source, statement: StatementTokens) -> Span:
    """Return the rest of the line behind the first word, without its comment."""
    start = statement.tokens[0].end_pos
    assert start is not None
    line = re.compile(r"[^\n#]*").match(source.text, start)
    text = line.group() if line else ""
    start += len(text) - len(text.lstrip())
    return Span(start, start + len(text.strip()))


def _model_name(
    source: Source, statement: StatementTokens, limits: Limits, errors: list[Diagnostic]
) -> ast.Identifier | None:
    span = _raw(source, statement)
    text = source.slice(span)
    problem: Diagnostic | None = None
    if not text:
        span = statement.span
        problem = Diagnostic("NS006", "the model has no name", (Label(span),), help=_HELP)
    elif not _NAME.fullmatch(text):
        problem = _malformed(text, span)
    elif text in RESERVED:
        message = f"`{text}` is a keyword and cannot name a model"
        problem = Diagnostic("NS103", message, (Label(span, "choose another name"),))
    elif len(text) > limits.name:
        problem = name_too_long(text, span.start, limits.name)
    if problem is None:
        return ast.Identifier(text, span=span)
    errors.append(problem)
    return None


def _malformed(text: str, span: Span) -> Diagnostic:
    fixed = re.sub(r"[^A-Za-z0-9]+", "_", text).strip("_")
    usable = _NAME.fullmatch(fixed) and len(fixed) <= 32 and fixed not in RESERVED
    return Diagnostic(
        "NS006",
        "the name of a model is a letter and then letters, digits and `_`",
        (Label(span, "it becomes part of file names and of names in the code"),),
        help=f"write `model {fixed}`" if usable else None,
    )


def _too_late(
    statement: StatementTokens, first: StatementTokens | None, names: list[ast.Identifier | None]
) -> list[Diagnostic]:
    if statement is first:
        return []
    place = Label(statement.span)
    if names:
        labels = (place,) if names[0] is None else (place, Label(names[0].span, "the first one"))
        return [Diagnostic("NS102", "a file holds one model", labels, help="use a second file")]
    assert first is not None
    if first.tokens and first.tokens[0] in FILE_KEYWORDS:
        return []
    labels = (place, Label(first.span, "this stands before it")) if first.tokens else (place,)
    return [Diagnostic("NS005", "`model` must come first", labels)]


def _no_model(source: Source, first: StatementTokens | None) -> Diagnostic:
    if not source.text.strip():
        return Diagnostic("NS005", "the file is empty", help=_HELP)
    if first is None:
        return Diagnostic("NS005", "no model: the file holds only comments", help=_HELP)
    if not first.tokens:
        return Diagnostic("NS005", "no model: the file does not begin with one", help=_HELP)
    word = first.tokens[0]
    if word.lower() == "model":
        return Diagnostic(
            "NS005", f"no model: `{word}` is not `model`", (Label(first.span),), help=_HELP
        )
    label = Label(first.span, "a statement outside a model")
    return Diagnostic("NS005", "no model: a file begins with `model NAME`", (label,), help=_HELP)


def _reads_a_file(source: Source, statement: StatementTokens) -> Diagnostic:
    word = statement.tokens[0]
    span = Span(statement.span.start, max(_raw(source, statement).end, statement.tokens[0].end_pos))
    return Diagnostic(
        "NS007",
        f"`{word}`: nsode reads no files from inside a model",
        (Label(span),),
        help="copy what you need into this file; data enter as an `input` when the model runs",
    )
