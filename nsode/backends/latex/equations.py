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
    DifferentialInclusion,
    LinearSolve,
    SetValuedTerm,
    System,
)
from nsode.passes.split import split

_ROW = " \\\\\n"


def environment(*systems: System) -> Environment:
    """Return how the names of some systems look that share them."""
    return Environment(symbols(*systems))


def state_space(system: System, env: Environment) -> str:
    """Return d/dt of the column of states beside the column of rates, as in (32)."""
    relation = r"\in" if isinstance(system, DifferentialInclusion) else "="
    rates = split(system).rates if isinstance(system, AugmentedODE) else system.rates
    order = {state.name: place for place, state in enumerate(system.states)}
    rows = sorted(rates, key=lambda rate: order[rate.state])
    left = [element(env.symbols[r.state], r.range, env) for r in rows]
    right = [spread(r.value, r.range, env) for r in rows]
    derivative = r"\frac{\mathrm{d}}{\mathrm{d}t}"
    return f"{derivative}\n{column(left)}\n{relation}\n{column(right)}"


def column(rows: Iterable[str]) -> str:
    """Return a column vector."""
    return "\\begin{bmatrix}\n" + _ROW.join(rows) + "\n\\end{bmatrix}"


def element(symbol: Symbol, range: IndexRange | None, env: Environment) -> str:
    """Return a name, or all elements of a family, or its only one."""
    if range is None:
        return str(symbol)
    one = str(symbol.at(lower(Index(range.variable), env.inside(range))))
    return _family(one, range)


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
    rows = [row for item in items for row in definition(item, env)]
    return "\\begin{aligned}\n" + _ROW.join(rows) + "\n\\end{aligned}"


def definition(item: Definition, env: Environment) -> Iterator[str]:
    """Yield the rows of one definition, with ``&`` before its relation."""
    inner = env if item.range is None else env.inside(item.range)
    index = None if item.range is None else lower(Index(item.range.variable), inner)

    def named(name: str) -> str:
        symbol: Symbol = env.symbols[name]
        return str(symbol if index is None else symbol.at(index))

    match item:
        case Binding(name, value):
            yield f"{named(name)} &= {lower(value, inner)}{_over(item.range)}"
        case SetValuedTerm():
            left = ", ".join(named(name) for name in item.multiplier)
            left = left if len(item.multiplier) == 1 else rf"\left({left}\right)"
            yield rf"{left} &\in {inclusion(item, inner)}{_over(item.range)}"
        case LinearSolve(unknowns, matrix, right):
            rows = _ROW.join(" & ".join(lower(e, inner) for e in row) for row in matrix)
            table = f"\\begin{{bmatrix}}\n{rows}\n\\end{{bmatrix}}"
            sides = column(lower(e, inner) for e in right)
            yield f"{table} {column(map(named, unknowns))} &= {sides}{_over(item.range)}"


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


def _over(range: IndexRange | None) -> str:
    if range is None or len(range) == 1:
        return ""
    return rf", \quad {word(range.variable)} = {range.first}, \dots, {range.last}"
