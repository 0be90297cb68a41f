"""Functions that SymPy carries along without looking inside.

Its own ``Max``, ``Abs`` and ``Piecewise`` evaluate, in exponential time when nested, and
differentiate to ``Heaviside`` and ``DiracDelta``. These stay as they are; their
derivatives are those of one side at a kink, as :mod:`nsode.derivative.rules` states.
"""

from __future__ import annotations

from typing import ClassVar

import sympy as sp
from sympy.printing.latex import LatexPrinter


class Opaque(sp.Function):  # type: ignore[misc]
    """A real function that is never evaluated."""

    is_real = True
    tex: ClassVar[str | None] = None

    @classmethod
    def eval(cls, *args: sp.Expr) -> None:
        """Stay as it is."""
        return None

    def _latex(self, printer: LatexPrinter, exp: str | None = None) -> str:
        inner = ", ".join(printer._print(arg) for arg in self.args)
        name = self.tex or rf"\operatorname{{{type(self).__name__}}}"
        text = rf"{name}\left({inner}\right)"
        return text if exp is None else rf"{text}^{{{exp}}}"


def _gate(condition: sp.Basic, value: sp.Expr) -> sp.Expr:
    return choose(condition, value, sp.Integer(0))


class choose(Opaque):  # noqa: N801 - spelt as it prints
    """``choose(c, a, b)``: a where c holds, else b."""

    nargs = (3,)

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative by a branch; a condition has none."""
        condition, one, zero = self.args[0], sp.Integer(1), sp.Integer(0)
        if argindex == 1:
            return zero
        return choose(condition, one, zero) if argindex == 2 else choose(condition, zero, one)

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        # A condition is no number, so the chain rule must not look at it.
        then, otherwise = self.args[1].diff(s), self.args[2].diff(s)
        if then == 0 and otherwise == 0:
            return sp.Integer(0)
        return choose(self.args[0], then, otherwise)

    def _latex(self, printer: LatexPrinter, exp: str | None = None) -> str:
        c, a, b = (printer._print(arg) for arg in self.args)
        text = rf"\begin{{cases}} {a} & \text{{if }} {c} \\ {b} & \text{{otherwise}} \end{{cases}}"
        return text if exp is None else rf"\left({text}\right)^{{{exp}}}"


class maximum(Opaque):  # noqa: N801
    """The larger of two."""

    nargs = (2,)
    tex = r"\max"

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return 1 for the larger argument."""
        a, b = self.args
        chosen = greater_equal(a, b) if argindex == 1 else less(a, b)
        return _gate(chosen, sp.Integer(1))


class minimum(Opaque):  # noqa: N801
    """The smaller of two."""

    nargs = (2,)
    tex = r"\min"

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return 1 for the smaller argument."""
        a, b = self.args
        chosen = greater_equal(b, a) if argindex == 1 else less(b, a)
        return _gate(chosen, sp.Integer(1))


class absolute(Opaque):  # noqa: N801
    """The absolute value."""

    nargs = (1,)

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the sign."""
        x = self.args[0]
        return _gate(less(sp.Integer(0), x), sp.Integer(1)) - _gate(
            less(x, sp.Integer(0)), sp.Integer(1)
        )


class norm(Opaque):  # noqa: N801
    """The Euclidean norm of the components of a vector."""

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the component of the direction."""
        return self.args[argindex - 1] / self


class sat(Opaque):  # noqa: N801
    """``sat(Z, x)``, the paper's (2) in one dimension."""

    nargs = (2,)

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative of stick or slip."""
        level, x = self.args
        if argindex == 2:
            return _gate(less(absolute(x), level), sp.Integer(1))
        return choose(less(absolute(x), level), sp.Integer(0), absolute(x).fdiff())


class shrink(Opaque):  # noqa: N801
    """``shrink(Z, n)``: the factor min(1, Z/n)."""

    nargs = (2,)

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative of stick or slip."""
        level, n = self.args
        slope = 1 / n if argindex == 1 else -level / n**2
        return choose(less(n, level), sp.Integer(0), slope)


class modulo(Opaque):  # noqa: N801
    """``modulo(a, b)``, with the sign of b."""

    nargs = (2,)

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the slope between two jumps."""
        a, b = self.args
        if argindex == 1:
            return sp.Integer(1)
        return -sp.floor(a / b)


def less(a: sp.Expr, b: sp.Expr) -> sp.Basic:
    """Return ``a < b``, undecided."""
    return sp.StrictLessThan(a, b, evaluate=False)


def greater_equal(a: sp.Expr, b: sp.Expr) -> sp.Basic:
    """Return ``a >= b``, undecided."""
    return sp.GreaterThan(a, b, evaluate=False)
