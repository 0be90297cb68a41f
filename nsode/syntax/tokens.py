"""Tokens, and the terminals of the grammar as one regular expression."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from lark.lexer import PatternStr, TerminalDef

from nsode.source import Span


class Token(NamedTuple):
    """A piece of the text; ``type`` is the name of a terminal of the grammar."""

    type: str
    text: str
    start: int
    end: int

    @property
    def span(self) -> Span:
        """Return the range of text that the token covers."""
        return Span(self.start, self.end)


class Vocabulary:
    """What a text can be cut into.

    Attributes
    ----------
    keywords, symbols
        The terminals with a fixed text, by that text: words, and all others.
    texts
        The fixed text of a terminal, by its name.
    pattern
        Matches one token; the name of the group is its kind. What begins no token
        is cut into malformed numbers, strings, words with a leading underscore, and
        stray characters.
    """

    def __init__(self, terminals: Iterable[TerminalDef]) -> None:
        fixed = {t.pattern.value: t.name for t in terminals if isinstance(t.pattern, PatternStr)}
        self.texts = {name: text for text, name in fixed.items()}
        self.keywords = {text: name for text, name in fixed.items() if text.isalpha()}
        self.symbols = {text: name for text, name in fixed.items() if not text.isalpha()}
        patterns = {t.name: t.pattern.to_regexp() for t in terminals}
        symbols = "|".join(map(re.escape, sorted(self.symbols, key=len, reverse=True)))
        self.pattern = re.compile(
            rf"(?P<skip>[ \t]+|{patterns['COMMENT']})"
            rf"|(?P<NAME>{patterns['NAME']})"
            rf"|(?P<NUMBER>{patterns['NUMBER']})(?![A-Za-z0-9_]|\.(?!\.))"
            r"|(?P<malformed>\.?[0-9](?:[eE][+-](?=[0-9])|[A-Za-z0-9_]|\.(?!\.))*)"
            rf"|(?P<UNIT>{patterns['UNIT']})"
            rf"|(?P<INEQUALITY>{patterns['INEQUALITY']})"
            rf"|(?P<EQUALITY>{patterns['EQUALITY']})"
            rf"|(?P<symbol>{symbols})"
            r"|(?P<newline>\r?\n)"
            r"""|(?P<string>'[^'\n]*'|"[^"\n]*")"""
            r"|(?P<underscore>_[A-Za-z0-9_]*)"
            r"|(?P<foreign>[^\x00-\x7F]+|&&|\|\||[^\n])"
        )
