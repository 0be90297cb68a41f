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

from collections.abc import Callable, Container, Iterator
from dataclasses import dataclass, field, replace
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


def partials(
    expr: Expr, taken: frozenset[str] = frozenset(), by: Container[str] | None = None
) -> list[Partial]:
    """Return the derivative of ``expr`` by each name in it, in the order of the text.

    Parameters
    ----------
    expr : Expr
        A scalar expression.
    taken : frozenset of str
        Index variables in use outside ``expr``; sums inside it are given others.
    by : container of str
        The names to derive by; all unless given.
    """
    descent = _Descent(by)
    descent.into(expr, ONE, (), (), taken)
    return descent.found


@dataclass(slots=True)
class _Descent:
    """A way down an expression, with what the derivatives below are multiplied by."""

    by: Container[str] | None
    found: list[Partial] = field(default_factory=list)

    def into(
        self,
        expr: Expr,
        factor: Expr,
        over: tuple[IndexRange, ...],
        where: tuple[Expr, ...],
        taken: frozenset[str],
    ) -> None:
        match expr:
            case Name():
                if not self.ignores(expr):
                    self.found.append(Partial(expr, factor, over, where))
            case Call():
                for argument, slope, condition in slopes(expr):
                    if not self.ignores(argument):
                        deeper = times(factor, slope)
                        self.into(argument, deeper, over, where + condition, taken)
            case Number() | Index():
                return
            case If(condition, then, otherwise):
                self.into(then, factor, over, (*where, condition), taken)
                refuted = Call("not", (condition,))
                self.into(otherwise, factor, over, (*where, refuted), taken)
            case Sum(span, body):
                fresh = fresh_range(span, taken)
                inner = shifted(body, span.variable, Index(fresh.variable))
                self.into(inner, factor, (*over, fresh), where, taken | {fresh.variable})
            case _:
                raise NotImplementedError(f"no derivative of {type(expr).__name__}")

    def ignores(self, expr: Expr) -> bool:
        """Tell whether an expression is a number or a name that is not derived by."""
        if isinstance(expr, Name):
            return self.by is not None and expr.id not in self.by
        return isinstance(expr, Number)


Slope = tuple[Expr, Expr, tuple[Expr, ...]]


def slopes(call: Call) -> Iterator[Slope]:
    """Yield each argument, the derivative by it, and the conditions under which that holds."""
    match call.function, call.args:
        case "+", terms:
            yield from ((term, ONE, ()) for term in terms)
        case "neg", (a,):
            yield a, Number(-1.0), ()
        case "*", (a, b):
            yield a, b, ()
            yield b, a, ()
        case "/", (a, b):
            yield a, _call("/", ONE, b), ()
            yield b, negate(_call("/", call, b)), ()
        case "^", (a, b):
            yield from _power(call, a, b)
        case "norm", components:
            positive = (_call(">", call, ZERO),)
            yield from ((a, _call("/", a, call), positive) for a in components)
        case "max" | "min" | "sat" | "shrink" | "atan2" | "mod", (a, b):
            yield from _of_two(call, a, b)
        case function, _ if function in _CONDITIONS:
            return
        case _, (a,):
            yield from _of_one(call, a)
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
    for factor, other in ((left, right), (right, left)):
        if isinstance(factor, Number) and abs(factor.value) == 1.0:
            return other if factor.value > 0 else negate(other)
    return _call("*", left, right)


def guarded(conditions: tuple[Expr, ...], value: Expr) -> Expr:
    """Return ``value`` where all conditions hold, else 0."""
    if not conditions:
        return value
    condition, *others = dict.fromkeys(conditions)
    for further in others:
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
