"""Equations as written become scalar rows, linear in the derivatives of the states."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from nsode.diagnostics import refuse
from nsode.expr import Call, Expr, Name, names
from nsode.inclusion.definitions import Definitions
from nsode.inclusion.elaborate import elaborate
from nsode.inclusion.equations import Row, derivative_name, is_unknown, row
from nsode.inclusion.indices import index_range
from nsode.inclusion.kinds import number
from nsode.inclusion.report import Report
from nsode.inclusion.review import Review
from nsode.inclusion.symbols import Scope, Symbols
from nsode.inclusion.values import Value, describe, each, from_scalars, scalars, shape
from nsode.syntax import ast


@dataclass(slots=True)
class Rows:
    """The equations of a model."""

    symbols: Symbols
    review: Review
    definitions: Definitions
    rows: list[Row] = field(default_factory=list)
    _written: list[ast.Equation] = field(default_factory=list)

    def hoist(self, equation: ast.Equation) -> None:
        """Take the set-valued terms out of an equation."""
        hoister = self.definitions.hoister
        self._written.append(
            replace(
                equation,
                left=hoister.hoist(equation.left, equation.range),
                right=hoister.hoist(equation.right, equation.range),
            )
        )

    def elaborate(self, report: Report) -> None:
        """Turn every equation into rows."""
        for equation in self._written:
            with report.collecting():
                self._equation(equation)

    def _equation(self, equation: ast.Equation) -> None:
        scope = Scope(self.symbols, derivative=self._derivative)
        over = index_range(equation.range, scope)
        inner = scope.with_index(over)
        left = each(number, elaborate(equation.left, inner))
        right = each(number, elaborate(equation.right, inner))
        if shape(left) != shape(right):
            raise refuse(
                "NS105",
                f"{describe(shape(left))} on the left, {describe(shape(right))} on the right",
                equation.span,
                help="both sides of an equation have one shape",
            )
        self.review.check(left)
        self.review.check(right)
        for one, other in zip(scalars(left), scalars(right), strict=True):
            self.rows.append(row(one, other, over, equation.span))

    def _derivative(self, call: Call, scope: Scope) -> Value:
        value = elaborate(call.args[0], scope)
        parts = scalars(value)
        if any(is_unknown(name) for part in parts for name in names(part)):
            raise refuse(
                "NS112",
                "`der` cannot stand inside `der`",
                call.span,
                "a second derivative",
                help="declare the first derivative as a state: `der(p) = v` and `der(v) = ...`",
            )
        if all(isinstance(part, Name) and self._is_state(part) for part in parts):
            return from_scalars(tuple(_unknown(part, call) for part in parts), shape(value))
        return self.definitions.in_time.derivative(value, call, scope)

    def _is_state(self, name: Name) -> bool:
        head = name.id.partition(".")[0].partition("[")[0]
        symbol = self.symbols.known.get(head)
        return symbol is not None and symbol.kind == "state"


def _unknown(part: Expr, call: Call) -> Name:
    assert isinstance(part, Name)
    return Name(derivative_name(part.id), part.at, span=call.span)
