"""What the rates of a system rest on, set-valued terms included."""

from __future__ import annotations

from nsode.expr import Expr, Index, IndexRange, Name, Sum, rebuild
from nsode.ode import Definition, System, defined, expressions
from nsode.passes.prune import reads


def behind(system: System) -> list[Definition]:
    """Return the definitions that the rates rest on, in order."""
    wanted = reads(*(rate.value for rate in system.rates))
    kept: list[Definition] = []
    for item in reversed(system.bindings):
        if not wanted.isdisjoint(defined(item)):
            wanted |= reads(*expressions(item))
            kept.append(item)
    return kept[::-1]


def fixed(expr: Expr, range: IndexRange | None) -> Expr:
    """Return an expression with the index of a range of one element put in."""
    if range is None or len(range) != 1:
        return expr

    def put(node: Expr) -> Expr:
        match node:
            case Index(variable, offset) if variable == range.variable:
                return Index(None, range.first + offset)
            case Name(id, Index(variable, offset)) if variable == range.variable:
                return Name(id, Index(None, range.first + offset))
            case Sum(inner) if inner.variable == range.variable:
                return node
            case _:
                return rebuild(node, put)

    return put(expr)
