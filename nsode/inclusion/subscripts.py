"""Subscripts of families must stay in range."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from nsode.diagnostics import ModelError, refuse
from nsode.expr import Expr, IndexRange, Name, Sum, children
from nsode.inclusion.families import Axes, cases, elements
from nsode.inclusion.report import Report
from nsode.ode import DifferentialInclusion, Placed, defined, expressions


@dataclass(frozen=True, slots=True)
class Bounds:
    """Refuses subscripts outside the range of their family; ``ranges`` has every family."""

    ranges: Mapping[str, IndexRange]

    def check(self, exprs: Iterable[Expr], over: IndexRange | None) -> None:
        """Check expressions that stand together under one index range.

        An ``if`` on indices alone is decided first: its dead branch may be out of range.

        Raises
        ------
        ModelError
            NS109.
        """
        for expr in exprs:
            for case in cases(expr, over):
                self._walk(*case)

    def _walk(self, expr: Expr, over: Axes) -> None:
        match expr:
            case Name(id) if id in self.ranges:
                family = self.ranges[id]
                low, high = elements(expr.at, over)
                if low < family.first or high > family.last:
                    raise _outside(expr, low if low < family.first else high, family)
            case Sum(inner, body):
                self._walk(body, (*over, inner))
            case _:
                for child in children(expr):
                    self._walk(child, over)


def _outside(expr: Name, k: int, family: IndexRange) -> ModelError:
    head = expr.id.partition(".")[0]
    way_out = "write an element that exists"
    if expr.at is not None and expr.at.variable is not None:
        index = expr.at.variable
        edge = f"> {family.first}" if k < family.first else f"< {family.last}"
        way_out = f"shorten the range, or write `(if {index} {edge} then ... else ...)`"
    return refuse(
        "NS109",
        f"`{head}[{k}]` does not exist",
        expr.span,
        f"`{head}` goes from {family.first} to {family.last}",
        help=way_out,
    )


def check_subscripts(inclusion: DifferentialInclusion, report: Report) -> None:
    """Report subscripts outside the range of their family, wherever they stand."""
    families = {name: over for name, over in _defined(inclusion) if over is not None}
    bounds = Bounds(families)
    for exprs, over in _standing(inclusion):
        with report.collecting():
            bounds.check(exprs, over)


def _defined(inclusion: DifferentialInclusion) -> Iterator[tuple[str, IndexRange | None]]:
    items: tuple[Placed, ...] = (*inclusion.states, *inclusion.inputs, *inclusion.parameters)
    yield from ((item.name, item.range) for item in items)
    yield from ((name, item.range) for item in inclusion.bindings for name in defined(item))


def _standing(
    inclusion: DifferentialInclusion,
) -> Iterator[tuple[Sequence[Expr], IndexRange | None]]:
    """Yield every expression with the range under which it stands."""
    for item in inclusion.bindings:
        yield expressions(item), item.range
    for term in inclusion.terms:
        yield [value for _, value in term.approximation.constants], None
    yield from (([rate.value], rate.range) for rate in inclusion.rates)
    yield from (([output.value], output.range) for output in inclusion.outputs)
    yield from (([state.initial], state.range) for state in inclusion.states)
    yield from (([check.condition], check.range) for check in inclusion.checks)
