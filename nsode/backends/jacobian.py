"""The Jacobian of an ODE on its way to a backend: what to compute, and where it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from nsode.derivative import Entry, Pattern, jacobian, pattern
from nsode.expr import Expr, IndexRange, Name, Number
from nsode.ode import AugmentedODE, layout
from nsode.passes.share import Value, share
from nsode.passes.split import pieces, settle


@dataclass(frozen=True, slots=True)
class Piece:
    """Values of one entry: ``value`` over the ranges, the outermost in one piece.

    ``row`` and ``column`` are the states that it derives, and by which. ``number`` is that
    of the entry, whose outermost range begins at ``first``.
    """

    row: Name
    column: Name
    value: Expr
    ranges: tuple[IndexRange, ...]
    number: int
    first: int = 0


@dataclass(frozen=True, slots=True)
class SparseJacobian:
    """An ODE extended by what its Jacobian reads, the entries, and their pieces."""

    ode: AugmentedODE
    entries: tuple[Entry, ...]
    pieces: tuple[Piece, ...]

    def pattern(self) -> Pattern:
        """Return where every value of every entry stands."""
        states = layout(self.ode.states)
        return pattern(self.entries, states, states)


def sparse_jacobian(ode: AugmentedODE) -> SparseJacobian:
    """Return the Jacobian of an ODE that is not in pieces yet."""
    found = jacobian(ode)
    kept = [piece for n, entry in enumerate(found.entries) for piece in _pieces(entry, n)]
    values = [Value(p.value, p.ranges[0] if len(p.ranges) == 1 else None) for p in kept]
    bindings, shared = share(ode.bindings, found.definitions, values)
    return SparseJacobian(
        replace(ode, bindings=tuple(bindings)),
        found.entries,
        tuple(replace(p, value=value) for p, value in zip(kept, shared, strict=True)),
    )


def _pieces(entry: Entry, number: int) -> Sequence[Piece]:
    """Break an entry where its value changes; pieces that are zero go."""
    if not entry.ranges:
        value = settle(entry.value)
        return [] if value == _ZERO else [Piece(entry.row, entry.column, value, (), number)]
    outer, *inner = entry.ranges
    return [
        Piece(entry.row, entry.column, value, (over, *inner), number, outer.first)
        for over, (value,) in pieces(outer, entry.value)
        if value != _ZERO
    ]


_ZERO = Number(0.0)
