"""The one expression language of nsode, from the parser to the backends.

An expression is an immutable tree. Each node knows the span of the text that it
came from; the span is never part of equality. After stage 2 every expression is
scalar: names are those of parameters, states, inputs, bindings and ``t``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from operator import is_
from typing import NamedTuple

from nsode.source import NOWHERE, Span


@dataclass(frozen=True, slots=True)
class Expr:
    """A node of an expression."""

    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Number(Expr):
    """A literal, in SI units."""

    value: float


@dataclass(frozen=True, slots=True)
class Index(Expr):
    """``variable + offset``, or the constant ``offset`` where ``variable`` is None.

    As a subscript it selects an element of a family; elsewhere it is that number.
    """

    variable: str | None
    offset: int = 0


@dataclass(frozen=True, slots=True)
class Name(Expr):
    """A named value; ``at`` selects the element when the name is a family."""

    id: str
    at: Index | None = None


@dataclass(frozen=True, slots=True)
class Call(Expr):
    """An operator or a function applied to its arguments (see :data:`FUNCTIONS`)."""

    function: str
    args: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class If(Expr):
    """``if condition then then else otherwise``; only the chosen branch counts."""

    condition: Expr
    then: Expr
    otherwise: Expr


class IndexRange(NamedTuple):
    """The integers ``first..last``, both included, under the name ``variable``."""

    variable: str
    first: int
    last: int

    def __len__(self) -> int:
        """Return how many integers there are; an empty range is empty."""
        return max(0, self.last - self.first + 1)

    def __bool__(self) -> bool:
        """Return True: an empty range is still a range, which None is not."""
        return True


@dataclass(frozen=True, slots=True)
class Sum(Expr):
    """The sum of ``body`` over ``range``, in rising order of the index."""

    range: IndexRange
    body: Expr


class Function(NamedTuple):
    """What is known about a function: ``arity`` None means one or more arguments."""

    arity: int | None
    boolean: bool = False
    continuous: bool = True


#: Operators and functions of scalar expressions. ``+`` takes two or more terms and
#: adds from the left; there is no minus: ``a - b`` is ``+(a, neg(b))``. ``max`` and
#: ``min`` take two. ``norm`` takes the components of its vector.
#: ``sat(Z, x)`` is the paper's (2) in one dimension; in more, ``shrink(Z, n)`` is the
#: factor ``min(1, Z/n)`` by which ``sat`` shortens a vector of norm ``n``, 0 where both
#: are 0: the vector is 0 then, and its product flat.
FUNCTIONS: dict[str, Function] = {
    "+": Function(None),
    "neg": Function(1),
    "*": Function(2),
    "/": Function(2),
    "^": Function(2),
    "<": Function(2, boolean=True, continuous=False),
    "<=": Function(2, boolean=True, continuous=False),
    ">": Function(2, boolean=True, continuous=False),
    ">=": Function(2, boolean=True, continuous=False),
    "==": Function(2, boolean=True, continuous=False),
    "!=": Function(2, boolean=True, continuous=False),
    "and": Function(2, boolean=True, continuous=False),
    "or": Function(2, boolean=True, continuous=False),
    "not": Function(1, boolean=True, continuous=False),
    "sqrt": Function(1),
    "exp": Function(1),
    "log": Function(1),
    "sin": Function(1),
    "cos": Function(1),
    "tan": Function(1),
    "asin": Function(1),
    "acos": Function(1),
    "atan": Function(1),
    "atan2": Function(2),
    "sinh": Function(1),
    "cosh": Function(1),
    "tanh": Function(1),
    "abs": Function(1),
    "min": Function(2),
    "max": Function(2),
    "mod": Function(2, continuous=False),
    "norm": Function(None),
    "sat": Function(2),
    "shrink": Function(2),
}

TIME = "t"


def children(expr: Expr) -> tuple[Expr, ...]:
    """Return the expressions directly inside ``expr`` (subscripts excluded)."""
    match expr:
        case Call():
            return expr.args
        case If():
            return (expr.condition, expr.then, expr.otherwise)
        case Sum():
            return (expr.body,)
        case _:
            return ()


def walk(expr: Expr) -> Iterator[Expr]:
    """Yield ``expr`` and every expression inside it, parents first."""
    stack = [expr]
    while stack:
        node = stack.pop()
        yield node
        stack += children(node)[::-1]


def names(expr: Expr) -> Iterator[Name]:
    """Yield each use of a name in ``expr``."""
    stack = [expr]
    while stack:
        node = stack.pop()
        if isinstance(node, Name):
            yield node
        else:
            stack += children(node)[::-1]


def rebuild(expr: Expr, change: Callable[[Expr], Expr]) -> Expr:
    """Return ``expr`` with ``change`` applied to each direct child; itself if none changed."""
    match expr:
        case Call(function, args):
            changed = tuple([change(arg) for arg in args])
            same = all(map(is_, changed, args))
            return expr if same else Call(function, changed, span=expr.span)
        case If(condition, then, otherwise):
            c, a, b = change(condition), change(then), change(otherwise)
            if c is condition and a is then and b is otherwise:
                return expr
            return If(c, a, b, span=expr.span)
        case Sum(range, body):
            inner = change(body)
            return expr if inner is body else Sum(range, inner, span=expr.span)
        case _:
            return expr


def add(*terms: Expr) -> Expr:
    """Return the sum of one or more terms, spanning them all."""
    if len(terms) == 1:
        return terms[0]
    return Call("+", terms, span=terms[0].span)


def subtract(left: Expr, right: Expr) -> Expr:
    """Return ``left - right``."""
    return Call("+", (left, negate(right)), span=left.span)


def multiply(left: Expr, right: Expr) -> Expr:
    """Return ``left*right``."""
    return Call("*", (left, right), span=left.span)


def divide(left: Expr, right: Expr) -> Expr:
    """Return ``left/right``."""
    return Call("/", (left, right), span=left.span)


def negate(expr: Expr) -> Expr:
    """Return ``-expr``; a double minus cancels."""
    match expr:
        case Call("neg", (inner,)):
            return inner
        case Number(value):
            return Number(-value, span=expr.span)
        case _:
            return Call("neg", (expr,), span=expr.span)
