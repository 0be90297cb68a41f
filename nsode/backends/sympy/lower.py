"""Expressions as SymPy objects, built by constructors and never from strings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import sympy as sp

from nsode.backends.sympy import opaque
from nsode.expr import Call, Expr, If, Index, Name, Number, Sum


@dataclass(frozen=True, slots=True)
class Environment:
    """The symbol of each name, an ``IndexedBase`` for a family."""

    symbols: Mapping[str, sp.Basic]


def index(variable: str) -> sp.Symbol:
    """Return the symbol of an index."""
    return sp.Symbol(variable, integer=True)


def lower(expr: Expr, env: Environment) -> sp.Basic:
    """Return an expression as a SymPy object; sums and products are SymPy's own."""
    match expr:
        case Number(value):
            return sp.Integer(int(value)) if value.is_integer() else sp.Float(value)
        case Index(None, offset):
            return sp.Integer(offset)
        case Index(str() as variable, offset):
            return index(variable) + offset
        case Name(id, None):
            return env.symbols[id]
        case Name(id, Index() as at):
            return env.symbols[id][lower(at, env)]
        case Call("and" | "or" | "not" as function, args):
            made = {"and": sp.And, "or": sp.Or, "not": sp.Not}[function]
            return made(*(lower(arg, env) for arg in args), evaluate=False)
        case Call(function, args) if function in _RELATIONS:
            left, right = (lower(arg, env) for arg in args)
            return _RELATIONS[function](left, right, evaluate=False)
        case Call(function, args):
            return _FUNCTIONS[function](*(lower(arg, env) for arg in args))
        case If(condition, then, otherwise):
            return opaque.choose(*(lower(part, env) for part in (condition, then, otherwise)))
        case Sum(range, body):
            return sp.Sum(lower(body, env), (index(range.variable), range.first, range.last))
    raise NotImplementedError(f"no SymPy rule for {type(expr).__name__}")


_RELATIONS: dict[str, Callable[..., sp.Basic]] = {
    "<": sp.StrictLessThan,
    "<=": sp.LessThan,
    ">": sp.StrictGreaterThan,
    ">=": sp.GreaterThan,
    "==": sp.Equality,
    "!=": sp.Unequality,
}

_FUNCTIONS: dict[str, Callable[..., sp.Basic]] = {
    "+": sp.Add,
    "neg": lambda a: -a,
    "*": sp.Mul,
    "/": lambda a, b: a / b,
    "^": sp.Pow,
    **{name: getattr(sp, name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan")},
    **{name: getattr(sp, name) for name in ("asin", "acos", "atan", "atan2")},
    **{name: getattr(sp, name) for name in ("sinh", "cosh", "tanh")},
    "abs": opaque.absolute,
    "min": opaque.minimum,
    "max": opaque.maximum,
    "mod": opaque.modulo,
    "norm": opaque.norm,
    "sat": opaque.sat,
    "shrink": opaque.shrink,
}
