"""From expressions as written to scalar expressions: names, shapes, components, indices."""

from __future__ import annotations

import math
from dataclasses import replace

from nsode.diagnostics import ModelError, refuse
from nsode.expr import TIME, Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.inclusion.apply import apply
from nsode.inclusion.functions import SET_VALUED, check_call
from nsode.inclusion.indices import index, index_range
from nsode.inclusion.kinds import is_condition, number
from nsode.inclusion.report import PoisonedError
from nsode.inclusion.symbols import Scope, Symbol
from nsode.inclusion.values import (
    Shape,
    ShapeError,
    Value,
    describe,
    each,
    from_scalars,
    scalars,
    shape,
    suffixes,
)
from nsode.syntax.ast import Bracket, Component, Group, Reduction, Subscript

_FIELDS = {"x": 1, "y": 2, "z": 3}
#: The constants of an element, under one law or another, that initial values and settings
#: may read.
CONSTANTS = ("K", "alpha", "beta", "B", "D", "F0", "c", "n", "epsilon")


def elaborate(expr: Expr, scope: Scope) -> Value:
    """Return the value that an expression of the model stands for.

    Raises
    ------
    ModelError
        For unknown names and functions, wrong shapes, subscripts and arguments.
    """
    match expr:
        case Number():
            return expr
        case Name():
            return _name(expr, scope)
        case Group(inner):
            return elaborate(inner, scope)
        case Bracket(items):
            return _bracket(expr, items, scope)
        case Subscript():
            return _subscript(expr, scope)
        case Component():
            return _component(expr, scope)
        case If():
            return _if(expr, scope)
        case Reduction():
            return _reduction(expr, scope)
        case Call():
            return _call(expr, scope)
    raise NotImplementedError(f"no rule to elaborate {type(expr).__name__}")


def scalar(expr: Expr, scope: Scope, what: str) -> Expr:
    """Return the value of an expression that must be a scalar number.

    Raises
    ------
    ModelError
        NS105 or NS117 if it is not.
    """
    value = elaborate(expr, scope)
    if not isinstance(value, Expr):
        raise refuse(
            "NS105", f"{what} must be a scalar", expr.span, f"this is {describe(shape(value))}"
        )
    return number(value, what)


def condition(expr: Expr, scope: Scope) -> Expr:
    """Return the value of an expression that must be true or false.

    Raises
    ------
    ModelError
        NS117 if it is not.
    """
    value = elaborate(expr, scope)
    if not isinstance(value, Expr) or not is_condition(value):
        raise refuse(
            "NS117",
            "a condition must be true or false",
            expr.span,
            "this is a number" if isinstance(value, Expr) else f"this is {describe(shape(value))}",
            help="compare it, for example `... > 0`",
        )
    return value


def components(name: str, of: Shape, at: Index | None, span_of: Expr) -> Value:
    """Return the value of a name of some shape: one :class:`Name` for each component."""
    names = tuple(Name(name + suffix, at, span=span_of.span) for suffix in suffixes(of))
    return from_scalars(names, of)


def _name(expr: Name, scope: Scope) -> Value:
    if expr.id in {TIME, "pi"} and expr.id in scope.symbols.declared:
        raise PoisonedError(expr.id, expr.span)
    if expr.id == TIME:
        return expr
    if expr.id == "pi":
        return Number(math.pi, span=expr.span)
    if expr.id in scope.indices:
        return Index(expr.id, 0, span=expr.span)
    symbol = scope.symbols.find(expr.id, expr.span, also=scope.indices)
    if symbol.range is not None:
        raise _which_element(expr, symbol.range, scope)
    return _value(symbol, None, expr)


def _which_element(expr: Name, over: IndexRange, scope: Scope) -> ModelError:
    element = f"`{expr.id}[{over.variable}]` inside `for {over.variable} in ...` or `sum(...)`"
    if scope.indices:
        element = f"`{expr.id}[{next(iter(scope.indices))}]`"
    elif scope.constants:
        element = f"one element, such as `{expr.id}[{over.first}]`"
    return refuse(
        "NS105",
        f"`{expr.id}` is a family",
        expr.span,
        "which element is meant?",
        help=f"write {element}",
    )


def _value(symbol: Symbol, at: Index | None, expr: Expr) -> Value:
    if symbol.value is not None:
        return each(lambda part: replace(part, span=expr.span), symbol.value)
    return components(symbol.name, symbol.shape, at, expr)


def _bracket(expr: Expr, items: tuple[Expr, ...], scope: Scope) -> Value:
    found = [elaborate(item, scope) for item in items]
    if not found:
        raise refuse("NS105", "an empty bracket has no value", expr.span)
    if all(isinstance(item, Bracket) for item in items):
        if len({shape(value) for value in found}) > 1:
            raise refuse("NS105", "the rows of a matrix must have one length", expr.span)
        return tuple(found)
    for item, value in zip(items, found, strict=True):
        if len(shape(value)) > 1:
            raise refuse("NS105", "a matrix cannot stand in a vector", item.span)
    return tuple(number(part, "a component") for value in found for part in scalars(value))


def _subscript(expr: Subscript, scope: Scope) -> Value:
    if (
        isinstance(expr.base, Name)
        and expr.base.id not in scope.indices
        and (expr.base.id not in {TIME, "pi"})
    ):
        symbol = scope.symbols.find(expr.base.id, expr.base.span, also=scope.indices)
        if symbol.range is not None:
            return _value(symbol, index(expr.index, scope), expr)
    base = elaborate(expr.base, scope)
    at = index(expr.index, scope)
    if at.variable is not None:
        raise refuse(
            "NS109",
            f"an index of a family cannot choose a component of {describe(shape(base))}",
            expr.index.span,
            help="declare a family: `state x[i in 1..3] = ...`",
        )
    return _pick(base, at.offset, expr)


def _pick(base: Value, k: int, expr: Expr) -> Value:
    if isinstance(base, Expr):
        raise refuse("NS105", "a scalar has no components", expr.span, "this is a scalar")
    if not 1 <= k <= len(base):
        raise refuse(
            "NS109",
            f"there is no component {k}",
            expr.span,
            f"this is {describe(shape(base))}, counted from 1",
        )
    return base[k - 1]


def _component(expr: Component, scope: Scope) -> Value:
    if isinstance(expr.base, Name) and expr.field in CONSTANTS:
        symbol = scope.symbols.find(expr.base.id, expr.base.span, also=scope.indices)
        if symbol.kind == "force" and scope.constants:
            return Name(f"{expr.base.id}.{expr.field}", span=expr.span)
    base = elaborate(expr.base, scope)
    k = _FIELDS.get(expr.field)
    if k is None or isinstance(base, Expr) or len(shape(base)) != 1 or not k <= len(base) <= 3:
        what = describe(shape(base))
        help = "a vector of 2 or 3 has `.x .y .z`"
        if isinstance(base, tuple) and len(base) > 3:
            help = "write `[1]` to `[" + str(len(base)) + "]`; quaternions have the scalar first"
        raise refuse(
            "NS105",
            f"there is no component `.{expr.field}`",
            expr.span,
            f"this is {what}",
            help=help,
        )
    part = base[k - 1]
    return replace(part, span=expr.span) if isinstance(part, Name) else part


def _if(expr: If, scope: Scope) -> Value:
    test = condition(expr.condition, scope)
    then, otherwise = elaborate(expr.then, scope), elaborate(expr.otherwise, scope)
    if shape(then) != shape(otherwise):
        raise refuse(
            "NS105",
            "both branches of an `if` must have one shape",
            expr.otherwise.span,
            f"{describe(shape(otherwise))}, but the first branch is {describe(shape(then))}",
        )
    pairs = zip(scalars(then), scalars(otherwise), strict=True)
    return from_scalars(
        tuple(If(test, number(a), number(b), span=expr.span) for a, b in pairs), shape(then)
    )


def _reduction(expr: Reduction, scope: Scope) -> Value:
    over = index_range(expr.range, scope)
    assert over is not None
    body = elaborate(expr.body, scope.with_index(over))
    return each(lambda part: Sum(over, number(part), span=expr.span), body)


def _call(expr: Call, scope: Scope) -> Value:
    check_call(expr)
    if expr.function == "der":
        return scope.derivative(expr, scope)
    if expr.function in SET_VALUED:
        raise refuse(
            "NS111",
            f"`{expr.function}` has no single value here",
            expr.span,
            "a set-valued term",
            help="set-valued terms stand in equations, `let`, `force` and `output`",
        )
    args = tuple(elaborate(arg, scope) for arg in expr.args)
    try:
        return apply(expr, args)
    except ShapeError as error:
        raise refuse("NS105", str(error), expr.span) from None
