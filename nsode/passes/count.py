"""How much an ODE computes."""

from __future__ import annotations

from nsode.expr import Call, Expr, If, IndexRange, Sum, walk
from nsode.ode import AugmentedODE, Binding, LinearSolve
from nsode.passes.prune import needed, reads
from nsode.passes.split import split


def operations(ode: AugmentedODE) -> int:
    """Return the operations and function calls of one evaluation of the rates.

    A family counts once for each of its elements, a linear system of size n with n^3/3
    for its factorization; what the index decides costs nothing.
    """
    ode = split(ode)
    wanted = reads(*(rate.value for rate in ode.rates))
    total = sum(_times(rate.range) * _count(rate.value) for rate in ode.rates)
    for item in needed(ode.bindings, wanted):
        match item:
            case Binding(value=value):
                total += _times(item.range) * _count(value)
            case LinearSolve(unknowns, matrix, right):
                inner = [*right, *(entry for row in matrix for entry in row)]
                solving = len(unknowns) ** 3 // 3 + len(unknowns) ** 2
                total += _times(item.range) * (solving + sum(map(_count, inner)))
    return total


def _times(over: IndexRange | None) -> int:
    return 1 if over is None else len(over)


def _count(expr: Expr) -> int:
    total = 0
    for node in walk(expr):
        match node:
            case Call("+", args):
                total += len(args) - 1
            case Call("neg", _):
                pass
            case Call() | If():
                total += 1
            case Sum(over, body):
                total += (len(over) - 1) * (_count(body) + 1)
    return total
