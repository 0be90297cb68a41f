"""Equations as written become scalar rows, linear in the derivatives of the states."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from nsode import derivative as moving
from nsode.diagnostics import ModelError, refuse
from nsode.expr import TIME, Call, Expr, Index, Name, names
from nsode.inclusion.definitions import Definitions
from nsode.inclusion.elaborate import elaborate
from nsode.inclusion.equations import Row, derivative_name, is_unknown, row
from nsode.inclusion.indices import index_range
from nsode.inclusion.kinds import number
from nsode.inclusion.order import deepest_first
from nsode.inclusion.report import Report
from nsode.inclusion.review import Review
from nsode.inclusion.symbols import Scope, Symbol, Symbols
from nsode.inclusion.values import Value, describe, each, from_scalars, scalars, shape
from nsode.ode import Binding, DifferentialInclusion
from nsode.source import Source
from nsode.syntax import ast


@dataclass(slots=True)
class Rows:
    """The equations of a model; ``bindings`` are derivatives of functions of time."""

    symbols: Symbols
    review: Review
    definitions: Definitions
    rows: list[Row] = field(default_factory=list)
    bindings: dict[str, Binding] = field(default_factory=dict)
    _written: list[ast.Equation] = field(default_factory=list)
    _bound: dict[str, Binding] = field(default_factory=dict)

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
        return each(lambda part: self._of_time(part, call), value)

    def _is_state(self, name: Name) -> bool:
        head = name.id.partition(".")[0].partition("[")[0]
        symbol = self.symbols.known.get(head)
        return symbol is not None and symbol.kind == "state"

    def _of_time(self, expr: Expr, call: Call) -> Expr:
        """Return the derivative of a function of time; that of a let gets a name."""
        needed = self._needed(expr, call)
        system = DifferentialInclusion("", Source("", ""), (), (), (), needed, (), ())
        first = (_itself(binding) for binding in needed)  # so that no recursion follows names
        emitted, rows = moving.time_derivatives(system, *first, moving.Row("", expr))
        for item in emitted:
            assert isinstance(item, Binding)
            self.bindings[item.name] = item
        return rows[-1].value

    def _needed(self, expr: Expr, call: Call) -> tuple[Binding, ...]:
        """Return what a function of time rests on, in an order that computes."""
        if not self._bound:
            self._bound = {binding.name: binding for binding in self.definitions.bindings}

        def reads(value: Expr) -> list[str]:
            return [name.id for name in names(value) if self._moves(name, call)]

        found: dict[str, Binding] = {}
        for name in deepest_first(reads(expr), lambda n: reads(self._bound[n].value), found):
            found[name] = self._bound[name]
        return tuple(found.values())

    def _moves(self, name: Name, call: Call) -> bool:
        """Tell whether a name is defined by others; it must rest on time and parameters."""
        if name.id in self._bound:
            return True
        symbol = self.symbols.known.get(name.id.partition(".")[0].partition("[")[0])
        if name.id == TIME or (symbol is not None and symbol.kind == "parameter"):
            return False
        raise _no_function_of_time(name, symbol, call)


def _itself(binding: Binding) -> moving.Row:
    at = None if binding.range is None else Index(binding.range.variable)
    return moving.Row(binding.name, Name(binding.name, at), binding.range)


def _unknown(part: Expr, call: Call) -> Name:
    assert isinstance(part, Name)
    return Name(derivative_name(part.id), part.at, span=call.span)


def _no_function_of_time(name: Name, symbol: Symbol | None, call: Call) -> ModelError:
    kind = None if symbol is None else symbol.kind
    way_out = "write its derivative out with the chain rule"
    if kind == "input":
        way_out = "a function of time that is known is a `let` of `t`"
    return refuse(
        "NS112",
        "`der` takes a state, or a function of time alone",
        call.span,
        "holds a set-valued term" if kind == "term" else f"depends on `{name.id}`",
        help=way_out,
    )
