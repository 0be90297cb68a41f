"""The derivative of each function, and of one expression by the names that it reads.

Where a function has a kink, the derivative is that of one side, and always finite:

- ``max``, ``min``: the first argument counts where the two are equal, so that
  ``max(0, y)`` has the slope 0 at ``y = 0``;
- ``abs``, ``norm``, ``sqrt``, ``atan2``: 0 where the argument vanishes;
- ``sat(Z, x)``: that of slip where ``|x| = Z``, and 0 where both vanish;
- ``shrink(Z, n)``: that of slip where ``n = Z``, and 0 where both vanish;
- ``asin``, ``acos``: 0 at the ends of their domain; ``x^c`` with ``c < 1``: 0 at 0;
- ``mod``: the slope between two jumps; a condition has none.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum, negate, rebuild, walk

ZERO = Number(0.0)
ONE = Number(1.0)


class Partial(NamedTuple):
    """One summand of a derivative: ``coefficient*d(name)``.

    It is summed over ``over``, and counts only where every condition of ``where``
    holds. The conditions stand apart so that whatever is multiplied to the
    coefficient is not even looked at where they fail.
    """

    name: Name
    coefficient: Expr
    over: tuple[IndexRange, ...] = ()
    where: tuple[Expr, ...] = ()


def partials(expr: Expr, taken: frozenset[str] = frozenset()) -> list[Partial]:
    """Return the derivative of ``expr`` by each name in it, in the order of the text.

    Parameters
    ----------
    expr : Expr
        A scalar expression.
    taken : frozenset of str
        Index variables in use outside ``expr``; sums inside it are given others.
    """
    found: list[Partial] = []
    _descend(Partial(Name(""), ONE), expr, taken, found)
    return found


def _descend(path: Partial, expr: Expr, taken: frozenset[str], found: list[Partial]) -> None:
    match expr:
        case Number() | Index():
            return
        case Name():
            found.append(path._replace(name=expr))
        case If(condition, then, otherwise):
            _descend(path._replace(where=(*path.where, condition)), then, taken, found)
            refuted = Call("not", (condition,))
            _descend(path._replace(where=(*path.where, refuted)), otherwise, taken, found)
        case Sum(span, body):
            fresh = fresh_range(span, taken)
            inner = shifted(body, span.variable, Index(fresh.variable))
            within = path._replace(over=(*path.over, fresh))
            _descend(within, inner, taken | {fresh.variable}, found)
        case Call():
            for argument, slope, where in slopes(expr):
                deeper = path._replace(
                    coefficient=times(path.coefficient, slope), where=(*path.where, *where)
                )
                _descend(deeper, argument, taken, found)
        case _:
            raise NotImplementedError(f"no derivative of {type(expr).__name__}")


Slope = tuple[Expr, Expr, tuple[Expr, ...]]


def slopes(call: Call) -> Iterator[Slope]:
    """Yield each argument, the derivative by it, and the conditions under which that holds."""
    match call:
        case Call("+", terms):
            yield from ((term, ONE, ()) for term in terms)
        case Call("neg", (a,)):
            yield a, Number(-1.0), ()
        case Call("*", (a, b)):
            yield a, b, ()
            yield b, a, ()
        case Call("/", (a, b)):
            yield a, _call("/", ONE, b), ()
            yield b, negate(_call("/", call, b)), ()
        case Call("^", (a, b)):
            yield from _power(call, a, b)
        case Call("norm", components):
            positive = (_call(">", call, ZERO),)
            yield from ((a, _call("/", a, call), positive) for a in components)
        case Call("max" | "min" | "sat" | "shrink" | "atan2" | "mod", (a, b)):
            yield from _of_two(call, a, b)
        case Call(function, (a,)) if function not in _CONDITIONS:
            yield from _of_one(call, a)
        case Call(function) if function in _CONDITIONS:
            return
        case _:
            raise NotImplementedError(f"no derivative of `{call.function}`")


_CONDITIONS = frozenset({"<", "<=", ">", ">=", "==", "!=", "and", "or", "not"})


def _power(call: Call, base: Expr, exponent: Expr) -> Iterator[Slope]:
    match exponent:
        case Number(value):
            where = () if value >= 1.0 or value == 0.0 else _nonzero(base)
            yield base, times(exponent, _raised(base, value - 1.0)), where
        case _:
            lower = _call("^", base, _call("+", exponent, Number(-1.0)))
            yield base, times(exponent, lower), _nonzero(base)
            yield exponent, times(call, _call("log", base)), (_call(">", base, ZERO),)


def _raised(base: Expr, exponent: float) -> Expr:
    if exponent == 0.0:
        return ONE
    return base if exponent == 1.0 else _call("^", base, Number(exponent))


def _nonzero(expr: Expr) -> tuple[Expr, ...]:
    return (_call("!=", expr, ZERO),)


def _of_two(call: Call, a: Expr, b: Expr) -> Iterator[Slope]:
    match call.function:
        case "max":
            yield a, ONE, (_call(">=", a, b),)
            yield b, ONE, (_call("<", a, b),)
        case "min":
            yield a, ONE, (_call("<=", a, b),)
            yield b, ONE, (_call(">", a, b),)
        case "sat":
            yield b, ONE, (_call("<", _call("abs", b), a),)
            yield a, ONE, (_call(">=", b, a), _call(">", b, ZERO))
            yield a, Number(-1.0), (_call(">=", negate(b), a), _call("<", b, ZERO))
        case "shrink":
            slip = (_call(">=", b, a), _call(">", b, ZERO))
            yield a, _call("/", ONE, b), slip
            yield b, negate(_call("/", _call("/", a, b), b)), slip
        case "atan2":
            square = _call("+", times(a, a), times(b, b))
            yield a, _call("/", b, square), (_call(">", square, ZERO),)
            yield b, negate(_call("/", a, square)), (_call(">", square, ZERO),)
        case _:
            yield a, ONE, ()
            yield b, negate(_call("/", _call("+", a, negate(call)), b)), ()


def _of_one(call: Call, a: Expr) -> Iterator[Slope]:
    positive = (_call(">", a, ZERO),)
    match call.function:
        case "abs":
            yield a, ONE, positive
            yield a, Number(-1.0), (_call("<", a, ZERO),)
        case "sqrt":
            yield a, _call("/", Number(0.5), call), positive
        case "asin" | "acos":
            inside = _call("+", ONE, negate(times(a, a)))
            slope = _call("/", ONE, _call("sqrt", inside))
            within = (_call(">", inside, ZERO),)
            yield a, slope if call.function == "asin" else negate(slope), within
        case function if function in _SMOOTH:
            yield a, _SMOOTH[function](call, a), ()
        case _:
            raise NotImplementedError(f"no derivative of `{call.function}`")


_SMOOTH: dict[str, Callable[[Call, Expr], Expr]] = {
    "exp": lambda call, _: call,
    "log": lambda _, a: _call("/", ONE, a),
    "sin": lambda _, a: _call("cos", a),
    "cos": lambda _, a: negate(_call("sin", a)),
    "tan": lambda call, _: _call("+", ONE, times(call, call)),
    "atan": lambda _, a: _call("/", ONE, _call("+", ONE, times(a, a))),
    "sinh": lambda _, a: _call("cosh", a),
    "cosh": lambda _, a: _call("sinh", a),
    "tanh": lambda call, _: _call("+", ONE, negate(times(call, call))),
}


def _call(function: str, *args: Expr) -> Call:
    return Call(function, args, span=args[0].span)


def times(left: Expr, right: Expr) -> Expr:
    """Return ``left*right``, where a factor of 1 or -1 leaves no trace."""
    match left, right:
        case (Number(1.0), other) | (other, Number(1.0)):
            return other
        case (Number(-1.0), other) | (other, Number(-1.0)):
            return negate(other)
        case _:
            return _call("*", left, right)


def guarded(conditions: tuple[Expr, ...], value: Expr) -> Expr:
    """Return ``value`` where all conditions hold, else 0."""
    if not conditions:
        return value
    condition = conditions[0]
    for further in conditions[1:]:
        condition = _call("and", condition, further)
    return If(condition, value, ZERO, span=value.span)


def summed(over: tuple[IndexRange, ...], value: Expr) -> Expr:
    """Return ``value`` summed over each of the ranges."""
    for span in reversed(over):
        value = Sum(span, value, span=value.span)
    return value


def fresh_range(span: IndexRange, taken: frozenset[str]) -> IndexRange:
    """Return the range under a variable that is not ``taken``."""
    variable = span.variable
    while variable in taken:
        variable += "_"
    return IndexRange(variable, span.first, span.last)


def moved(at: Index | None, variable: str, to: Index) -> Index | None:
    """Return the subscript ``at`` with ``variable`` replaced by ``to``."""
    if at is None or at.variable != variable:
        return at
    return replace(at, variable=to.variable, offset=to.offset + at.offset)


def shifted(expr: Expr, variable: str, to: Index) -> Expr:
    """Return ``expr`` with the index ``variable`` replaced by ``to``."""
    if to.variable == variable and to.offset == 0:
        return expr
    match expr:
        case Index() as index:
            return moved(index, variable, to) or index
        case Name(at=at):
            return replace(expr, at=moved(at, variable, to))
        case Sum(span, body):
            if span.variable == variable:
                return expr
            if span.variable == to.variable:
                fresh = fresh_range(span, index_variables(body) | {variable, span.variable})
                body = shifted(body, span.variable, Index(fresh.variable))
                expr = replace(expr, range=fresh, body=body)
            return rebuild(expr, lambda child: shifted(child, variable, to))
        case _:
            return rebuild(expr, lambda child: shifted(child, variable, to))


def index_variables(expr: Expr) -> frozenset[str]:
    """Return every index variable that stands in ``expr``, bound or free."""
    found: set[str] = set()
    for node in walk(expr):
        match node:
            case Index(variable) | Name(at=Index(variable)) if variable is not None:
                found.add(variable)
            case Sum(span):
                found.add(span.variable)
            case _:
                pass
    return frozenset(found)
