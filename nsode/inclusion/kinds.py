"""Numbers, and conditions that are true or false."""

from __future__ import annotations

from nsode.diagnostics import refuse
from nsode.expr import FUNCTIONS, Call, Expr


def number(value: Expr, what: str = "this") -> Expr:
    """Refuse a condition where a number is wanted.

    Raises
    ------
    ModelError
        NS117.
    """
    if is_condition(value):
        raise refuse(
            "NS117",
            f"{what} must be a number",
            value.span,
            "this is true or false",
            help="write `if ... then 1 else 0`",
        )
    return value


def is_condition(expr: Expr) -> bool:
    """Tell whether an expression is true or false rather than a number."""
    return (
        isinstance(expr, Call) and expr.function in FUNCTIONS and (FUNCTIONS[expr.function].boolean)
    )
