"""One pass over the text: tokens, grouped into statements, and what is wrong with them.

A statement ends at a newline outside brackets, so an error in one leaves the next
untouched; text of any depth is refused here, before anything could recurse.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from nsode.diagnostics import Diagnostic
from nsode.limits import Limits
from nsode.source import Source, Span
from nsode.syntax import literals, slips
from nsode.syntax.tokens import Token, Vocabulary
from nsode.syntax.words import FILE_KEYWORDS, STATEMENT_KEYWORDS

_CLOSING = {"(": ")", "[": "]"}
_FIRST_WORD = re.compile(r"[ \t]*([A-Za-z]\w*)", re.ASCII)


@dataclass(slots=True)
class StatementTokens:
    """The tokens of one statement, and the errors that the scanner found in it."""

    tokens: list[Token] = field(default_factory=list)
    errors: list[Diagnostic] = field(default_factory=list)

    @property
    def span(self) -> Span:
        """Return the range of text from the first to the last token."""
        return Span(self.tokens[0].start, self.tokens[-1].end)


def scan(source: Source, vocabulary: Vocabulary, limits: Limits) -> list[StatementTokens]:
    """Return the statements of a text in order."""
    return _Scanner(source.text, vocabulary, limits).run()


class _Scanner:
    def __init__(self, text: str, vocabulary: Vocabulary, limits: Limits) -> None:
        self.text = text
        self.vocabulary = vocabulary
        self.limits = limits
        self.statements: list[StatementTokens] = []
        self.current = StatementTokens()
        self.open: list[int] = []  # indices in current.tokens of the open brackets
        self.line_start = 0  # index in current.tokens of the first token of the line
        self.signs = 0  # how many signs stand in a row
        self.deep: tuple[Span, int] | None = None  # where the limit is passed, and how far

    def run(self) -> list[StatementTokens]:
        for match in self.vocabulary.pattern.finditer(self.text):
            kind = match.lastgroup
            if kind == "skip":
                continue
            if kind == "newline":
                self._newline(match.end())
            else:
                assert kind is not None
                self._piece(Token(kind, match[0], match.start(), match.end()))
        self._end_statement("the file ends")
        return self.statements

    def _piece(self, piece: Token) -> None:
        match piece.type:
            case "symbol":
                piece = piece._replace(type=self.vocabulary.symbols[piece.text])
                self._symbol(piece)
            case "NUMBER":
                self._report(literals.unsound_number(piece))
            case "malformed":
                self._report(literals.malformed_number(piece))
            case "NAME":
                self._report(slips.name_too_long(piece, self.limits))
            case "UNIT":
                self._report(literals.malformed_unit(piece))
            case "string":
                self._report(slips.string(piece))
            case "underscore":
                self._report(slips.leading_underscore(piece, self.limits.name))
            case "foreign":
                self._report(slips.foreign(piece, self.current.tokens))
        self._count_signs(piece)
        self.current.tokens.append(piece)

    def _report(self, error: Diagnostic | None) -> None:
        if error is not None:
            self.current.errors.append(error)

    def _count_signs(self, token: Token) -> None:
        self.signs = self.signs + 1 if token.text in ("-", "not") else 0
        self._look_down(token, self.signs)

    # brackets

    def _symbol(self, token: Token) -> None:
        match token.text:
            case "(" | "[":
                self.open.append(len(self.current.tokens))
                self._look_down(token, len(self.open))
            case ")" | "]":
                self._close(token)
            case "=" if self.open and self.open[-1] < self.line_start:
                self._resume_at_line()

    def _close(self, token: Token) -> None:
        if not self.open:
            self._report(slips.nothing_to_close(token))
            return
        opening = self.current.tokens[self.open.pop()]
        if _CLOSING[opening.text] != token.text:
            self._report(slips.mismatched(opening, token))

    def _look_down(self, token: Token, depth: int) -> None:
        if depth > self.limits.depth:
            place, deepest = self.deep or (token.span, depth)
            self.deep = place, max(deepest, depth)

    # lines

    def _newline(self, end: int) -> None:
        self.line_start = len(self.current.tokens)
        if not self.open:
            self._end_statement("")
            return
        word = _FIRST_WORD.match(self.text, end)
        if word and (word[1] in STATEMENT_KEYWORDS or word[1] in FILE_KEYWORDS):
            self._end_statement(f"`{word[1]}` begins a statement")

    def _resume_at_line(self) -> None:
        """Begin a statement where this line began: no bracket holds an ``=``."""
        line = self.current.tokens[self.line_start :]
        del self.current.tokens[self.line_start :]
        self._end_statement("the next line holds an `=`")
        self.current.tokens = line

    def _end_statement(self, why: str) -> None:
        if self.open:
            self._report(slips.unclosed(self.current.tokens[self.open[-1]], why))
        if self.deep:
            self._report(slips.too_deep(*self.deep, self.limits))
            self.deep = None
        if self.current.tokens:
            self.statements.append(self.current)
        self.current = StatementTokens()
        self.open.clear()
        self.line_start = 0
        self.signs = 0
