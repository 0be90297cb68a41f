"""Functions and operators applied to numbers, vectors and matrices."""

from __future__ import annotations

from dataclasses import replace
from functools import reduce

from nsode.diagnostics import refuse
from nsode.expr import Call, Expr, negate
from nsode.inclusion import values
from nsode.inclusion.kinds import is_condition, number
from nsode.inclusion.values import ShapeError, Value, describe, each, is_zero, shape


def apply(expr: Call, args: tuple[Value, ...]) -> Value:
    """Return what a call stands for, whose arguments are right in number.

    Raises
    ------
    ModelError
        NS105 and NS117 for arguments of another shape or kind.
    ShapeError
        For vectors and matrices that do not fit.
    """
    match expr.function, args:
        case "+", _:
            result = values.plus(tuple(each(number, arg) for arg in args))
            return replace(result, span=expr.span) if isinstance(result, Expr) else result
        case "neg", (inner,):
            return each(lambda part: replace(negate(number(part)), span=expr.span), inner)
        case "*", (left, right):
            result = values.times(each(number, left), each(number, right))
            return replace(result, span=expr.span) if isinstance(result, Expr) else result
        case "/", (left, right):
            return _quotient(expr, left, right)
        case "dot", (left, right):
            return values.dot(left, right)
        case "cross", (left, right):
            return values.cross(left, right)
        case "qmul", (left, right):
            return values.qmul(left, right)
        case "transpose", (inner,):
            return values.transpose(inner)
        case "norm", (inner,):
            return values.norm(inner)
    return _scalar_function(expr, args)


def _quotient(expr: Call, left: Value, right: Value) -> Value:
    if not isinstance(right, Expr):
        raise ShapeError("only a scalar can divide")
    divisor = number(right)
    if isinstance(left, Expr):
        return Call("/", (number(left), divisor), span=expr.span)

    def divided(part: Expr) -> Expr:
        return part if is_zero(part) else Call("/", (number(part), divisor), span=expr.span)

    return each(divided, left)


def _scalar_function(expr: Call, args: tuple[Value, ...]) -> Expr:
    flat = [
        _argument(expr.function, arg, written) for arg, written in zip(args, expr.args, strict=True)
    ]
    if expr.function in {"min", "max"}:
        return reduce(lambda a, b: Call(expr.function, (a, b), span=expr.span), flat)
    return Call(expr.function, tuple(flat), span=expr.span)


def _argument(function: str, arg: Value, written: Expr) -> Expr:
    if not isinstance(arg, Expr):
        what = f"this is {describe(shape(arg))}"
        way_out = None if function.isalpha() else "compare components, or `norm(...)`"
        raise refuse("NS105", f"`{function}` takes scalars", written.span, what, help=way_out)
    if function not in {"and", "or", "not"}:
        return number(arg, f"an argument of `{function}`")
    if not is_condition(arg):
        raise refuse("NS117", f"`{function}` takes conditions", written.span, "this is a number")
    return arg
