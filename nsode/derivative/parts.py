"""Arguments of nonlinear functions under names of their own, so that slopes stay short.

The slope of ``f(g(h(x)))`` reads ``g(h(x))`` and ``h(x)`` again; named once, they cost a word.
Branches of an ``if`` and bodies of sums are left alone: a dead branch must not be computed,
and a body has an index that no definition has.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice

from nsode.expr import Call, Expr, If, Index, Name, Number, Sum, rebuild, walk

_SMALL = 3  # nodes of an argument that is not worth a name
_LINEAR = frozenset({"+", "neg"})


def with_parts(expr: Expr, named: Callable[[Expr], Name], varies: Callable[[Expr], bool]) -> Expr:
    """Return ``expr`` with its larger arguments replaced by what ``named`` calls them.

    A factor beside a constant needs no name, since no slope reads it; ``varies`` tells
    what is no constant.
    """
    match expr:
        case Call(function, args):
            inner = rebuild(expr, lambda child: with_parts(child, named, varies))
            if function in _LINEAR or _is_scaled(function, args, varies):
                return inner
            return rebuild(inner, lambda child: child if is_small(child, _SMALL) else named(child))
        case Number() | Index() | Name() | If() | Sum():
            return expr
        case _:
            raise NotImplementedError(f"no parts of {type(expr).__name__}")


def _is_scaled(function: str, args: tuple[Expr, ...], varies: Callable[[Expr], bool]) -> bool:
    match function:
        case "*":
            return not all(varies(arg) for arg in args)
        case "/":
            return not varies(args[1])
    return False


def is_small(expr: Expr, most: int) -> bool:
    """Return whether an expression has so few nodes that a name would not shorten it."""
    if isinstance(expr, If | Sum):
        return False
    return sum(1 for _ in islice(walk(expr), most + 1)) <= most
