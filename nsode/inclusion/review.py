"""What arithmetic alone can refuse: undefined constants, huge exponents, growth."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

from nsode.diagnostics import refuse
from nsode.evaluate import apply
from nsode.expr import Call, Expr, Number, Sum, children
from nsode.inclusion.values import Value, scalars
from nsode.limits import Limits, either


class _Seen(NamedTuple):
    size: int
    constant: float | None
    coefficient: float
    sums: int = 0
    terms: int = 1


@dataclass(slots=True)
class Review:
    """Looks at each expression once, however often it is shared."""

    limits: Limits
    _seen: dict[int, _Seen] = field(default_factory=dict)
    _kept: list[Value] = field(default_factory=list)

    def check(self, value: Value) -> None:
        """Refuse what cannot be computed.

        Raises
        ------
        ModelError
            NS013 for a huge exponent, NS116 for a constant that is infinite or no
            number, NS011 and NS014 for an expression that grows too large.
        """
        self._kept.append(value)
        size = 0
        for component in scalars(value):
            size += self._look(component).size
            if size > self.limits.operations:
                raise refuse(
                    "NS011",
                    f"more than {self.limits.operations:,} operations when its vectors and "
                    "derivatives are written out",
                    component.span,
                    help=either(
                        "name intermediate results with `let`", self.limits.raised("operations")
                    ),
                )

    def _look(self, expr: Expr) -> _Seen:
        found = self._seen.get(id(expr))
        if found is None:
            parts = [self._look(child) for child in children(expr)]
            found = self._seen[id(expr)] = self._combine(expr, parts)
        return found

    def _combine(self, expr: Expr, parts: list[_Seen]) -> _Seen:
        if isinstance(expr, Number):
            return _Seen(1, expr.value, expr.value)
        if not parts:
            return _Seen(1, None, 1.0)
        size = 1 + sum(part.size for part in parts)
        sums = max((part.sums for part in parts), default=0)
        terms = max((part.terms for part in parts), default=1)
        if isinstance(expr, Sum):
            sums, terms = sums + 1, terms * max(1, len(expr.range))
            self._check_sums(expr, sums, terms)
        if not isinstance(expr, Call):
            return _Seen(size, None, 1.0, sums, terms)
        constants = [part.constant for part in parts]
        if expr.function == "^":
            _check_exponent(expr, constants[1], self.limits)
        known = [constant for constant in constants if constant is not None]
        if len(known) == len(constants):
            value = apply(expr.function, *known)
            if not math.isfinite(value):
                raise refuse(
                    "NS116",
                    f"this constant is {in_words(value)}",
                    expr.span,
                    help="check the numbers that go into it",
                )
            return _Seen(size, value, value)
        return _Seen(size, None, _coefficient(expr, parts), sums, terms)

    def _check_sums(self, expr: Sum, sums: int, terms: int) -> None:
        limits = self.limits
        if sums > limits.sums:
            raise refuse(
                "NS011",
                f"more than {limits.sums} sums inside each other",
                expr.span,
                help=either("name an inner sum with `let`", limits.raised("sums", sums)),
            )
        if terms > limits.elements:
            raise refuse(
                "NS014",
                f"{terms:,} terms in sums inside each other are more than {limits.elements:,}",
                expr.span,
                help=either("shorten their ranges", limits.raised("elements", terms)),
            )


def _check_exponent(expr: Call, exponent: float | None, limits: Limits) -> None:
    if exponent is not None and abs(exponent) > limits.exponent:
        wanted = math.ceil(abs(exponent)) if math.isfinite(exponent) else 0
        raise refuse(
            "NS013",
            f"the exponent {exponent:g} is larger than {limits.exponent}",
            expr.args[1].span,
            "too large",
            help=either(
                "scale the quantity, write `exp(a*log(b))`", limits.raised("exponent", wanted)
            ),
        )


def _coefficient(expr: Call, parts: list[_Seen]) -> float:
    match expr.function:
        case "*":
            value = parts[0].coefficient * parts[1].coefficient
        case "/":
            value = apply("/", parts[0].coefficient, parts[1].coefficient)
        case "neg":
            return parts[0].coefficient
        case _:
            return 1.0
    if math.isinf(value):
        raise refuse(
            "NS116",
            "the numbers in this product multiply to infinity",
            expr.span,
            help="the largest number is 1.8e308: choose other units",
        )
    return value


def in_words(value: float) -> str:
    """Return what is wrong with a number."""
    return "not a number" if math.isnan(value) else "infinite"
