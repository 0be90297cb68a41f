"""Which factors of a product are chi: read off the text, before anything is multiplied out.

chi is the innermost unbracketed product that holds sgn: everything to its left,
divisions included, and each ``*`` factor to its right up to the first ``/``. In algebra
``F*sgn(v)/M`` and ``F/M*sgn(v)`` are one product; in the paper, two friction laws.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from nsode.expr import Call, Expr, Number
from nsode.source import Span
from nsode.syntax.ast import Component, Group, Subscript


class Item(NamedTuple):
    """A factor and the operator in front of it, none for the first."""

    operator: str
    operand: Expr


class Friction(NamedTuple):
    """``chi*sgn(theta)`` in a product.

    ``written`` is where chi stands, left and right of sgn; ``taken`` are components taken of
    it, ``sign`` what its signs amount to, ``behind`` the factors that are no part of chi.
    """

    sgn: Call
    chi: Expr
    written: tuple[Span, ...]
    taken: Sequence[Component | Subscript]
    sign: int
    behind: Sequence[Item]
    span: Span


def flatten(expr: Expr) -> list[Item]:
    """Return the factors of an unbracketed product from left to right."""
    items: list[Item] = []
    while isinstance(expr, Call) and expr.function in {"*", "/"}:
        left, right = expr.args
        items.append(Item(expr.function, right))
        expr = left
    items.append(Item("", expr))
    return items[::-1]


def fold(items: Sequence[Item]) -> Expr:
    """Return the product of factors."""
    result = items[0].operand
    for operator, operand in items[1:]:
        result = Call(operator, (result, operand), span=result.span.to(operand.span))
    return result


def friction(items: Sequence[Item]) -> Friction | None:
    """Return the first ``chi*sgn(theta)`` among the factors of a product."""
    for at, (operator, operand) in enumerate(items):
        found = None if operator == "/" else _sgn(operand)
        if found is not None:
            return _around(items, at, *found)
    return None


def _around(
    items: Sequence[Item], at: int, sgn: Call, taken: Sequence[Component | Subscript], sign: int
) -> Friction:
    end = at + 1
    while end < len(items) and items[end].operator == "*":
        end += 1
    factors: list[Item] = []
    for operator, operand in (*items[:at], *items[at + 1 : end]):
        stripped, negative = _strip(operand)
        factors.append(Item(operator, stripped))
        sign *= negative
    chi = fold(factors) if factors else Number(1.0, span=sgn.span)
    span = items[0].operand.span.to(items[end - 1].operand.span)
    written = tuple(_place(part) for part in (items[:at], items[at + 1 : end]) if part)
    return Friction(sgn, chi, written, taken, sign, items[end:], span)


def _place(factors: Sequence[Item]) -> Span:
    """Return where factors stand, without the signs in front of them."""
    first = factors[0].operand
    while isinstance(first, Call) and first.function == "neg":
        first = first.args[0]
    return first.span.to(factors[-1].operand.span)


def is_sgn(expr: Expr) -> bool:
    """Tell whether an expression is a sgn, but for its sign and components taken of it."""
    return _sgn(expr) is not None


def _sgn(expr: Expr) -> tuple[Call, Sequence[Component | Subscript], int] | None:
    """Return the sgn that a factor is, the components taken of it, innermost first, its sign."""
    taken: list[Component | Subscript] = []
    sign = 1
    while True:
        match expr:
            case Call("neg", (inner,)):
                sign = -sign
                expr = inner
            case Component(base) | Subscript(base):
                taken.append(expr)
                expr = base
            case Call("sgn", _):
                return expr, taken[::-1], sign
            case _:
                return None


def _strip(expr: Expr) -> tuple[Expr, int]:
    """Return a factor without the signs in front of it, and what they amount to."""
    sign = 1
    while True:
        match expr:
            case Call("neg", (inner,)) | Group(Call("neg", (inner,))):
                expr, sign = inner, -sign
            case _:
                return expr, sign
