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
    outputs
        Pairs of output and value.
    auxiliary
        The states that the rewrite appended.
    defaults
        Values of the parameters, for ``subs``.
    typeset
        Each symbol as TeX, as :mod:`nsode.backends.latex` prints it.
    """

    name: str
    symbols: Mapping[str, sp.Basic]
    ranges: Mapping[str, tuple[int, int]]
    bindings: tuple[tuple[sp.Basic, sp.Expr], ...]
    solves: tuple[Solve, ...]
    rates: tuple[tuple[sp.Basic, sp.Expr], ...]
    outputs: tuple[tuple[sp.Basic, sp.Expr], ...]
    auxiliary: tuple[sp.Basic, ...]
    defaults: Mapping[sp.Symbol, sp.Number]
    typeset: Mapping[sp.Symbol, str]

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

    def latex(self, expression: sp.Basic) -> str:
        """Return an expression as TeX with names as the paper prints them."""
        import sympy as sp

        text: str = sp.latex(expression, symbol_names=dict(self.typeset))
        return text

    def _repr_latex_(self) -> str:
        states = column(self.latex(state) for state, _ in self.rates)
        rates = column(self.latex(rate) for _, rate in self.rates)
        return rf"$\displaystyle \frac{{\mathrm{{d}}}}{{\mathrm{{d}}t}} {states} = {rates}$"
