"""Expressions as CasADi ``SX``: a scalar is 1 x 1, a family a column."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import casadi as ca

from nsode.backends.casadi import gates
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum


@dataclass(frozen=True, slots=True)
class Environment:
    """What names mean, and the first index of each family.

    ``over`` is the range of the family at hand, a column; ``fixed`` gives indices of one
    value. ``guard`` tells where the value counts, None where it always does.
    """

    values: Mapping[str, ca.SX]
    firsts: Mapping[str, int]
    over: IndexRange | None = None
    fixed: Mapping[str, int] | None = None
    guard: ca.SX | None = None

    def along(self, over: IndexRange) -> Environment:
        """Return the environment of the elements of a family."""
        return replace(self, over=over)

    def under(self, condition: ca.SX) -> Environment:
        """Return the environment of a branch."""
        guard = condition if self.guard is None else ca.logic_and(self.guard, condition)
        return replace(self, guard=guard)

    def at(self, variable: str, value: int) -> Environment:
        """Return the environment with one more index at one value."""
        over = None if self.over and self.over.variable == variable else self.over
        return replace(self, over=over, fixed={**(self.fixed or {}), variable: value})

    def safe(self, value: ca.SX, fallback: float) -> ca.SX:
        """Return a value, replaced where it does not count."""
        if self.guard is None:
            return value
        return gates.choose(self.guard, value, ca.SX(fallback))


def lower(expr: Expr, env: Environment) -> ca.SX:
    """Return an expression as ``SX``."""
    match expr:
        case Number(value):
            return ca.SX(value)
        case Index():
            return _index(expr, env)
        case Name(id, None):
            return env.values[id]
        case Name(id, Index() as at):
            return _element(id, at, env)
        case Call(function, args):
            return _call(function, args, env)
        case If(condition, then, otherwise):
            test = lower(condition, env)
            a = lower(then, env.under(test))
            b = lower(otherwise, env.under(ca.logic_not(test)))
            return gates.choose(test, a, b)
        case Sum(IndexRange(variable, first, last), body):
            total = ca.SX(0.0)
            for k in range(first, last + 1):
                total = total + lower(body, env.at(variable, k))
            return total
    raise NotImplementedError(f"no CasADi rule for {type(expr).__name__}")


def _index(index: Index, env: Environment) -> ca.SX:
    fixed = _fixed(index, env)
    if fixed is not None:
        return ca.SX(float(fixed))
    assert env.over is not None
    first, last = env.over.first + index.offset, env.over.last + index.offset
    return ca.SX(ca.DM(range(first, last + 1)))


def _element(name: str, at: Index, env: Environment) -> ca.SX:
    fixed = _fixed(at, env)
    if fixed is not None:
        return env.values[name][fixed - env.firsts[name]]
    assert env.over is not None
    start = env.over.first + at.offset - env.firsts[name]
    return env.values[name][start : start + len(env.over)]


def _fixed(index: Index, env: Environment) -> int | None:
    """Return the integer that an index stands for, None where it runs over the column."""
    if index.variable is None:
        return index.offset
    if env.over is not None and index.variable == env.over.variable:
        return None
    return (env.fixed or {})[index.variable] + index.offset


def _call(function: str, args: tuple[Expr, ...], env: Environment) -> ca.SX:
    match function, args:
        case "^", (base, Number(exponent)):
            fallback = 1.0 if exponent < 0 or not exponent.is_integer() else None
            value = lower(base, env)
            return gates.power(value if fallback is None else env.safe(value, fallback), exponent)
        case _:
            return _apply(function, [lower(arg, env) for arg in args], env)


def _apply(function: str, args: list[ca.SX], env: Environment) -> ca.SX:
    match function, args:
        case "+", _:
            total = args[0]
            for term in args[1:]:
                total = total + term
            return total
        case "neg", [a]:
            return -a
        case "*", [a, b]:
            return a * b
        case "/", [a, b]:
            return a / env.safe(b, 1.0)
        case "^", [a, b]:
            return ca.power(env.safe(a, 1.0), b)
        case "mod", [a, b]:
            return gates.modulo(a, env.safe(b, 1.0))
        case (("sqrt" | "log"), [a]):
            return (gates.root if function == "sqrt" else ca.log)(env.safe(a, 1.0))
        case (("asin" | "acos"), [a]):
            return gates.inside_unit(function, env.safe(a, 0.0))
        case _:
            return _PLAIN[function](*args)


_PLAIN: dict[str, Callable[..., ca.SX]] = {
    "<": ca.SX.__lt__,
    "<=": ca.SX.__le__,
    ">": ca.SX.__gt__,
    ">=": ca.SX.__ge__,
    "==": ca.SX.__eq__,
    "!=": ca.SX.__ne__,
    "and": ca.logic_and,
    "or": ca.logic_or,
    "not": ca.logic_not,
    "exp": ca.exp,
    "sin": ca.sin,
    "cos": ca.cos,
    "tan": ca.tan,
    "atan": ca.atan,
    "atan2": gates.angle,
    "sinh": ca.sinh,
    "cosh": ca.cosh,
    "tanh": ca.tanh,
    "abs": ca.fabs,
    "min": gates.minimum,
    "max": gates.maximum,
    "norm": gates.norm,
    "sat": gates.sat,
    "shrink": gates.shrink,
}
