"""Expressions as TeX."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from math import inf, isnan
from typing import NamedTuple

from nsode.backends.latex.names import Symbol, word
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum


@dataclass(frozen=True, slots=True)
class Environment:
    """What names look like; ``fixed`` gives the value of an index that has only one."""

    symbols: Mapping[str, Symbol]
    fixed: Mapping[str, int] = field(default_factory=dict)

    def inside(self, range: IndexRange) -> Environment:
        """Return the environment of the elements of a family, or of its only one."""
        others = {k: v for k, v in self.fixed.items() if k != range.variable}
        if len(range) == 1:
            others[range.variable] = range.first
        return replace(self, fixed=others)


class Tex(NamedTuple):
    """TeX with how tightly it binds."""

    text: str
    level: int


_CHOICE, _LOGIC, _COMPARE, _SUM, _MINUS, _PRODUCT, _POWER, _ATOM = range(8)

_OPERATORS = {
    **{name: rf"\{name}" for name in ("exp", "sin", "cos", "tan", "sinh", "cosh", "tanh", "max")},
    **{"min": r"\min", "log": r"\ln"},
    **{"asin": r"\arcsin", "acos": r"\arccos", "atan": r"\arctan"},
    **{name: rf"\operatorname{{{name}}}" for name in ("atan2", "sat", "dio", "sgn")},
}
_RELATIONS = {"<": "<", "<=": r"\le", ">": ">", ">=": r"\ge", "==": "=", "!=": r"\ne"}
_LOGICAL = {"and": r"\wedge", "or": r"\vee"}


def lower(expr: Expr, env: Environment) -> str:
    """Return an expression as TeX for math mode."""
    return _lower(expr, env).text


def _lower(expr: Expr, env: Environment) -> Tex:
    match expr:
        case Number(value):
            return _number(value)
        case Index():
            return _index(expr, env)
        case Name(id, at):
            symbol = env.symbols[id]
            return Tex(str(symbol if at is None else symbol.at(_index(at, env).text)), _ATOM)
        case Call(function, args):
            return _call(function, args, env)
        case If():
            return _cases(expr, env)
        case Sum(range, body):
            below = f"{word(range.variable)} = {range.first}"
            inner = replace(env, fixed={k: v for k, v in env.fixed.items() if k != range.variable})
            text = _at_least(_lower(body, inner), _PRODUCT)
            return Tex(rf"\sum_{{{below}}}^{{{range.last}}} {text}", _SUM)
    raise NotImplementedError(f"no TeX rule for {type(expr).__name__}")


def _number(value: float) -> Tex:
    if isnan(value):
        return Tex(r"\mathrm{NaN}", _ATOM)
    text = r"\infty" if value == inf else r"-\infty" if value == -inf else number(value)
    if text.startswith("-"):
        return Tex(text, _MINUS)
    return Tex(text, _PRODUCT if r"\times" in text else _POWER if "^" in text else _ATOM)


def number(value: float) -> str:
    """Return a finite number in its shortest form, by powers of ten where it is far from 1."""
    if value.is_integer() and abs(value) < 1e5:
        return f"{value:.0f}"
    if 1e-3 <= abs(value) < 1e5:
        return repr(value)
    negative, digits, exponent = Decimal(repr(value)).normalize().as_tuple()
    assert isinstance(exponent, int)
    first, rest = str(digits[0]), "".join(map(str, digits[1:]))
    mantissa = f"{first}.{rest}" if rest else first
    power = f"10^{{{exponent + len(rest)}}}"
    return "-" * negative + (power if mantissa == "1" else rf"{mantissa} \times {power}")


def _index(index: Index, env: Environment) -> Tex:
    if index.variable is None:
        return _integer(index.offset)
    if index.variable in env.fixed:
        return _integer(env.fixed[index.variable] + index.offset)
    name = str(word(index.variable))
    return Tex(f"{name}{index.offset:+d}", _SUM) if index.offset else Tex(name, _ATOM)


def _integer(value: int) -> Tex:
    return Tex(str(value), _ATOM if value >= 0 else _MINUS)


def _call(function: str, args: tuple[Expr, ...], env: Environment) -> Tex:
    parts = [_lower(arg, env) for arg in args]
    texts = [part.text for part in parts]
    match function:
        case "+":
            return Tex(_terms(parts), _SUM)
        case "neg":
            return Tex(f"-{_at_least(parts[0], _PRODUCT)}", _MINUS)
        case "*":
            sign, left = _sign(parts[0])
            return Tex(sign + _product(left, parts[1]), _MINUS if sign else _PRODUCT)
        case "/":
            return _fraction(args[0], parts, env)
        case "^":
            return Tex(f"{_at_least(parts[0], _ATOM)}^{{{texts[1]}}}", _POWER)
        case "sqrt":
            return Tex(rf"\sqrt{{{texts[0]}}}", _ATOM)
        case "abs":
            return Tex(rf"\left|{texts[0]}\right|", _ATOM)
        case "norm" | "sat" | "shrink":
            return _of_vector(function, texts)
        case "mod":
            a, b = _at_least(parts[0], _PRODUCT), _at_least(parts[1], _POWER)
            return Tex(rf"{a} \bmod {b}", _SUM)
        case "not":
            return Tex(rf"\neg {_at_least(parts[0], _ATOM)}", _LOGIC)
        case _ if function in _RELATIONS:
            a, b = (_at_least(part, _SUM) for part in parts)
            return Tex(f"{a} {_RELATIONS[function]} {b}", _COMPARE)
        case _ if function in _LOGICAL:
            return Tex(
                f" {_LOGICAL[function]} ".join(_at_least(p, _COMPARE) for p in parts), _LOGIC
            )
        case _:
            return Tex(rf"{_OPERATORS[function]}\left({', '.join(texts)}\right)", _POWER)


def _of_vector(function: str, texts: list[str]) -> Tex:
    """Return a norm or a saturation; the components of a vector stand in brackets."""
    first, rest = texts[0], texts[1:]
    match function:
        case "norm":
            inner = rf"\left({', '.join(texts)}\right)" if rest else first
            return Tex(rf"\left\|{inner}\right\|", _ATOM)
        case "shrink":
            return Tex(rf"\min\left(1, \frac{{{first}}}{{{rest[0]}}}\right)", _POWER)
        case _:
            inner = rf"\left({', '.join(rest)}\right)" if len(rest) > 1 else rest[0]
            return Tex(rf"\operatorname{{sat}}\left({first}, {inner}\right)", _POWER)


def _at_least(part: Tex, level: int) -> str:
    return part.text if part.level >= level else rf"\left({part.text}\right)"


def _fraction(over: Expr, parts: list[Tex], env: Environment) -> Tex:
    """Return a fraction, its minus in front and no brackets around what stands above."""
    match over:
        case Call("neg", (inner,)):
            sign, above = "-", lower(inner, env)
        case _:
            sign, rest = _sign(parts[0])
            above = rest.text
    return Tex(rf"{sign}\frac{{{above}}}{{{parts[1].text}}}", _MINUS if sign else _POWER)


def _sign(part: Tex) -> tuple[str, Tex]:
    """Take a leading minus off what is one product."""
    if part.level == _MINUS and part.text.startswith("-"):
        return "-", Tex(part.text[1:], _PRODUCT)
    return "", part


def _terms(parts: list[Tex]) -> str:
    text = _at_least(parts[0], _SUM)
    for part in parts[1:]:
        sign, term = _sign(part)
        text += f" {sign or '+'} {_at_least(term, _PRODUCT)}"
    return text


_SHORT = re.compile(r"(\\[A-Za-z]+|[A-Za-z0-9])(_\{[A-Za-z0-9,]*\})?")


def _product(left: Tex, right: Tex) -> str:
    """Return two factors side by side, with some space unless both are short."""
    a, b = _at_least(left, _PRODUCT), _at_least(right, _POWER)
    if b[0].isdecimal():
        return rf"{a} \cdot {b}"
    tight = _SHORT.fullmatch(a.rsplit(" ", 1)[-1]) and _SHORT.fullmatch(b)
    return f"{a} {b}" if tight else rf"{a} \, {b}"


def _cases(expr: If, env: Environment) -> Tex:
    rows = []
    rest: Expr = expr
    while isinstance(rest, If):
        rows.append(rf"{lower(rest.then, env)} & \text{{if }} {lower(rest.condition, env)}")
        rest = rest.otherwise
    rows.append(rf"{lower(rest, env)} & \text{{otherwise}}")
    body = r" \\ ".join(rows)
    return Tex(rf"\begin{{cases}} {body} \end{{cases}}", _CHOICE)
