"""The parser: scanned statements through the LALR grammar to the tree of a model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from pkgutil import get_data
from typing import Any, cast

import lark.lexer
from lark import Lark
from lark.exceptions import UnexpectedToken
from lark.lexer import Lexer
from lark.parsers.lalr_interactive_parser import InteractiveParser

from nsode.diagnostics import Diagnostic, ModelError
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.source import Source
from nsode.syntax import ast, depth, headers, slips
from nsode.syntax.builder import Builder
from nsode.syntax.misfit import Misfit
from nsode.syntax.reading import too_large
from nsode.syntax.scanner import StatementTokens, scan
from nsode.syntax.tokens import Token, Vocabulary
from nsode.syntax.unexpected import explain


def grammar() -> str:
    """Return the text of the grammar."""
    text = get_data("nsode.grammar", "di.lark")
    assert text is not None
    return text.decode()


class _NoLexer(Lexer):
    """Stands in for lark's lexers: the scanner has cut the text already."""

    def __init__(self, _configuration: object) -> None: ...

    def lex(self, lexer_state: object, parser_state: object) -> Iterator[Any]:
        raise NotImplementedError


@contextmanager
def _no_check_of_larks_own_terminals() -> Iterator[None]:
    """Save 0.1 s at each start where interegular is installed.

    Lark then compares the terminals of the language in which grammars are written; those
    of our grammar are compared in the tests.
    """
    installed = lark.lexer.has_interegular
    lark.lexer.has_interegular = False
    try:
        yield
    finally:
        lark.lexer.has_interegular = installed


class Parser:
    """A parser of single statements; :func:`parser` holds the one of this process."""

    def __init__(self) -> None:
        self.builder = Builder()
        with _no_check_of_larks_own_terminals():
            self.lark = Lark(
                grammar(),
                start="statement",
                parser="lalr",
                lexer=_NoLexer,
                transformer=cast(Any, self.builder),
            )
        self.vocabulary = Vocabulary(self.lark.terminals)

    def parse(self, statement: StatementTokens) -> ast.Statement | ast.Identifier:
        """Return the tree of a statement; the identifier of a ``model`` line.

        Raises
        ------
        ModelError
            With the first error of the statement.
        """
        self.builder.statement = statement.span
        fed: list[Token] = []
        state = self.lark.parse_interactive()
        try:
            for token in statement.tokens:
                fed.append(self.as_keyword(token, state))
                state.feed_token(cast(Any, fed[-1]))
            return cast(ast.Statement, state.feed_eof())  # type: ignore[no-untyped-call]
        except UnexpectedToken as error:
            bad = None if error.token.type == "$END" else fed.pop()
            rest = statement.tokens[len(fed) + 1 :]
            misfit = Misfit(fed, bad, rest, self._expected(fed))
            raise ModelError([explain(misfit, self.vocabulary.texts)]) from None

    def as_keyword(self, token: Token, state: InteractiveParser) -> Token:
        """Make a word a keyword where one may stand, or where an operand may stand."""
        if token.type != "NAME" or token.text not in self.vocabulary.keywords:
            return token
        keyword = self.vocabulary.keywords[token.text]
        choices = state.choices()  # type: ignore[no-untyped-call]
        is_keyword = keyword in choices or "NUMBER" in choices or "NAME" not in choices
        return token._replace(type=keyword) if is_keyword else token

    def _expected(self, tokens: Sequence[Token]) -> set[str]:
        """Return the terminals that may follow these tokens."""
        state = self.lark.parse_interactive()
        for token in tokens:
            state.feed_token(cast(Any, token))
        return cast(set[str], state.accepts())  # type: ignore[no-untyped-call]


@cache
def parser() -> Parser:
    """Return the parser, built when first needed."""
    return Parser()


def parse(source: Source, limits: Limits = DEFAULT_LIMITS) -> ast.Model:
    """Return the tree of a model.

    Raises
    ------
    ModelError
        With every error found, in order of place, and ``source`` set.
    """
    if len(source.text) > limits.size:
        raise too_large(source, limits)
    if hidden := slips.hidden(source):
        raise ModelError([hidden], source)
    statements = scan(source, parser().vocabulary, limits)
    errors = headers.judge(source, statements)
    names, trees = [], []
    for statement in statements:
        try:
            tree = _parse_statement(statement, limits)
        except ModelError as error:
            errors.extend(error.diagnostics)
        else:
            names.append(tree) if isinstance(tree, ast.Identifier) else trees.append(tree)
    if errors:
        raise ModelError(in_order(_each_once(errors), limits), source)
    return ast.Model(names[0], tuple(trees), source)


def _each_once(errors: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return errors with a character outside the language told once, however often it stands."""
    first: dict[str, int] = {}
    counts: dict[str, int] = {}
    found: list[Diagnostic] = []
    for error in errors:
        if error.code == "NS002":
            counts[error.message] = counts.get(error.message, 0) + 1
            if first.setdefault(error.message, len(found)) < len(found):
                continue
        found.append(error)
    for message, count in counts.items():
        if count > 1:
            error = found[first[message]]
            places = "1 more place" if count == 2 else f"{count - 1:,} more places"
            found[first[message]] = replace(error, notes=(*error.notes, f"and at {places}"))
    return found


def _parse_statement(statement: StatementTokens, limits: Limits) -> ast.Statement | ast.Identifier:
    if statement.errors:
        raise ModelError(statement.errors)
    tree = parser().parse(statement)
    may_be_deep = len(statement.tokens) > limits.depth
    if may_be_deep and (deep := depth.beyond(tree, limits.depth)):
        notes = ["each factor of a product is one level"] if deep.in_product else []
        raise ModelError([slips.too_deep(deep.place, deep.deepest, limits, *notes)])
    return tree


def in_order(found: Sequence[Diagnostic], limits: Limits) -> list[Diagnostic]:
    """Return what was found by place; of too many errors the first alone, without warnings."""
    ordered = sorted(found, key=lambda d: d.labels[0].span.start if d.labels else 0)
    errors = [diagnostic for diagnostic in ordered if diagnostic.severity == "error"]
    if len(errors) <= limits.errors:
        return ordered
    *kept, last = errors[: limits.errors]
    more = f"{len(errors) - limits.errors:,} further errors are not shown"
    note = f"{more}: {limits.raised('errors', len(errors))}"
    return [*kept, replace(last, notes=(*last.notes, note))]
