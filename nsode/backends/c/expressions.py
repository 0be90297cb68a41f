"""Expressions as C text, with no parenthesis too many and every operation in its order."""

from __future__ import annotations

from math import copysign, isfinite, isnan
from typing import NamedTuple, Protocol

from nsode.expr import Call, Expr, If, Index, Name, Number, Sum


class Scope(Protocol):
    """What an expression needs from the place where it stands."""

    @property
    def single(self) -> bool:
        """Whether real is float."""
        ...

    def name(self, name: Name) -> str:
        """Return the C text of a named value."""
        ...

    def index(self, index: Index) -> str:
        """Return an index as an integer expression of C."""
        ...

    def sum(self, expr: Sum) -> str:
        """Write the loop of a sum before the statement at hand; return its variable."""
        ...

    def use(self, function: str) -> None:
        """Note that a helper or a function of ``math.h`` is called."""
        ...


def lower(expr: Expr, scope: Scope) -> str:
    """Return an expression as a C expression of type real.

    Every operation keeps its place, so that the value is that of the tree evaluated in
    IEEE arithmetic; ``-a*b`` may stand for ``-(a*b)``, which is the same to the last bit.
    """
    code = _code(expr, scope)
    return code.text


def condition(expr: Expr, scope: Scope) -> str:
    """Return a condition as a C expression that can stand under ``!``."""
    return _inside(_code(expr, scope), _UNARY)


class Code(NamedTuple):
    """C text, how tightly it binds, and whether it is an integer to C."""

    text: str
    level: int
    whole: bool = False


_CHOICE, _OR, _AND, _EQUAL, _LESS, _SUM, _PRODUCT, _UNARY, _PRIMARY = range(1, 10)

_BOOLEAN = {
    "<": ("<", _LESS), "<=": ("<=", _LESS), ">": (">", _LESS), ">=": (">=", _LESS),
    "==": ("==", _EQUAL), "!=": ("!=", _EQUAL),
}  # fmt: skip
_LOGICAL = {"and": ("&&", _AND), "or": ("||", _OR)}
_LIBRARY = {
    "sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "atan2",
    "sinh", "cosh", "tanh",
}  # fmt: skip
_HELPERS = {"sat": "sat", "shrink": "shrink", "mod": "floored_mod", "min": "smaller"}

_LARGEST_PLAIN = 10**6  # a float holds it exactly, and a person reads it at a glance
_LARGEST_PRODUCT = 8  # beyond, repeated multiplication loses more than pow does


def number(value: float, scope: Scope | None = None) -> Code:
    """Return a literal: a small whole number as it is, any other under a cast to real."""
    if value.is_integer() and abs(value) <= _LARGEST_PLAIN:
        if value < 0:
            return Code(str(int(value)), _UNARY, whole=True)
        if copysign(1.0, value) > 0:
            return Code(str(int(value)), _PRIMARY, whole=True)
    if isfinite(value):
        return Code(f"(real){value!r}", _UNARY)
    if scope is not None:
        scope.use("NAN")
    sign = "-" if value < 0 else ""
    return Code(f"(real){sign}{'NAN' if isnan(value) else 'INFINITY'}", _UNARY)


def _code(expr: Expr, scope: Scope) -> Code:
    match expr:
        case Name():
            return Code(scope.name(expr), _PRIMARY)
        case Call():
            return _call(expr.function, expr.args, scope)
        case Number():
            return number(expr.value, scope)
        case Index(variable=None, offset=offset):
            return number(float(offset), scope)
        case Index():
            text = scope.index(expr)
            return Code(f"(real){text}" if text.isidentifier() else f"(real)({text})", _UNARY)
        case If(test, then, otherwise):
            return _choice(*(_code(part, scope) for part in (test, then, otherwise)))
        case Sum():
            return Code(scope.sum(expr), _PRIMARY)
        case _:
            raise NotImplementedError(f"no C for {type(expr).__name__}")


def _call(function: str, args: tuple[Expr, ...], scope: Scope) -> Code:
    match function:
        case "+":
            return _sum(args, scope)
        case "neg":
            return _negative(_code(args[0], scope))
        case "*" | "/":
            return _product(function, _code(args[0], scope), _code(args[1], scope))
        case "^":
            return _power(args[0], args[1], scope)
        case "not":
            return Code("!" + _parenthesized(_code(args[0], scope)), _UNARY)
        case _ if function in _BOOLEAN:
            sign, level = _BOOLEAN[function]
            sides = (_inside(_code(side, scope), _SUM) for side in args)
            return Code(f" {sign} ".join(sides), level)
        case _ if function in _LOGICAL:
            sign, level = _LOGICAL[function]
            sides = (_logical(_code(side, scope), level) for side in args)
            return Code(f" {sign} ".join(sides), level)
        case _:
            return _function(function, args, scope)


def _function(function: str, args: tuple[Expr, ...], scope: Scope) -> Code:
    match function, args:
        case "abs", _:
            return _library("fabs", args, scope)
        case "max", (Number(0.0), other):
            return _apply("max0", (other,), scope)
        case "max", _:
            return _apply("larger", args, scope)
        case "norm", (only,):
            return _library("fabs", (only,), scope)
        case "norm", _:
            return _norm(args, scope)
        case _ if function in _HELPERS:
            return _apply(_HELPERS[function], args, scope)
        case _ if function in _LIBRARY:
            return _library(function, args, scope)
        case _:
            raise NotImplementedError(f"no C for the function `{function}`")


def _library(function: str, args: tuple[Expr, ...], scope: Scope) -> Code:
    """Return a call of ``math.h``, where compilers frown on an integer argument."""
    scope.use(function)
    texts = (_real(_code(arg, scope)).text for arg in args)
    return Code(f"{function}{'f' if scope.single else ''}({', '.join(texts)})", _PRIMARY)


def _apply(helper: str, args: tuple[Expr, ...], scope: Scope) -> Code:
    scope.use(helper)
    return Code(f"{helper}({', '.join(lower(arg, scope) for arg in args)})", _PRIMARY)


def _norm(args: tuple[Expr, ...], scope: Scope) -> Code:
    if len(args) <= 4:
        return _apply(f"norm{len(args)}", args, scope)
    squares = tuple(Call("^", (arg, Number(2.0))) for arg in args)
    return _library("sqrt", (Call("+", squares),), scope)


def _inside(code: Code, level: int) -> str:
    """Return text that can be an operand where ``level`` is the least that may stand bare."""
    return code.text if code.level >= level else f"({code.text})"


def _parenthesized(code: Code) -> str:
    return f"({code.text})" if code.level < _PRIMARY else code.text


def _right(code: Code, level: int) -> str:
    """Return a right operand; a sign in front is kept away from the operator."""
    return f"({code.text})" if code.text.startswith("-") else _inside(code, level)


def _real(code: Code) -> Code:
    """Return a whole number under a cast, so that C does not compute with integers."""
    return Code(f"(real){_inside(code, _UNARY)}", _UNARY) if code.whole else code


def _sum(terms: tuple[Expr, ...], scope: Scope) -> Code:
    first, *rest = (_term(term, scope) for term in terms)
    start = _real(first[1]) if not rest or rest[0][1].whole else first[1]
    text = _negative(start).text if first[0] else _inside(start, _SUM)
    for minus, code in rest:
        text += (" - " if minus else " + ") + _right(code, _PRODUCT)
    return Code(text, _SUM)


def _term(term: Expr, scope: Scope) -> tuple[bool, Code]:
    """Return whether a term is subtracted, and what."""
    match term:
        case Call() if term.function == "neg":
            return True, _code(term.args[0], scope)
        case Number(value) if value < 0:
            return True, number(-value, scope)
        case _:
            return False, _code(term, scope)


def _negative(code: Code) -> Code:
    if code.text == "0":  # an integer has no negative zero
        code = _real(code)
    if code.level < _PRODUCT or code.text.startswith("-"):
        return Code(f"-({code.text})", _UNARY, code.whole)
    # Signs are exact: -(a*b) and (-a)*b agree to the last bit.
    return Code("-" + code.text, min(code.level, _UNARY), code.whole)


def _product(operator: str, left: Code, right: Code) -> Code:
    if operator == "/" and right.text == "0":  # compilers warn of integers only
        right = _real(right)
    start = _real(left) if right.whole and left.whole else left
    return Code(f"{_inside(start, _PRODUCT)}{operator}{_right(right, _UNARY)}", _PRODUCT)


def _choice(test: Code, then: Code, otherwise: Code) -> Code:
    if then.whole and otherwise.whole:
        then = _real(then)
    parts = _inside(test, _OR), _inside(then, _CHOICE + 1), _inside(otherwise, _CHOICE)
    return Code("{} ? {} : {}".format(*parts), _CHOICE)


def _logical(code: Code, level: int) -> str:
    """Return an operand of ``&&`` or ``||``; mixed ones get parentheses, for the reader."""
    bare = code.level == level or code.level >= _EQUAL
    return code.text if bare else f"({code.text})"


def _power(base: Expr, exponent: Expr, scope: Scope) -> Code:
    value = _value(exponent)
    if value is None or not value.is_integer() or abs(value) > _LARGEST_PRODUCT:
        return _library("sqrt", (base,), scope) if value == 0.5 else _pow(base, exponent, scope)
    whole = abs(int(value))
    if whole == 0:
        return _pow(base, exponent, scope)  # which is 1, and reads its base
    raised = _raised(base, whole, scope)
    return raised if value > 0 else _product("/", number(1.0), _real(raised))


def _pow(base: Expr, exponent: Expr, scope: Scope) -> Code:
    return _library("pow", (base, exponent), scope)


def _value(expr: Expr) -> float | None:
    match expr:
        case Number(value):
            return value
        case Index(None, offset):
            return float(offset)
        case Call("neg", (Number(value),)):
            return -value
        case _:
            return None


def _raised(base: Expr, n: int, scope: Scope) -> Code:
    """Return a product of ``n`` equal factors, each of which is computed once."""
    code = _code(base, scope)
    if n == 1:
        return code
    if isinstance(base, Name) and n <= 3:
        return Code("*".join([code.text] * n), _PRODUCT)
    if n <= 3:
        return _helped("square" if n == 2 else "cube", code.text, scope)
    return _helped("power", f"{code.text}, {n}", scope)


def _helped(helper: str, args: str, scope: Scope) -> Code:
    scope.use(helper)
    return Code(f"{helper}({args})", _PRIMARY)
