"""Expressions as Python text over NumPy: scalars plain, families as slices.

Inside families each open index range is an axis of an array, the outermost first.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isfinite, isnan
from typing import NamedTuple

from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum


@dataclass(frozen=True, slots=True)
class Environment:
    """What names mean: their spelling, and the whole range of each family.

    ``axes`` are the ranges of the open indices; ``fixed`` gives indices of one value.
    """

    spelling: Mapping[str, str]
    ranges: Mapping[str, IndexRange | None]
    axes: tuple[IndexRange, ...] = ()
    fixed: Mapping[str, int] | None = None

    def inside(self, range: IndexRange) -> Environment:
        """Return the environment within one more range; the index may hide an outer one."""
        kept = {k: v for k, v in (self.fixed or {}).items() if k != range.variable}
        if len(range) == 1 and not self.axes:
            return replace(self, fixed={**kept, range.variable: range.first})
        return replace(self, axes=(*self.axes, range), fixed=kept)

    def axis(self, variable: str) -> int | None:
        """Return the innermost axis of an index variable."""
        for position in reversed(range(len(self.axes))):
            if self.axes[position].variable == variable:
                return position
        return None


class Text(NamedTuple):
    """Python text with how tightly it binds."""

    text: str
    level: int


_IF, _OR, _AND, _NOT, _COMPARE, _SUM, _PRODUCT, _SIGN, _POWER, _ATOM = range(10)

#: Terms beyond which a sum is a call: Python's compiler recurses over operators.
_LONGEST = 50

_CALLS = {
    **{name: f"np.{name}" for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "abs")},
    **{name: f"np.{name}" for name in ("sinh", "cosh", "tanh")},
    **{name: f"np.arc{name[1:]}" for name in ("asin", "acos", "atan", "atan2")},
    **{"max": "np.maximum", "min": "np.minimum", "mod": "np.mod"},
    **{name: name for name in ("norm", "sat", "shrink")},
}


def lower(expr: Expr, env: Environment) -> str:
    """Return an expression as Python text."""
    return _lower(expr, env).text


def _lower(expr: Expr, env: Environment) -> Text:
    match expr:
        case Number(value):
            return _number(value)
        case Index():
            return _index(expr, env)
        case Name(id, at):
            return Text(env.spelling[id] + _subscript(id, at, env), _ATOM)
        case Call(function, args):
            return _call(function, args, env)
        case If(condition, then, otherwise):
            return _if(condition, then, otherwise, env)
        case Sum():
            return _sum(expr, env)
    raise NotImplementedError(f"no NumPy rule for {type(expr).__name__}")


def _number(value: float) -> Text:
    if isnan(value):
        return Text("np.nan", _ATOM)
    text = repr(float(value)) if isfinite(value) else "np.inf" if value > 0 else "-np.inf"
    return Text(text, _SIGN if text.startswith("-") else _ATOM)


def _index(index: Index, env: Environment) -> Text:
    """Return the number that an index stands for, or all of its numbers."""
    if index.variable is None:
        return _number(float(index.offset))
    axis = env.axis(index.variable)
    if axis is None:
        return _number(float((env.fixed or {})[index.variable] + index.offset))
    first, last = env.axes[axis].first + index.offset, env.axes[axis].last + index.offset
    inner = ", None" * (len(env.axes) - 1 - axis)
    return Text(f"indices({first}, {last})" + (f"[:{inner}]" if inner else ""), _ATOM)


def _subscript(id: str, at: Index | None, env: Environment) -> str:
    whole = env.ranges[id]
    if at is None or whole is None:
        return ""
    start = at.offset - whole.first
    if at.variable is None:
        return f"[{start}]"
    axis = env.axis(at.variable)
    if axis is None:
        return f"[{start + (env.fixed or {})[at.variable]}]"
    over = env.axes[axis]
    inner = ", None" * (len(env.axes) - 1 - axis)
    if start + over.first == 0 and len(over) == len(whole):
        return f"[:{inner}]" if inner else ""
    return f"[{start + over.first}:{start + over.last + 1}{inner}]"


def _call(function: str, args: tuple[Expr, ...], env: Environment) -> Text:
    parts = [_lower(arg, env) for arg in args]
    if _may_raise(function, args):
        parts[0] = Text(f"real({parts[0].text})", _ATOM)
    match function:
        case "+" if len(parts) > _LONGEST:
            return Text(f"add({', '.join(part.text for part in parts)})", _ATOM)
        case "+":
            return Text(_terms(args, parts), _SUM)
        case "neg":
            return _negated(parts[0])
        case "*" | "/":
            left, right = _at_least(parts[0], _PRODUCT), _at_least(parts[1], _SIGN)
            return Text(f"{left} {function} {right}", _PRODUCT)
        case "^":
            return Text(f"{_at_least(parts[0], _ATOM)}**{_exponent(args[1], parts[1])}", _POWER)
        case "<" | "<=" | ">" | ">=" | "==" | "!=":
            left, right = _at_least(parts[0], _SUM), _at_least(parts[1], _SUM)
            return Text(f"{left} {function} {right}", _COMPARE)
        case "and" | "or" | "not":
            return _logic(function, parts, arrays=bool(env.axes))
        case _:
            return Text(f"{_CALLS[function]}({', '.join(part.text for part in parts)})", _ATOM)


def _may_raise(function: str, args: tuple[Expr, ...]) -> bool:
    """Whether Python's own numbers meet, and raise where IEEE arithmetic gives inf or NaN."""
    match function, args:
        case "/", (_, Number(divisor)) if divisor:
            return False
        case (("/" | "^"), _):
            return all(map(may_be_plain, args))
        case _:
            return False


def may_be_plain(expr: Expr) -> bool:
    """Whether the text of an expression can give a number of Python's own."""
    match expr:
        case Number() | Index():
            return True
        case Call("neg" | "+" | "*" | "/" as function, args):
            return all(map(may_be_plain, args)) and not _may_raise(function, args)
        case If(_, then, otherwise):
            return may_be_plain(then) or may_be_plain(otherwise)
        case _:
            return False


def _negated(part: Text) -> Text:
    if part.level in {_SIGN, _PRODUCT} and part.text.startswith("-"):
        return Text(part.text[1:], _PRODUCT)
    return Text(f"-{_at_least(part, _PRODUCT)}", _PRODUCT if part.level == _PRODUCT else _SIGN)


def _at_least(part: Text, level: int) -> str:
    return part.text if part.level >= level else f"({part.text})"


def _terms(args: tuple[Expr, ...], parts: list[Text]) -> str:
    pieces = [_at_least(parts[0], _SUM)]
    for arg, part in zip(args[1:], parts[1:], strict=True):
        text = _at_least(part, _PRODUCT)
        negative = isinstance(arg, Call) and arg.function == "neg"
        if text.startswith("-") and (negative or isinstance(arg, Number)):
            pieces.append(f"- {text[1:]}")
        else:
            pieces.append(f"+ {text}")
    return " ".join(pieces)


def _exponent(expr: Expr, part: Text) -> str:
    if isinstance(expr, Number) and expr.value.is_integer() and abs(expr.value) < 1e4:
        return f"{expr.value:.0f}" if expr.value >= 0 else f"({expr.value:.0f})"
    return _at_least(part, _POWER)


def _logic(function: str, parts: list[Text], *, arrays: bool) -> Text:
    if arrays:
        return Text(f"np.logical_{function}({', '.join(part.text for part in parts)})", _ATOM)
    match function:
        case "not":
            return Text(f"not {_at_least(parts[0], _NOT)}", _NOT)
        case "and":
            return Text(" and ".join(_at_least(part, _NOT) for part in parts), _AND)
        case _:
            return Text(" or ".join(_at_least(part, _AND) for part in parts), _OR)


def _if(condition: Expr, then: Expr, otherwise: Expr, env: Environment) -> Text:
    c, a, b = (_lower(part, env) for part in (condition, then, otherwise))
    if env.axes:
        return Text(f"np.where({c.text}, {a.text}, {b.text})", _ATOM)
    return Text(f"{_at_least(a, _OR)} if {_at_least(c, _OR)} else {b.text}", _IF)


def _sum(expr: Sum, env: Environment) -> Text:
    if not len(expr.range):
        return Text("real(0.0)", _ATOM)
    inner = replace(env, axes=(*env.axes, expr.range))
    return Text(f"total({lower(expr.body, inner)}, {len(expr.range)})", _ATOM)


def depends_on_index(expr: Expr, variable: str) -> bool:
    """Whether the value of an expression changes with an index."""
    match expr:
        case Index(name):
            return name == variable
        case Name(_, Index(name)):
            return name == variable
        case Call(_, args):
            return any(depends_on_index(arg, variable) for arg in args)
        case If(condition, then, otherwise):
            return any(depends_on_index(part, variable) for part in (condition, then, otherwise))
        case Sum(range, body):
            return range.variable != variable and depends_on_index(body, variable)
        case _:
            return False
