"""The unit of an expression, as far as the declared units tell.

What is unknown never disagrees with anything.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from nsode.diagnostics import Diagnostic, Label
from nsode.dimension import ONE
from nsode.expr import Call, Expr, If, Index, Name, Number, Sum
from nsode.inclusion.units import messages
from nsode.inclusion.units.quantity import (
    DIMENSIONLESS,
    FITTING,
    NUMBER,
    UNKNOWN,
    Quantity,
    over,
    times,
    to_the,
)
from nsode.source import Span

_COMPARED = "compared"
#: Functions whose arguments have one unit, with what else cannot be done with them.
_ALIKE = {
    "+": "added",
    **dict.fromkeys(("min", "max", "<", "<=", ">", ">=", "==", "!="), _COMPARED),
    **dict.fromkeys(("sat", "shrink"), _COMPARED),
    "mod": "divided with a remainder",
    "atan2": "the two sides of an angle",
    "norm": "components of one vector",
}
_NUMERIC = {
    *("sin", "cos", "tan", "asin", "acos", "atan"),
    *("sinh", "cosh", "tanh", "exp", "log"),
}
_LIKE_ITS_ARGUMENTS = {"+", "min", "max", "sat", "mod", "norm"}
_CONDITIONS = {"<", "<=", ">", ">=", "==", "!=", "and", "or", "not"}


@dataclass(slots=True)
class Inference:
    """Finds the units of expressions from those of names, and what does not fit.

    ``places`` tells where the unit of a name was declared; ``found`` has the errors,
    one for each place.
    """

    known: dict[str, Quantity]
    places: Mapping[str, Span]
    found: dict[Span, Diagnostic] = field(default_factory=dict)

    def add(self, problem: Diagnostic) -> None:
        """Keep an error, unless something was already said of its place."""
        self.found.setdefault(problem.labels[0].span, problem)

    def of(self, expr: Expr) -> Quantity:
        """Return what is known of the unit of an expression."""
        match expr:
            case Name(id):
                return self.known.get(id, UNKNOWN)
            case Number() | Index():
                return NUMBER
            case Call(_, args):
                return self._call(expr, [self.of(arg) for arg in args])
            case If():
                return self._branches(expr)
            case Sum(_, body):
                return self.of(body)
        raise NotImplementedError(f"no unit for {type(expr).__name__}")

    def _call(self, expr: Call, values: Sequence[Quantity]) -> Quantity:
        match expr.function:
            case "*":
                return times(*values)
            case "/":
                return over(*values)
            case "neg" | "abs":
                return values[0]
            case "^":
                return self._power(expr, *values)
            case "sqrt":
                return to_the(values[0], Fraction(1, 2))
        if expr.function in _ALIKE:
            common = self.alike(expr.args, values, _ALIKE[expr.function])
            if expr.function in _LIKE_ITS_ARGUMENTS:
                return common
            return UNKNOWN if expr.function in _CONDITIONS else _ratio(common)
        if expr.function in _CONDITIONS:
            return UNKNOWN
        if expr.function in _NUMERIC:
            return self._numeric(expr, values[0])
        raise NotImplementedError(f"no rule for the unit of `{expr.function}`")

    def alike(self, parts: Iterable[Expr], values: Iterable[Quantity], relation: str) -> Quantity:
        """Return the one unit of several parts; ``relation`` is what joins them."""
        first: tuple[Expr, Quantity] | None = None
        common: Quantity | None = None
        for part, value in zip(parts, values, strict=True):
            if value.rigid is None:
                common = value if common is None else _loose(common, value)
            elif first is None:
                first = part, value
            elif value.dimension is not first[1].dimension:
                self._disagree(part, value, *first, relation)
                return UNKNOWN
        if first is not None:
            return first[1]
        return UNKNOWN if common is None else common

    def _branches(self, expr: If) -> Quantity:
        parts: list[Expr] = []
        rest: Expr = expr
        while isinstance(rest, If):  # a list over a family is a long chain
            self.of(rest.condition)
            parts.append(rest.then)
            rest = rest.otherwise
        parts.append(rest)
        return self.alike(parts, [self.of(part) for part in parts], "branches of one `if`")

    def _power(self, expr: Call, base: Quantity, exponent: Quantity) -> Quantity:
        self.must_be_number("an exponent", expr.args[1], exponent)
        if base.dimension is ONE:
            return NUMBER if base.flexible and exponent.flexible else DIMENSIONLESS
        value = rational(expr.args[1])
        if value is not None:
            return to_the(base, value)
        return FITTING if base.flexible and exponent.flexible else UNKNOWN

    def _numeric(self, expr: Call, value: Quantity) -> Quantity:
        self.must_be_number(f"the argument of `{expr.function}`", expr.args[0], value)
        if not value.flexible:
            return DIMENSIONLESS
        return NUMBER if value.dimension is ONE else FITTING

    def must_be_number(self, what: str, expr: Expr, value: Quantity) -> None:
        """Refuse a value that is known to have a unit."""
        if value.rigid is not None and value.rigid is not ONE:
            self.add(messages.no_number(what, value, expr.span, *self._places(expr)))

    def _disagree(
        self, odd: Expr, value: Quantity, first: Expr, expected: Quantity, relation: str
    ) -> None:
        odd, first = _unsigned(odd), _unsigned(first)
        places = (*self._places(odd), *self._places(first))
        self.add(messages.disagreement(value, odd.span, expected, first.span, relation, *places))

    def _places(self, expr: Expr) -> list[Label]:
        match expr:
            case Name(id) if (name := head(id)) in self.places:
                return [Label(self.places[name], f"`{name}` is declared here")]
        return []


def head(name: str) -> str:
    """Return the declared name that a component belongs to: ``p`` for ``p.x`` and ``q[1]``."""
    return name.partition(".")[0].partition("[")[0]


def _unsigned(expr: Expr) -> Expr:
    """Return an expression without the sign before it."""
    match expr:
        case Call("neg", (inner,)):
            return inner
    return expr


def _loose(one: Quantity, other: Quantity) -> Quantity:
    """Return what is known of parts that fit anywhere, or of which nothing is known."""
    if not (one.flexible and other.flexible):
        return UNKNOWN
    return one if one.dimension is other.dimension else FITTING


def _ratio(common: Quantity) -> Quantity:
    return NUMBER if common.flexible else DIMENSIONLESS


def rational(expr: Expr) -> Fraction | None:
    """Return the value of an exponent made of numbers, None for any other."""
    match expr:
        case Number(value):
            return Fraction(repr(value))
        case Call("neg", (inner,)):
            negated = rational(inner)
            return None if negated is None else -negated
        case Call("/", (left, right)):
            above, below = rational(left), rational(right)
            return None if above is None or not below else above / below
    return None
