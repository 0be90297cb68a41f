"""Equations as scalar rows: linear in ``der()``, with the rest on the right."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain, count

from nsode.diagnostics import refuse
from nsode.expr import (
    Call,
    Expr,
    If,
    Index,
    IndexRange,
    Name,
    Number,
    Sum,
    add,
    divide,
    multiply,
    names,
    negate,
    rebuild,
    walk,
)
from nsode.inclusion.values import total
from nsode.ode import RATE_SUFFIX
from nsode.source import Span

#: ``der(x)`` is the name ``x.rate`` until its equation is solved, and behind it where read.
Unknown = Name


def derivative_name(state: str) -> str:
    """Return the internal name of the rate of a state."""
    return f"{state}{RATE_SUFFIX}"


def state_of(unknown: Unknown) -> str:
    """Return the name of the state whose derivative this is."""
    return unknown.id.removesuffix(".rate")


@dataclass(frozen=True, slots=True)
class Row:
    """``sum of coefficient*unknown = right``, one scalar equation."""

    coefficients: tuple[tuple[Unknown, Expr], ...]
    right: Expr
    range: IndexRange | None
    span: Span

    @property
    def unknowns(self) -> tuple[Unknown, ...]:
        """The derivatives that it holds."""
        return tuple(unknown for unknown, _ in self.coefficients)

    def changed(self, change: Callable[[Expr], Expr], range: IndexRange) -> Row:
        """Return the row over another range, with every expression changed."""
        moved = ((change(unknown), change(c)) for unknown, c in self.coefficients)
        coefficients = tuple((u, c) for u, c in moved if isinstance(u, Name))
        return Row(coefficients, change(self.right), range, self.span)


def row(left: Expr, right: Expr, range: IndexRange | None, span: Span) -> Row:
    """Return an equation with its derivatives on the left and the rest on the right.

    Raises
    ------
    ModelError
        NS112 if a derivative does not appear linearly, or if there is none.
    """
    on_left, left_rest = _linear(left)
    on_right, right_rest = _linear(right)
    if not on_left:
        on_left, on_right = on_right, on_left
        left_rest, right_rest = right_rest, left_rest
    for unknown, coefficient in on_right.items():
        on_left[unknown] = _joined(on_left.get(unknown), negate(coefficient))
    rest = right_rest if right_rest is not None else Number(0.0, span=right.span)
    if left_rest is not None:
        rest = total((rest, negate(left_rest)))
    found = Row(tuple(on_left.items()), rest, range, span)
    if not found.coefficients:
        raise refuse(
            "NS112",
            "an equation says what `der(...)` of some state is",
            span,
            "there is no `der` here",
            help="write `let` for a quantity that is no state",
        )
    return aligned(found)


def _joined(first: Expr | None, second: Expr) -> Expr:
    return second if first is None else add(first, second)


def _linear(expr: Expr) -> tuple[dict[Unknown, Expr], Expr | None]:
    """Return the coefficients of the derivatives in ``expr`` and what is left."""
    if not any(is_unknown(name) for name in names(expr)):
        return {}, expr
    match expr:
        case Name():
            return {expr: Number(1.0, span=expr.span)}, None
        case Call("neg", (inner,)):
            found, rest = _linear(inner)
            return {u: negate(c) for u, c in found.items()}, None if rest is None else negate(rest)
        case Call("+", terms):
            return _linear_sum(terms)
        case Call("*", (left, right)):
            a, b = _linear(left), _linear(right)
            if not a[0]:
                return _scaled(b, lambda part: scaled_by(left, part))
            if not b[0]:
                return _scaled(a, lambda part: scaled_by(part, right))
        case Call("/", (left, right)):
            if not _linear(right)[0]:
                return _scaled(_linear(left), lambda part: divide(part, right))
    culprit = next(name for name in names(expr) if is_unknown(name))
    raise refuse(
        "NS112",
        "an equation must be linear in `der(...)`",
        culprit.span,
        f"inside {_surroundings(expr)}",
        help="solve the equation for the derivative by hand, or name what it equals with `let`",
    )


def _surroundings(expr: Expr) -> str:
    match expr:
        case Sum():
            return "a `sum`"
        case If():
            return "an `if`"
        case Call("*", _):
            return "a product of derivatives"
        case Call("/", _):
            return "a divisor"
        case Call("^", _):
            return "a power"
        case Call(function, _) if function.isalpha():
            return f"`{function}`"
    return "a condition"


def _linear_sum(terms: Sequence[Expr]) -> tuple[dict[Unknown, Expr], Expr | None]:
    found: dict[Unknown, Expr] = {}
    rests: list[Expr] = []
    for term in terms:
        coefficients, rest = _linear(term)
        for unknown, coefficient in coefficients.items():
            found[unknown] = _joined(found.get(unknown), coefficient)
        if rest is not None:
            rests.append(rest)
    return found, add(*rests) if rests else None


def _scaled(
    part: tuple[dict[Unknown, Expr], Expr | None], change: Callable[[Expr], Expr]
) -> tuple[dict[Unknown, Expr], Expr | None]:
    found, rest = part
    return {u: change(c) for u, c in found.items()}, None if rest is None else change(rest)


def scaled_by(left: Expr, right: Expr) -> Expr:
    """Return ``left*right``, a factor of one left out."""
    if isinstance(right, Number) and right.value == 1.0:
        return left
    if isinstance(left, Number) and left.value == 1.0:
        return right
    return multiply(left, right)


def is_unknown(name: Name) -> bool:
    """Tell whether a name stands for a derivative."""
    return name.id.endswith(".rate")


def aligned(found: Row) -> Row:
    """Move the index of a family's row so that it is the index of its first unknown."""
    at = found.unknowns[0].at
    if found.range is None or at is None or at.variable is None or at.offset == 0:
        return found
    variable, by = found.range.variable, -at.offset
    moved = IndexRange(variable, found.range.first - by, found.range.last - by)

    def move(expr: Expr) -> Expr:
        return shifted(expr, variable, by)

    return found.changed(move, moved)


def shifted(expr: Expr, variable: str, by: int) -> Expr:
    """Return ``expr`` with ``variable + by`` in the place of ``variable``."""
    match expr:
        case Index(name, offset) if name == variable:
            return replace(expr, offset=offset + by)
        case Name(_, Index(name, offset) as at) if name == variable:
            return replace(expr, at=replace(at, offset=offset + by))
    return rebuild(expr, lambda part: shifted(part, variable, by))


def reindexed(expr: Expr, old: str, new: str) -> Expr:
    """Return ``expr`` with the index ``new`` in the place of ``old``."""
    match expr:
        case Index(name) if name == old:
            return replace(expr, variable=new)
        case Name(_, Index(name) as at) if name == old:
            return replace(expr, at=replace(at, variable=new))
    return rebuild(expr, lambda part: reindexed(part, old, new))


def free_index(wanted: str, exprs: Iterable[Expr]) -> str:
    """Return a name for an index that no sum in ``exprs`` uses, ``wanted`` if possible."""
    taken = {node.range.variable for e in exprs for node in walk(e) if isinstance(node, Sum)}
    candidates = chain([wanted], (f"{wanted}{k}" for k in count(1)))
    return next(name for name in candidates if name not in taken)
