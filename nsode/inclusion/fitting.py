"""Declared shapes, and the value of each element of a family: a formula or a list."""

from __future__ import annotations

from collections.abc import Sequence

from nsode.diagnostics import ModelError, refuse
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, walk
from nsode.inclusion.indices import integer
from nsode.inclusion.symbols import Scope
from nsode.inclusion.values import Shape, Value, describe, from_scalars, scalars, shape
from nsode.limits import either
from nsode.syntax.ast import Declarator


def declared_shape(declarator: Declarator, scope: Scope) -> Shape | None:
    """Return the sizes that are declared, None without any.

    Raises
    ------
    ModelError
        NS111 for a size that is no whole number, NS105 for one below 1, NS014 for one
        beyond the limit of a vector.
    """
    if not declarator.sizes:
        return None
    found = tuple(integer(size, scope, "the size") for size in declarator.sizes)
    for size, written in zip(found, declarator.sizes, strict=True):
        if size < 1:
            raise refuse("NS105", "a size must be at least 1", written.span, f"this is {size}")
        limits = scope.symbols.limits
        if size > limits.vector:
            family = f"declare a family, such as `x[i in 1..{size}]`"
            raise refuse(
                "NS014",
                f"a vector of {size:,} is larger than {limits.vector:,}",
                written.span,
                help=either(family, limits.raised("vector", size)),
            )
    return found


def fitted(
    value: Value, over: IndexRange | None, declared: Shape | None, declarator: Declarator
) -> Value:
    """Return what a declared name is, or each element of a family: by formula or by list.

    A list has one item for each element. Where the shape of an element is not declared
    (None), a value that reads the index is a formula, whatever its length.

    Raises
    ------
    ModelError
        NS105 if the value does not fit what is declared.
    """
    of, element = shape(value), declared or ()
    if over is not None and isinstance(value, tuple) and of == (len(over), *element):
        is_list = declared is not None or not _reads(value, over.variable)
        if is_list:
            columns = zip(*(scalars(row) for row in value), strict=True)
            return from_scalars(tuple(_choose(column, over) for column in columns), element)
    if declared is not None and of != declared:
        raise _unfit(declarator, declared, of, over)
    return value


def _reads(value: Value, variable: str) -> bool:
    nodes = [node for part in scalars(value) for node in walk(part)]
    subscripts = [node.at for node in nodes if isinstance(node, Name)]
    plain = [node for node in nodes if isinstance(node, Index)]
    return any(index is not None and index.variable == variable for index in [*subscripts, *plain])


def _unfit(
    declarator: Declarator, declared: Shape, found: Shape, over: IndexRange | None
) -> ModelError:
    name = declarator.name.text
    if over is None:
        message = f"`{name}` is {describe(declared)}, but its value is {describe(found)}"
        way_out = _repair(name, declared, found)
    else:
        message = f"each element of `{name}` is {describe(declared)}, not {describe(found)}"
        way_out = f"give a formula for one element, or a list of all {len(over)}"
    return refuse("NS105", message, declarator.span, help=way_out)


def _repair(name: str, declared: Shape, found: Shape) -> str:
    match declared, found:
        case (), (r,):
            return f"declare `{name}[{r}]`, or give one number"
        case (), _:
            return "give one number"
    return f"give one value for each component, for example `{_example(declared)}`"


def _example(of: Shape) -> str:
    return f"[{', '.join([_example(of[1:])] * of[0])}]" if of else "0"


def _choose(items: Sequence[Expr], over: IndexRange) -> Expr:
    return choose_until([(over.first + k, item) for k, item in enumerate(items)], over.variable)


def choose_until(items: Sequence[tuple[int, Expr]], variable: str) -> Expr:
    """Return the item of the first bound that the index does not exceed.

    The conditions halve the items, so that a long list makes no deep expression.
    """
    if len(items) == 1:
        return items[0][1]
    middle = len(items) // 2
    until = Call("<=", (Index(variable), Number(float(items[middle - 1][0]))))
    low, high = choose_until(items[:middle], variable), choose_until(items[middle:], variable)
    return If(until, low, high, span=low.span.to(high.span))
