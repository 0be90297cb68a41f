"""The equations of a system as the paper lays them out: a column, its rates, and `where`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from nsode.backends.latex.lower import Environment, lower
from nsode.backends.latex.names import Symbol, symbols, word
from nsode.expr import Call, Expr, If, Index, IndexRange, Number, Sum
from nsode.ode import (
    AugmentedODE,
    Binding,
    Definition,
    LinearSolve,
    Rate,
    SetValuedTerm,
    System,
)
from nsode.passes.split import split

_ROW = " \\\\\n"


def environment(*systems: System) -> Environment:
    """Return how the names of some systems look that share them."""
    return Environment(symbols(*systems))


def state_space(system: System, env: Environment) -> str:
    """Return d/dt of the column of states beside the column of rates, as in (31) and (32)."""
    if isinstance(system, AugmentedODE):
        return columns(split(system).rates, "=", env)
    return columns(system.rates, r"\in", env)


def columns(rates: Iterable[Rate], relation: str, env: Environment) -> str:
    """Return d/dt of a column of states, a relation, and the column of their rates."""
    rows = list(rates)
    left = column(element(env.symbols[rate.state], rate.range, env) for rate in rows)
    right = column(spread(rate.value, rate.range, env) for rate in rows)
    return f"\\frac{{\\mathrm{{d}}}}{{\\mathrm{{d}}t}}\n{left}\n{relation}\n{right}"


def column(rows: Iterable[str]) -> str:
    """Return a column vector."""
    return "\\begin{bmatrix}\n" + _ROW.join(rows) + "\n\\end{bmatrix}"


def element(symbol: Symbol, range: IndexRange | None, env: Environment) -> str:
    """Return a name, or all elements of a family, or its only one."""
    text = str(one(symbol, range, env))
    return text if range is None else _family(text, range)


def one(symbol: Symbol, range: IndexRange | None, env: Environment) -> Symbol:
    """Return a name, for a family with its index."""
    if range is None:
        return symbol
    return symbol.at(lower(Index(range.variable), env.inside(range)))


def spread(value: Expr, range: IndexRange | None, env: Environment) -> str:
    """Return a value, or those of all elements of a family."""
    if range is None:
        return lower(value, env)
    return _family(lower(value, env.inside(range)), range)


def _family(text: str, range: IndexRange) -> str:
    if len(range) == 1:
        return text
    return rf"\left({text}\right)_{{{word(range.variable)}={range.first}}}^{{{range.last}}}"


def definitions(items: Iterable[Definition], env: Environment) -> str:
    """Return definitions one below the other, aligned."""
    return aligned(row for item in items for row in definition(item, env))


def aligned(rows: Iterable[str]) -> str:
    """Return equations one below the other; ``&`` stands before each relation."""
    return "\\begin{aligned}\n" + _ROW.join(rows) + "\n\\end{aligned}"


def definition(item: Definition, env: Environment) -> Iterator[str]:
    """Yield the rows of one definition, with ``&`` before its relation."""
    inner = env if item.range is None else env.inside(item.range)
    match item:
        case Binding(name, value):
            yield f"{vector((name,), item.range, env)} &= {lower(value, inner)}{over(item.range)}"
        case SetValuedTerm():
            left = vector(item.multiplier, item.range, env)
            yield rf"{left} &\in {inclusion(item, inner)}{over(item.range)}"
        case LinearSolve(unknowns, matrix, right):
            rows = _ROW.join(" & ".join(lower(e, inner) for e in row) for row in matrix)
            table = f"\\begin{{bmatrix}}\n{rows}\n\\end{{bmatrix}}"
            left = column(vector((unknown,), item.range, env) for unknown in unknowns)
            sides = column(lower(e, inner) for e in right)
            yield f"{table} {left} &= {sides}{over(item.range)}"


def vector(names: tuple[str, ...], range: IndexRange | None, env: Environment) -> str:
    """Return the name of a value, or the names of the components of one."""
    shown = [str(one(env.symbols[name], range, env)) for name in names]
    return shown[0] if len(shown) == 1 else rf"\left({', '.join(shown)}\right)"


def inclusion(term: SetValuedTerm, env: Environment) -> str:
    r"""Return the law of a term: ``\chi \sgn(\theta)`` or ``\dio(\psi)``."""
    argument = ", ".join(lower(part, env) for part in term.argument)
    law = rf"\operatorname{{{term.kind}}}\left({argument}\right)"
    return law if term.factor is None else f"{factor(term.factor, env)}{law}"


def factor(chi: Expr, env: Environment) -> str:
    """Return a multiplicative factor, in brackets where it is a sum."""
    text = lower(chi, env)
    match chi:
        case Number(1.0):
            return ""
        case Call("+" | "neg") | If() | Sum():
            return rf"\left({text}\right) "
        case _:
            return rf"{text} \, "


def over(range: IndexRange | None) -> str:
    """Return what stands behind the definition of a family: its index."""
    if range is None or len(range) == 1:
        return ""
    return rf", \quad {word(range.variable)} = {range.first}, \dots, {range.last}"
