"""Small vectors and matrices of scalar expressions, and their algebra.

A value is an expression, or a tuple of values: a vector is a tuple of expressions, a
matrix a tuple of rows. Zeros and ones that the expansion of a product brings in are
left out; what the author wrote stays.
"""

from __future__ import annotations

from collections.abc import Callable

from nsode.expr import Call, Expr, Number, add, multiply, negate
from nsode.source import NOWHERE, Span

Value = Expr | tuple["Value", ...]
Shape = tuple[int, ...]


class ShapeError(Exception):
    """Shapes do not fit; the message says which."""


def shape(value: Value) -> Shape:
    """Return () for a scalar, (r,) for a vector, (m, n) for a matrix."""
    if isinstance(value, Expr):
        return ()
    return (len(value), *(shape(value[0]) if value else ()))


def describe(of: Shape) -> str:
    """Return a shape in words."""
    match of:
        case ():
            return "a scalar"
        case (r,):
            return f"a vector of {r}"
        case (m, n):
            return f"a matrix of {m} by {n}"
    return "an array of " + " by ".join(map(str, of))


def scalars(value: Value) -> tuple[Expr, ...]:
    """Return the components of a value in order, row by row."""
    if isinstance(value, Expr):
        return (value,)
    return tuple(component for item in value for component in scalars(item))


def suffixes(of: Shape) -> tuple[str, ...]:
    """Return what is appended to a name for each component of that shape."""
    match of:
        case (2,) | (3,):
            return (".x", ".y", ".z")[: of[0]]
        case ():
            return ("",)
    return _bracketed(of)


def _bracketed(of: Shape) -> tuple[str, ...]:
    if not of:
        return ("",)
    return tuple(f"[{k}]{tail}" for k in range(1, of[0] + 1) for tail in _bracketed(of[1:]))


def from_scalars(items: tuple[Expr, ...], of: Shape) -> Value:
    """Return the value of a shape with these components."""
    if not of:
        return items[0]
    step = len(items) // of[0] if of[0] else 0
    return tuple(from_scalars(items[k * step : (k + 1) * step], of[1:]) for k in range(of[0]))


def each(change: Callable[[Expr], Expr], value: Value) -> Value:
    """Return the value with every component changed."""
    if isinstance(value, Expr):
        return change(value)
    return tuple(each(change, item) for item in value)


def _is(expr: Expr, value: float) -> bool:
    return isinstance(expr, Number) and expr.value == value


def is_zero(expr: Expr) -> bool:
    """Tell whether an expression is the literal zero."""
    return _is(expr, 0.0) or (
        isinstance(expr, Call) and expr.function == "neg" and is_zero(expr.args[0])
    )


def plus(values: tuple[Value, ...]) -> Value:
    """Return the sum of values of one shape; components drop literal zeros."""
    first = shape(values[0])
    for value in values[1:]:
        if shape(value) != first:
            raise ShapeError(f"{describe(first)} and {describe(shape(value))} cannot be added")
    if not first:
        return Call("+", tuple(v for v in values if isinstance(v, Expr)), span=_span(values[0]))
    columns = zip(*(scalars(value) for value in values), strict=True)
    return from_scalars(tuple(total(column) for column in columns), first)


def total(terms: tuple[Expr, ...]) -> Expr:
    """Return a sum without its literal zeros."""
    kept = [term for term in terms if not is_zero(term)]
    return add(*kept) if kept else Number(0.0, span=terms[0].span)


def product(left: Expr, right: Expr) -> Expr:
    """Return ``left*right`` as the expansion of a vector product wants it."""
    if is_zero(left) or is_zero(right):
        return Number(0.0, span=left.span)
    if _is(left, 1.0):
        return right
    if _is(right, 1.0):
        return left
    match left:
        case Call("neg", (inner,)):
            return negate(product(inner, right))
    return multiply(left, right)


def _inner(left: tuple[Value, ...], right: tuple[Value, ...]) -> Expr:
    pairs = zip(scalars(left), scalars(right), strict=True)
    return total(tuple(product(a, b) for a, b in pairs))


def times(left: Value, right: Value) -> Value:
    """Return scalar x any, matrix x vector or matrix x matrix."""
    match left, right:
        case Expr(), Expr():
            return multiply(left, right)
        case Expr(), tuple():
            return each(lambda component: product(left, component), right)
        case tuple(), Expr():
            return each(lambda component: product(component, right), left)
    assert isinstance(left, tuple)
    assert isinstance(right, tuple)
    a, b = shape(left), shape(right)
    if len(a) == 2 and a[1] == b[0]:
        if len(b) == 1:
            return tuple(_inner(row, right) for row in left if isinstance(row, tuple))
        columns = transpose(right)
        assert isinstance(columns, tuple)
        return tuple(
            tuple(_inner(row, column) for column in columns if isinstance(column, tuple))
            for row in left
            if isinstance(row, tuple)
        )
    hint = "; write dot(a, b) or cross(a, b)" if len(a) == 1 and len(b) == 1 else ""
    raise ShapeError(f"{describe(a)} and {describe(b)} cannot be multiplied{hint}")


def dot(left: Value, right: Value) -> Value:
    """Return the inner product of two vectors of one length."""
    if len(shape(left)) != 1 or shape(left) != shape(right):
        raise ShapeError(
            f"dot wants two vectors of one length, not {describe(shape(left))} "
            f"and {describe(shape(right))}"
        )
    return total(tuple(product(a, b) for a, b in zip(scalars(left), scalars(right), strict=True)))


def cross(left: Value, right: Value) -> Value:
    """Return the vector product of two vectors of 3."""
    if shape(left) != (3,) or shape(right) != (3,):
        raise ShapeError(
            f"cross wants two vectors of 3, not {describe(shape(left))} "
            f"and {describe(shape(right))}"
        )
    a, b = scalars(left), scalars(right)

    def component(j: int, k: int) -> Expr:
        return total((product(a[j], b[k]), negate(product(a[k], b[j]))))

    return (component(1, 2), component(2, 0), component(0, 1))


def transpose(value: Value) -> Value:
    """Return the transpose of a matrix."""
    if len(shape(value)) != 2 or not isinstance(value, tuple):
        raise ShapeError(f"transpose wants a matrix, not {describe(shape(value))}")
    rows = [row for row in value if isinstance(row, tuple)]
    return tuple(tuple(column) for column in zip(*rows, strict=True))


def qmul(left: Value, right: Value) -> Value:
    """Return the product of two quaternions, scalar first."""
    if shape(left) != (4,) or shape(right) != (4,):
        raise ShapeError(
            f"qmul wants two vectors of 4, not {describe(shape(left))} and {describe(shape(right))}"
        )
    a, b = scalars(left), scalars(right)
    signs = ((1, -1, -1, -1), (1, 1, 1, -1), (1, -1, 1, 1), (1, 1, -1, 1))
    order = ((0, 1, 2, 3), (1, 0, 3, 2), (2, 3, 0, 1), (3, 2, 1, 0))

    def component(row: int) -> Expr:
        terms = [product(a[k], b[order[row][k]]) for k in range(4)]
        return total(
            tuple(t if s > 0 else negate(t) for t, s in zip(terms, signs[row], strict=True))
        )

    return tuple(component(row) for row in range(4))


def norm(value: Value) -> Value:
    """Return the Euclidean norm of a vector."""
    if len(shape(value)) != 1:
        raise ShapeError(f"norm wants a vector, not {describe(shape(value))}")
    return Call("norm", scalars(value), span=_span(value))


def _span(value: Value) -> Span:
    first = scalars(value)
    return first[0].span if first else NOWHERE
