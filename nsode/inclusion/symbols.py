"""What each name of a model stands for."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse, suggest
from nsode.expr import TIME, Call, IndexRange
from nsode.inclusion.functions import ARITY, SET_VALUED
from nsode.inclusion.report import PoisonedError
from nsode.inclusion.values import Shape, Value
from nsode.limits import Limits
from nsode.source import Span

Derivative = Callable[["Call", "Scope"], Value]

Kind = Literal["parameter", "constant", "input", "state", "let", "force", "output", "term"]


@dataclass(frozen=True, slots=True)
class Symbol:
    """A declared name: its kind, shape and index range.

    ``value`` is set for a constant, which has no place in the vectors.
    """

    name: str
    kind: Kind
    shape: Shape
    range: IndexRange | None
    span: Span
    unit: str | None = None
    value: Value | None = None


@dataclass(slots=True)
class Symbols:
    """The names of one model; a name is declared before its shape is known.

    ``limits`` say how large what they stand for may be.
    """

    limits: Limits
    declared: dict[str, Span] = field(default_factory=dict)
    known: dict[str, Symbol] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    doubled: set[str] = field(default_factory=set)

    def declare(self, name: str, span: Span) -> None:
        """Take a name.

        Raises
        ------
        ModelError
            NS103 if it is reserved, NS102 if it is taken.
        """
        first = self.declared.setdefault(name, span)
        check_free(name, span)
        if first is not span:
            self.doubled.add(name)
            raise ModelError(
                [
                    Diagnostic(
                        "NS102",
                        f"`{name}` is defined twice",
                        (
                            Label(span, "defined again here"),
                            Label(first, "first here"),
                        ),
                        help="rename one of them",
                    )
                ]
            )

    def define(self, symbol: Symbol) -> None:
        """Tell what a declared name stands for."""
        self.known[symbol.name] = symbol

    def find(self, name: str, span: Span, also: Iterable[str] = ()) -> Symbol:
        """Return what a name stands for; ``also`` are further names for suggestions.

        Raises
        ------
        ModelError
            NS101 if nobody declared it.
        PoisonedError
            If its declaration was refused.
        """
        symbol = self.known.get(name)
        if symbol is not None and name not in self.doubled:
            self.used.add(name)
            return symbol
        if name in self.declared:
            raise PoisonedError(name, span)
        near = _derivative(name, self.declared) or suggest(name, [*self.declared, *also])
        raise ModelError(
            [
                Diagnostic(
                    "NS101",
                    f"`{name}` is not defined",
                    (Label(span, "nothing has this name"),),
                    help=near or f"declare it, for example `parameter {name} = 1`",
                )
            ]
        )


_DERIVATIVE = re.compile(r"d_?(\w+?)(?:_?dt)?|(\w+?)_?(?:dot|der|prime)|dot_?(\w+)")


def _derivative(name: str, declared: Iterable[str]) -> str | None:
    """Return the way out for ``xdot``, and for the ``dx`` of ``dx/dt``."""
    match = _DERIVATIVE.fullmatch(name)
    of = next(filter(None, match.groups())) if match else None
    return f"a derivative is written `der({of})`" if of in set(declared) else None


def check_free(name: str, span: Span) -> None:
    """Refuse a name that the language keeps for itself.

    Raises
    ------
    ModelError
        NS103.
    """
    reason = _reserved(name)
    if reason is not None:
        raise ModelError(
            [
                Diagnostic(
                    "NS103",
                    f"`{name}` cannot be declared: {reason}",
                    (Label(span, "reserved"),),
                    help=f"choose another name, for example `{_FREE.get(name, f'my_{name}')}`",
                )
            ]
        )


_FREE = {"t": "time", "sgn": "sign", "dio": "contact", "der": "rate"}


def _reserved(name: str) -> str | None:
    if name == TIME:
        return "it is the time"
    if name == "pi":
        return "it is the number 3.14159..."
    if name in ARITY:
        return "it is a built-in function"
    if name[:3] in SET_VALUED and name[3:].isdecimal():
        return "names like it are given to set-valued terms that stand inline"
    return None


def _no_derivative(call: Call, scope: Scope) -> Value:
    raise refuse(
        "NS112",
        "`der` stands in a number that is known before a run",
        call.span,
        "nothing changes here",
        help="write the number; what changes in a run is a `let`",
    )


@dataclass(frozen=True, slots=True)
class Scope:
    """Where an expression stands: the names, indices and constants that it may read.

    ``derivative`` tells what ``der(...)`` is there.
    """

    symbols: Symbols
    indices: Mapping[str, IndexRange] = field(default_factory=dict)
    constants: bool = False
    derivative: Derivative = field(default=_no_derivative)

    def with_index(self, range: IndexRange | None) -> Scope:
        """Return the scope inside an index range."""
        if range is None:
            return self
        return replace(self, indices={**self.indices, range.variable: range})
