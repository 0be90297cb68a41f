"""What a person explores."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from nsode.backends.latex.equations import column

if TYPE_CHECKING:
    import sympy as sp


class Solve(NamedTuple):
    """``matrix * unknowns = right``."""

    matrix: sp.Matrix
    unknowns: tuple[sp.Basic, ...]
    right: sp.Matrix


@dataclass(frozen=True, slots=True, eq=False)
class SymbolicSystem:
    """An augmented ODE as SymPy objects, each definition by its own name.

    Names are real symbols, families ``IndexedBase`` objects with an integer index.
    ``max``, ``sat`` and the like stay closed (:mod:`nsode.backends.sympy.opaque`), and
    nothing is substituted: :meth:`expand` does that for one expression when asked.

    Attributes
    ----------
    symbols
        The symbol of each name: ``system.symbols["N.K"]``.
    ranges
        First and last index of each family.
    bindings
        Pairs of symbol and value, in an order that computes.
    solves
        Linear systems that define their unknowns.
    rates
        Pairs of state and rate; the auxiliary states come last.
    limits
        The index of each of these rates with its first and last value, as a SymPy ``Sum``
        has it; None for what is no family.
    outputs
        Pairs of output and value.
    auxiliary
        The states that the rewrite appended.
    defaults
        Values of the parameters, for ``subs``.
    multipliers, W
        The set-valued forces, and the effective inverse mass (Delassus matrix) that tells
        what each does to each gap and each slip; None for families and where it has kinks.
    """

    name: str
    symbols: Mapping[str, sp.Basic]
    ranges: Mapping[str, tuple[int, int]]
    bindings: tuple[tuple[sp.Basic, sp.Expr], ...]
    solves: tuple[Solve, ...]
    rates: tuple[tuple[sp.Basic, sp.Expr], ...]
    limits: tuple[tuple[sp.Symbol, int, int] | None, ...]
    outputs: tuple[tuple[sp.Basic, sp.Expr], ...]
    auxiliary: tuple[sp.Basic, ...]
    defaults: Mapping[sp.Symbol, sp.Number]
    multipliers: tuple[str, ...] = ()
    W: sp.ImmutableMatrix | None = None

    def rate(self, state: str) -> sp.Expr:
        """Return the rate of a scalar state, in terms of bindings.

        Raises
        ------
        KeyError
            If there is no such state.
        """
        return dict(self.rates)[self.symbols[state]]

    def expand(self, expression: sp.Expr) -> sp.Expr:
        """Return an expression with every scalar binding replaced by its value.

        This may grow exponentially with the depth of the bindings.
        """
        for symbol, value in reversed(self.bindings):
            expression = expression.xreplace({symbol: value})
        return expression

    def _repr_latex_(self) -> str:
        sides = zip(*self.rates, strict=True)
        states, rates = (column(map(_spread, side, self.limits)) for side in sides)
        return rf"$\displaystyle \frac{{\mathrm{{d}}}}{{\mathrm{{d}}t}} {states} = {rates}$"


def _spread(value: sp.Basic, limits: tuple[sp.Symbol, int, int] | None) -> str:
    """Return a value as TeX, or those of all elements of a family."""
    from sympy import latex

    text: str = latex(value)
    return text if limits is None else r"\left({}\right)_{{{}={}}}^{{{}}}".format(text, *limits)
