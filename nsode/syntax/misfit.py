"""The place in a statement where the grammar no longer fits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from nsode.syntax.tokens import Token

#: Terminals that continue an expression behind an operand.
OPERATORS = frozenset(
    {"PLUS", "MINUS", "STAR", "SLASH", "CIRCUMFLEX", "INEQUALITY", "EQUALITY", "AND", "OR"}
    | {"DOT", "LSQB", "LPAR"}
)


@dataclass(frozen=True, slots=True)
class Misfit:
    """A statement up to the token that has no place in it.

    Attributes
    ----------
    before, bad, after
        The tokens that were understood, the one that was not (None: the statement ends),
        and the rest.
    accepted
        The terminals that could have stood in its place.
    """

    before: Sequence[Token]
    bad: Token | None
    after: Sequence[Token]
    accepted: set[str]

    @property
    def type(self) -> str:
        """Return the type of the bad token."""
        return self.bad.type if self.bad else "$END"

    @property
    def text(self) -> str:
        """Return the text of the bad token."""
        return self.bad.text if self.bad else ""

    @property
    def first(self) -> Token:
        """Return the first token of the statement."""
        return self.before[0] if self.before else self.bad  # type: ignore[return-value]

    @property
    def last(self) -> Token | None:
        """Return the token in front of the bad one."""
        return self.before[-1] if self.before else None

    @property
    def wants_operand(self) -> bool:
        """Tell whether an expression could have begun here."""
        return "NUMBER" in self.accepted

    @property
    def follows_operand(self) -> bool:
        """Tell whether an operator could have stood here."""
        return "STAR" in self.accepted
