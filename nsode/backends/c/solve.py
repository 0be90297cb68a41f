"""Linear systems in generated C: small ones written out, larger ones factorized."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING

from nsode.backends.c.expressions import lower
from nsode.ode import LinearSolve

if TYPE_CHECKING:
    from nsode.backends.c.function import Writer


def write(solve: LinearSolve, writer: Writer) -> None:
    """Write the solution of a linear system; a singular one leaves the function."""
    entries = [lower(entry, writer) for entry in chain.from_iterable(solve.matrix)]
    right = [lower(entry, writer) for entry in solve.right]
    if len(right) == 1:
        _divide(solve, entries[0], right[0], writer)
        return
    matrix, vector = writer.fresh("matrix"), writer.fresh("vector")
    writer.line(f"real {matrix}[] = {{{', '.join(entries)}}};")
    writer.line(f"real {vector}[] = {{{', '.join(right)}}};")
    _leave_if(f"!{_call(len(right), matrix, vector, writer)}", writer)
    for row, unknown in enumerate(solve.unknowns):
        if unknown in writer.plan.read:
            writer.define(unknown, solve.range, f"{vector}[{row}]")


def _divide(solve: LinearSolve, divisor: str, right: str, writer: Writer) -> None:
    pivot, value = writer.fresh("pivot"), writer.fresh("value")
    writer.line(f"const real {pivot} = {divisor};")
    writer.line(f"const real {value} = {right};")
    _leave_if(f"{pivot} == 0", writer)
    writer.define(solve.unknowns[0], solve.range, f"{value}/{pivot}")


def _call(n: int, matrix: str, vector: str, writer: Writer) -> str:
    if n == 2:
        writer.use("solve2")
        return f"solve2({matrix}, {vector})"
    # From three on, cofactors lose more digits than the condition of the matrix costs.
    writer.use("solve")
    size = writer.fresh("size")
    writer.line(f"real {size}[{n}];")
    return f"solve({n}, {matrix}, {vector}, {size})"


def _leave_if(test: str, writer: Writer) -> None:
    writer.line(f"if ({test}) {{")
    writer.line(f"    return {writer.program.prefix}_SINGULAR;")
    writer.line("}")
