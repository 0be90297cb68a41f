"""A Pygments lexer, for notebooks and documents: ``pygmentize -l nsode model.di``.

Pygments finds it by its entry point. The tests hold it against the scanner.
"""

from __future__ import annotations

from pygments.lexer import RegexLexer, bygroups, words
from pygments.token import Comment, Keyword, Literal, Name, Number, Operator, Punctuation
from pygments.token import Whitespace as Space

from nsode.syntax.words import (
    CONSTANT_NAMES,
    FILE_KEYWORDS,
    FUNCTION_NAMES,
    KEYWORDS,
    STATEMENT_KEYWORDS,
)

_WORD_OPERATORS = {"and", "not", "or"}
_SETS = {"dio", "sgn"}


class DiLexer(RegexLexer):  # type: ignore[misc]
    """Models of nsode."""

    name = "nsode"
    aliases = ("nsode", "di")
    filenames = ("*.di",)
    tokens = {  # noqa: RUF012 (Pygments wants a plain dict)
        "root": [
            (r"\s+", Space),
            (r"#[^\n]*", Comment.Single),
            (
                r"(model)([ \t]+)([A-Za-z][A-Za-z0-9_]*)",
                bygroups(Keyword.Namespace, Space, Name.Class),
            ),
            (r"\{[^{}\n]*\}", Literal.String.Other),
            (r"(?:[0-9]+(?:\.(?!\.)[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?", Number),
            (r"(\.)([A-Za-z][A-Za-z0-9_]*)", bygroups(Punctuation, Name.Attribute)),
            (words(sorted(_WORD_OPERATORS), suffix=r"\b"), Operator.Word),
            (words(sorted(STATEMENT_KEYWORDS), suffix=r"\b"), Keyword.Declaration),
            (words(sorted(KEYWORDS - _WORD_OPERATORS), suffix=r"\b"), Keyword),
            (words(sorted(_SETS), suffix=r"\b"), Name.Builtin.Pseudo),
            (words(sorted(FUNCTION_NAMES - _SETS), suffix=r"\b"), Name.Builtin),
            (words(sorted(CONSTANT_NAMES), suffix=r"\b"), Name.Constant),
            (words(sorted(FILE_KEYWORDS), suffix=r"\b"), Keyword.Reserved),
            (r"[A-Za-z][A-Za-z0-9_]*", Name),
            (r"[<>]=?|[=!]=|[-+*/^=]", Operator),
            (r"\.\.|[()\[\],:.]", Punctuation),
        ]
    }
