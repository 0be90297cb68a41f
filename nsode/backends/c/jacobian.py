"""The Jacobian in C: compressed columns, families in loops over tables of places."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING, NamedTuple

from nsode.backends.c.expressions import lower
from nsode.backends.c.plan import Scatter
from nsode.backends.jacobian import SparseJacobian
from nsode.derivative import Pattern
from nsode.expr import Index

if TYPE_CHECKING:
    from nsode.backends.c.function import Writer
    from nsode.backends.c.program import Program

_PLACES, _ROWS, _COLUMNS = "jac_places", "jac_rows", "jac_columns"


class Arranged(NamedTuple):
    """The pattern and the work of a Jacobian; the places of its families in one table.

    ``adds`` tells that some place gets more than one value, so that all begin with zero.
    """

    pattern: Pattern
    work: tuple[Scatter, ...]
    places: tuple[int, ...]
    adds: bool

    @property
    def size(self) -> int:
        """How many values the Jacobian has."""
        return len(self.pattern.rows)


def arranged(sparse: SparseJacobian) -> Arranged:
    """Return what a Jacobian has to compute."""
    pattern = sparse.pattern()
    singles = Counter(pattern.places[p.number][0] for p in sparse.pieces if not p.ranges)
    families = any(piece.ranges for piece in sparse.pieces)
    adds = families or len(singles) < len(pattern.rows) or max(singles.values(), default=1) > 1
    work: list[Scatter] = []
    places: list[int] = []
    starts: dict[int, int] = {}
    for piece in sparse.pieces:
        here = pattern.places[piece.number]
        if not piece.ranges:
            work.append(Scatter(piece.value, adds, here[0]))
            continue
        if piece.number not in starts:
            starts[piece.number] = len(places)
            places.extend(here)
        start, outside = starts[piece.number], min(here) < 0
        outer, *inner = piece.ranges
        work.append(Scatter(piece.value, adds, start, outer, tuple(inner), piece.first, outside))
    return Arranged(pattern, tuple(work), tuple(places), adds)


def write(work: Scatter, writer: Writer) -> None:
    """Write one value, or the loops over those of a family."""
    sign = "+=" if work.adds else "="
    if work.range is None:
        writer.line(f"J[{work.place}] {sign} {lower(work.value, writer)};")
        return
    place = writer.index(Index(work.range.variable, -work.first))
    with ExitStack() as loops:
        for over in work.inner:
            variable = loops.enter_context(writer.loop(over))
            loops.enter_context(writer.inside(over, variable))
            own = f"{variable} - {over.first}" if over.first else variable
            place = f"({place})*{len(over)} + {own}"
        target = f"{_PLACES}[{work.place} + {place}]" if work.place else f"{_PLACES}[{place}]"
        value = lower(work.value, writer)
        if work.outside:
            writer.line(f"if ({target} >= 0) {{")
            writer.line(f"    J[{target}] {sign} {value};")
            writer.line("}")
        else:
            writer.line(f"J[{target}] {sign} {value};")


def cleared(program: Program) -> list[str]:
    """Return the lines that set the Jacobian to zero, where it is added up."""
    if not program.jacobian.adds or not program.jacobian.size:
        return []
    return [
        f"    for (int k = 0; k < {program.prefix}_JAC_NNZ; ++k) {{",
        "        J[k] = 0;",
        "    }",
    ]


def tables(program: Program) -> Iterator[str]:
    """Yield the pattern, and the places of the values of families."""
    pattern = program.jacobian.pattern
    yield _table(_ROWS, pattern.rows)
    yield _table(_COLUMNS, pattern.columns)
    if program.jacobian.places:
        yield _table(_PLACES, program.jacobian.places)


def fill(program: Program) -> list[str]:
    """Return the lines that hand out the pattern."""
    prefix = program.prefix
    return [
        f"    for (int k = 0; k < {prefix}_JAC_NNZ; ++k) {{",
        f"        row[k] = {_ROWS}[k];",
        "    }",
        f"    for (int k = 0; k <= {prefix}_NX; ++k) {{",
        f"        col[k] = {_COLUMNS}[k];",
        "    }",
        f"    return {prefix}_OK;",
    ]


def _table(name: str, values: Sequence[int]) -> str:
    texts = [str(value) for value in values] or ["0"]
    rows = ",\n    ".join(", ".join(texts[k : k + 16]) for k in range(0, len(texts), 16))
    return f"static const int {name}[] = {{\n    {rows}\n}};\n"
