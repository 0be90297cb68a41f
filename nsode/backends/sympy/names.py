"""Names as SymPy objects that print as the model spells them and show as the paper does."""

from __future__ import annotations

import sympy as sp
from sympy.printing.latex import LatexPrinter

from nsode.backends.latex.names import Symbol as Typeset


class Named(sp.Symbol):  # type: ignore[misc]
    """A real symbol with a typeset form: ``N.beta`` in text, N as a subscript in a notebook."""

    __slots__ = ("typeset",)

    def __new__(cls, name: str, typeset: Typeset) -> Named:
        """Return the symbol of a name."""
        # Real, and never nonnegative: SymPy would take max(0, -psi) for 0.
        made: Named = sp.Symbol.__xnew__(cls, name, real=True)
        made.typeset = typeset
        return made

    def __getnewargs_ex__(self) -> tuple[tuple[str, Typeset], dict[str, bool]]:
        return (self.name, self.typeset), {}

    def _hashable_content(self) -> tuple[object, ...]:
        return (*super()._hashable_content(), str(self.typeset))

    def _latex(self, printer: LatexPrinter) -> str:
        return str(self.typeset)


class Family(sp.IndexedBase):  # type: ignore[misc]
    """A family, whose elements carry the index behind the subscripts that it has."""

    def __getitem__(self, index: sp.Expr) -> Element:
        return Element(self, index)


class Element(sp.Indexed):  # type: ignore[misc]
    """An element of a family."""

    def _latex(self, printer: LatexPrinter) -> str:
        typeset: Typeset = self.base.label.typeset
        return str(typeset.at(printer._print(self.indices[0])))
