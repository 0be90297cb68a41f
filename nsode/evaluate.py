"""The value of an expression at given values of its names, in IEEE arithmetic."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping

from nsode.expr import Call, Expr, If, Index, Name, Number, Sum

#: Gives the value of a name; the second argument is the element of a family, or None.
Lookup = Callable[[str, int | None], float]


def evaluate(expr: Expr, lookup: Lookup, indices: Mapping[str, int] | None = None) -> float:
    """Return the value of a scalar expression; conditions are 1.0 or 0.0.

    Division by zero and arguments outside a function's domain give infinities and
    NaN, as the generated code does. Trees that share parts, as derivatives do, cost
    what their parts cost once.
    """
    return _value(expr, lookup, indices or {}, {})


def _value(expr: Expr, lookup: Lookup, at: Mapping[str, int], shared: dict[int, float]) -> float:
    match expr:
        case Number(value):
            return value
        case Index():
            return float(position(expr, at))
        case Name(name, subscript):
            return lookup(name, None if subscript is None else position(subscript, at))
    known = shared.get(id(expr))
    if known is None:
        known = shared[id(expr)] = _compound(expr, lookup, at, shared)
    return known


def _compound(expr: Expr, lookup: Lookup, at: Mapping[str, int], shared: dict[int, float]) -> float:
    match expr:
        case Call(function, args):
            return apply(function, *[_value(arg, lookup, at, shared) for arg in args])
        case If(condition, then, otherwise):
            chosen = then if _value(condition, lookup, at, shared) else otherwise
            return _value(chosen, lookup, at, shared)
        case Sum(over, body):  # no pattern on the range: its length is not that of a tuple
            variable, first, last = over
            total = 0.0
            for k in range(first, last + 1):
                total += _value(body, lookup, {**at, variable: k}, {})
            return total
    raise NotImplementedError(f"no value for {type(expr).__name__}")


def position(index: Index, indices: Mapping[str, int]) -> int:
    """Return the integer that an index stands for."""
    return index.offset if index.variable is None else indices[index.variable] + index.offset


def apply(function: str, *args: float) -> float:
    """Return a function of :data:`nsode.expr.FUNCTIONS` applied to numbers."""
    try:
        return float(_RULES[function](*args))
    except (ValueError, ZeroDivisionError):
        return math.nan
    except OverflowError:
        return math.inf


def _add(*terms: float) -> float:
    total = terms[0]
    for term in terms[1:]:
        total += term
    return total


def _divide(a: float, b: float) -> float:
    if b != 0:
        return a / b
    if a == 0 or math.isnan(a):
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, b)


def _max(a: float, b: float) -> float:
    return a if a > b else b if b >= a else a + b


def _log(a: float) -> float:
    return -math.inf if a == 0 else math.log(a)


def _power(a: float, b: float) -> float:
    if a == 0 and b < 0:
        return math.inf
    try:
        return math.pow(a, b)
    except OverflowError:
        return -math.inf if a < 0 and b % 2 == 1 else math.inf


def _sinh(a: float) -> float:
    try:
        return math.sinh(a)
    except OverflowError:
        return math.copysign(math.inf, a)


def _mod(a: float, b: float) -> float:
    return math.nan if b == 0 else a % b


def _sat(level: float, x: float) -> float:
    if abs(x) <= level:
        return x
    return level if x > 0 else -level if x < 0 else x + level


def _shrink(level: float, n: float) -> float:
    return 1.0 if n < level else level / n if n > 0 else level + n


_RULES: dict[str, Callable[..., float]] = {
    "+": _add,
    "neg": operator.neg,
    "*": operator.mul,
    "/": _divide,
    "^": _power,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
    "and": lambda *args: all(args),
    "or": lambda *args: any(args),
    "not": operator.not_,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": _log,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "atan2": math.atan2,
    "sinh": _sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "abs": abs,
    "min": lambda a, b: -_max(-a, -b),
    "max": _max,
    "mod": _mod,
    "norm": lambda *args: math.sqrt(sum(a * a for a in args)),
    "sat": _sat,
    "shrink": _shrink,
}
