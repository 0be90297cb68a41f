"""One pass over the text: tokens, grouped into statements, and what is wrong with them.

The patterns of the tokens are those of the grammar. A statement ends at a newline
outside brackets, so an error in one leaves the next untouched, and text of any depth
is refused before anything recurses.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

from lark import Token
from lark.lexer import PatternStr, TerminalDef

from nsode.diagnostics import Diagnostic
from nsode.source import Source, Span
from nsode.syntax import slips
from nsode.syntax.limits import Limits
from nsode.syntax.words import FILE_KEYWORDS, STATEMENT_KEYWORDS

_CLOSING = {"(": ")", "[": "]"}
_WORD = re.compile(r"[A-Za-z]+")


@dataclass(slots=True)
class StatementTokens:
    """The tokens of one statement, and the errors that the scanner found in it."""

    tokens: list[Token] = field(default_factory=list)
    errors: list[Diagnostic] = field(default_factory=list)

    @property
    def span(self) -> Span:
        """Return the range of text from the first to the last token."""
        return Span(self.tokens[0].start_pos, self.tokens[-1].end_pos)  # type: ignore[arg-type]


class Vocabulary:
    """The terminals of the grammar as one regular expression and a table of fixed texts."""

    def __init__(self, terminals: Iterable[TerminalDef]) -> None:
        fixed = {t.pattern.value: t.name for t in terminals if isinstance(t.pattern, PatternStr)}
        self.keywords = {text: name for text, name in fixed.items() if text.isalpha()}
        self.symbols = {text: name for text, name in fixed.items() if not text.isalpha()}
        self.texts = {name: text for text, name in fixed.items()}
        patterns = {t.name: t.pattern.to_regexp() for t in terminals}
        longest_first = sorted(self.symbols, key=len, reverse=True)
        self.scan = re.compile(
            f"(?P<skip>[ \\t]+|{patterns['COMMENT']})"
            f"|(?P<NAME>{patterns['NAME']})"
            f"|(?P<NUMBER>{patterns['NUMBER']})"
            f"|(?P<UNIT>{patterns['UNIT']})"
            f"|(?P<INEQUALITY>{patterns['INEQUALITY']})"
            f"|(?P<EQUALITY>{patterns['EQUALITY']})"
            f"|(?P<symbol>{'|'.join(map(re.escape, longest_first))})"
            r"|(?P<newline>\r?\n)"
            r"|(?P<foreign>.)",
            re.DOTALL,
        ).finditer


class Scanner:
    """Splits one source into statements."""

    def __init__(self, source: Source, vocabulary: Vocabulary, limits: Limits) -> None:
        self.source = source
        self.text = source.text
        self.vocabulary = vocabulary
        self.limits = limits
        self.statements: list[StatementTokens] = []
        self.current = StatementTokens()
        self.open: list[int] = []  # indices of the brackets in current.tokens that are open
        self.line_start = 0  # index of the first token of the present line
        self.signs = 0  # how many signs stand in a row

    def run(self) -> list[StatementTokens]:
        """Return the statements in order."""
        for match in self.vocabulary.scan(self.text):
            kind = match.lastgroup
            if kind == "skip":
                continue
            if kind == "newline":
                self._newline(match.end())
            elif kind == "foreign":
                self._foreign(match.start())
            else:
                self._token(kind, match.group(), match.start())  # type: ignore[arg-type]
        self._end_statement("the file ends")
        return self.statements

    def _token(self, kind: str, text: str, start: int) -> None:
        if kind == "symbol":
            kind = self.vocabulary.symbols[text]
            if text in "([":
                self._open(text, start)
            elif text in ")]":
                self._close(text, start)
            elif text == "=" and self.open and self.open[-1] < self.line_start:
                self._resume_at_line()
        elif kind == "NUMBER":
            self._check_number(text, start)
        elif kind == "NAME":
            self._check_name(text, start)
        elif kind == "UNIT":
            self._report(slips.malformed_unit(text, start))
        self._count_signs(text, start)
        self.current.tokens.append(Token(kind, text, start, end_pos=start + len(text)))

    def _report(self, error: Diagnostic | None) -> None:
        if error is not None:
            self.current.errors.append(error)

    def _count_signs(self, text: str, start: int) -> None:
        self.signs = self.signs + 1 if text in ("-", "not") else 0
        if self.signs == self.limits.depth + 1:
            self._report(slips.too_deep(Span(start, start + 1), self.limits.depth))

    # brackets and lines

    def _open(self, text: str, start: int) -> None:
        self.open.append(len(self.current.tokens))
        if len(self.open) == self.limits.depth + 1:
            self._report(slips.too_deep(Span(start, start + 1), self.limits.depth))

    def _close(self, text: str, start: int) -> None:
        span = Span(start, start + 1)
        if not self.open:
            self._report(slips.nothing_to_close(text, span))
            return
        opening = self.current.tokens[self.open.pop()]
        if _CLOSING[opening] != text:
            self._report(slips.mismatched(opening, text, span))

    def _newline(self, end: int) -> None:
        self.line_start = len(self.current.tokens)
        if not self.open:
            self._end_statement("the line ends")
            return
        word = _WORD.match(self.text, self._skip_blanks(end))
        if word and (word.group() in STATEMENT_KEYWORDS or word.group() in FILE_KEYWORDS):
            self._end_statement(f"`{word.group()}` begins a statement")

    def _skip_blanks(self, offset: int) -> int:
        while offset < len(self.text) and self.text[offset] in " \t":
            offset += 1
        return offset

    def _end_statement(self, why: str) -> None:
        if self.open:
            opening = self.current.tokens[self.open[-1]]
            self._report(slips.unclosed(opening, why))
        if self.current.tokens or self.current.errors:
            self.statements.append(self.current)
        self.current = StatementTokens()
        self.open.clear()
        self.line_start = 0
        self.signs = 0

    def _resume_at_line(self) -> None:
        """Take an ``=`` inside a bracket of an earlier line for the next equation."""
        rest = self.current.tokens[self.line_start :]
        del self.current.tokens[self.line_start :]
        self.open = [i for i in self.open if i < self.line_start]
        self._end_statement("the next line holds an `=`")
        self.current.tokens = rest

    # single tokens

    def _check_number(self, text: str, start: int) -> None:
        self._report(slips.malformed_number(self.text, Span(start, start + len(text))))

    def _check_name(self, text: str, start: int) -> None:
        if len(text) > self.limits.name:
            self._report(slips.name_too_long(text, start, self.limits.name))

    def _foreign(self, start: int) -> None:
        self._report(slips.foreign(self.text, start, self.current.tokens))
