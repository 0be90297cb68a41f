"""Expressions as a person writes them in a model."""

from __future__ import annotations

from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import DOT_SUFFIX, RATE_SUFFIX

_CHOICE, _OR, _AND, _NOT, _COMPARE, _SUM, _MINUS, _PRODUCT, _POWER, _ATOM = range(10)

Text = tuple[str, int]


def plain(expr: Expr) -> str:
    """Return an expression in the language of the models."""
    return _plain(expr)[0]


def number(value: float) -> str:
    """Return a number in as few characters as keep its value."""
    short = f"{value:g}"
    return short if float(short) == value or value != value else repr(value)


def name(id: str, at: Index | None = None) -> str:
    """Return a name, or an element of a family: ``p.x`` at i+1 is ``p[i+1].x``."""
    for suffix in (DOT_SUFFIX, RATE_SUFFIX):
        if id.endswith(suffix):
            return f"der({name(id.removesuffix(suffix), at)})"
    if at is None:
        return id
    head, dot, tail = id.partition(".")
    return f"{head}[{plain(at)}]{dot}{tail}"


def over(range: IndexRange | None) -> str:
    """Return the range behind a definition of a family."""
    if range is None or len(range) == 1:
        return ""
    return f"  for {range.variable} in {range.first}..{range.last}"


def _plain(expr: Expr) -> Text:
    match expr:
        case Number(value):
            text = number(value)
            return text, _MINUS if text.startswith("-") else _ATOM
        case Index(None, offset):
            return str(offset), _ATOM if offset >= 0 else _MINUS
        case Index(str() as variable, offset):
            return (f"{variable}{offset:+d}", _SUM) if offset else (variable, _ATOM)
        case Name(id, at):
            return name(id, at), _ATOM
        case Call(function, args):
            return _call(function, args)
        case If(condition, then, otherwise):
            c, a, b = (plain(part) for part in (condition, then, otherwise))
            return f"if {c} then {a} else {b}", _CHOICE
        case Sum(range, body):
            inner = f"{range.variable} in {range.first}..{range.last}: {plain(body)}"
            return f"sum({inner})", _ATOM
    raise NotImplementedError(f"no text for {type(expr).__name__}")


def _call(function: str, args: tuple[Expr, ...]) -> Text:
    parts = [_plain(arg) for arg in args]
    match function:
        case "+":
            return _terms(parts), _SUM
        case "neg":
            return f"-{_at_least(parts[0], _PRODUCT)}", _MINUS
        case "*" | "/":
            left, right = _at_least(parts[0], _MINUS), _at_least(parts[1], _POWER)
            return f"{left}{function}{right}", _MINUS if left.startswith("-") else _PRODUCT
        case "^":
            return f"{_at_least(parts[0], _ATOM)}^{_at_least(parts[1], _POWER)}", _POWER
        case "and" | "or":
            level = _AND if function == "and" else _OR
            return f" {function} ".join(_at_least(part, level + 1) for part in parts), level
        case "not":
            return f"not {_at_least(parts[0], _NOT)}", _NOT
        case "<" | "<=" | ">" | ">=" | "==" | "!=":
            return f" {function} ".join(_at_least(part, _SUM) for part in parts), _COMPARE
        case "shrink":
            return f"min(1, {_at_least(parts[0], _MINUS)}/{_at_least(parts[1], _POWER)})", _ATOM
        case "sat" if len(parts) > 2:
            return f"sat({parts[0][0]}, [{', '.join(text for text, _ in parts[1:])}])", _ATOM
        case "norm" if len(parts) > 1:
            return f"norm([{', '.join(text for text, _ in parts)}])", _ATOM
        case _:
            return f"{function}({', '.join(text for text, _ in parts)})", _ATOM


def _at_least(part: Text, level: int) -> str:
    return part[0] if part[1] >= level else f"({part[0]})"


def _terms(parts: list[Text]) -> str:
    text = _at_least(parts[0], _SUM)
    for part in parts[1:]:
        term = _at_least(part, _MINUS)
        text += f" - {term[1:]}" if term.startswith("-") else f" + {term}"
    return text
