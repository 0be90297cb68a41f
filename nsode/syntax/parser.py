"""The parser: scanned statements through the LALR grammar to the tree of a model."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Any, cast

from lark import Lark, Token
from lark.exceptions import UnexpectedToken
from lark.lexer import Lexer

from nsode.diagnostics import Diagnostic, ModelError
from nsode.source import Source
from nsode.syntax import ast, depth, headers, slips
from nsode.syntax.builder import Builder
from nsode.syntax.limits import DEFAULT_LIMITS, Limits
from nsode.syntax.reading import too_large
from nsode.syntax.scanner import Scanner, StatementTokens, Vocabulary
from nsode.syntax.unexpected import explain


def grammar() -> str:
    """Return the text of the grammar."""
    return files("nsode.grammar").joinpath("di.lark").read_text(encoding="utf-8")


class _Replay(Lexer):
    """Hands the scanner's tokens to the parser; a word is a keyword where one may stand."""

    __future_interface__ = True

    def __init__(self, _conf: Any) -> None: ...

    def lex(self, lexer_state: Any, parser_state: Any) -> Iterator[Token]:
        keywords: dict[str, str] = lexer_state.text[1]
        states = parser_state.parse_conf.states
        stack = parser_state.state_stack
        for token in lexer_state.text[0]:
            if token.type == "NAME" and token in keywords:
                keyword = keywords[token]
                actions = states[stack[-1]]
                if keyword in actions or "NUMBER" in actions or "NAME" not in actions:
                    token.type = keyword
            yield token


class Parser:
    """A parser for models; :func:`parser` holds the one of this process."""

    def __init__(self) -> None:
        self.builder = Builder()
        self.lark = Lark(
            grammar(),
            start="statement",
            parser="lalr",
            lexer=_Replay,
            transformer=cast(Any, self.builder),
        )
        self.vocabulary = Vocabulary(self.lark.terminals)

    def statement(self, statement: StatementTokens, limits: Limits) -> Any:
        """Return the tree of one statement; a ModelError says what is wrong with it."""
        self.builder.statement = statement.span
        try:
            tree = self.lark.parse(cast(Any, (statement.tokens, self.vocabulary.keywords)))
        except UnexpectedToken as error:
            raise ModelError([explain(error, statement.tokens, self.vocabulary.texts)]) from None
        if len(statement.tokens) > limits.depth and (
            place := depth.beyond(tree, limits.depth)
        ):
            raise ModelError([slips.too_deep(place, limits.depth)])
        return tree


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
    own = parser()
    scanned = Scanner(source, own.vocabulary, limits).run()
    errors: list[Diagnostic] = []
    name, statements = headers.take(source, scanned, limits, errors)
    trees = []
    for statement in statements:
        try:
            if statement.errors:
                raise ModelError(statement.errors)
            trees.append(own.statement(statement, limits))
        except ModelError as error:
            errors.extend(error.diagnostics)
    if errors or name is None:
        raise ModelError(_in_order(errors, limits), source)
    return ast.Model(name, tuple(trees), source)


def _in_order(errors: list[Diagnostic], limits: Limits) -> list[Diagnostic]:
    """Return the errors by place, as many as the limit allows."""
    ordered = sorted(errors, key=lambda e: e.labels[0].span.start if e.labels else 0)
    kept = ordered[: limits.errors]
    if len(ordered) > len(kept):
        more = f"{len(ordered) - len(kept)} further errors are not shown"
        kept[-1] = replace(kept[-1], notes=(*kept[-1].notes, more))
    return kept
