"""An ``if`` on indices alone is decided here: its range breaks where the condition changes.

Walls are written ``if i > 0 then x[i-1] else 0``; the dead branch may be out of range.
The places of change come from the affine forms of the conditions, so the cost grows
with the number of pieces and never with the number of elements.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import chain, pairwise
from math import ceil, floor

from nsode.expr import (
    FUNCTIONS,
    Call,
    Expr,
    If,
    IndexRange,
    Number,
    Sum,
    add,
    children,
    names,
    rebuild,
)
from nsode.ode import (
    AugmentedODE,
    Binding,
    Check,
    Definition,
    LinearSolve,
    Output,
    Rate,
    State,
)
from nsode.passes.affine import difference
from nsode.passes.expressions import map_definition, map_rate

#: One element of the piece at hand, for each index variable in scope.
Sample = Mapping[str, int]

_OUTSIDE: Sample = {}
_COMPARISONS = {"<", "<=", ">", ">=", "==", "!="}


def pieces(
    range: IndexRange, *exprs: Expr, inside: Sample = _OUTSIDE
) -> list[tuple[IndexRange, tuple[Expr, ...]]]:
    """Break a range into the fewest pieces in which no ``if`` on indices is left.

    Parameters
    ----------
    range
        The index over which the expressions stand.
    *exprs
        Expressions that share the range, such as the rows of a linear system.
    inside
        The pieces of other ranges in which this one stands.

    Returns
    -------
    list
        Each piece, in rising order, with the expressions as they read in it. A condition
        that is no comparison of affine index expressions (``mod(i, 2) == 0``) stays.
    """
    cuts: set[int] = set()
    for expr in exprs:
        _collect_cuts(expr, range, cuts)
    found: list[tuple[IndexRange, tuple[Expr, ...]]] = []
    for piece in _break(range, cuts):
        sample = {**inside, range.variable: piece.first}
        here = tuple(_resolve(expr, sample) for expr in exprs)
        if found and found[-1][1] == here:
            found[-1] = (IndexRange(range.variable, found[-1][0].first, piece.last), here)
        else:
            found.append((piece, here))
    return found


def settle(expr: Expr) -> Expr:
    """Decide what numbers alone decide in an expression without an index of its own."""
    return expr if _is_settled(expr) else _resolve(expr, {})


def _is_settled(expr: Expr) -> bool:
    """Whether there is nothing to decide: most expressions, so they are not rebuilt."""
    if isinstance(expr, Sum):
        return False
    for child in children(expr):
        if not _is_settled(child):
            return False
    # A comparison that reads a name is no matter of indices.
    compares = isinstance(expr, Call) and expr.function in _COMPARISONS
    return not compares or any(True for _ in names(expr))


def split(ode: AugmentedODE) -> AugmentedODE:
    """Break families into pieces without an ``if`` on indices; empty ranges vanish.

    Bindings, solves, rates and checks come in pieces. A state and an output keep one item
    each, for their places; where such a value differs between pieces it keeps its ``if``,
    and a backend calls :func:`pieces` where it writes it.
    """
    return replace(
        ode,
        bindings=tuple(chain.from_iterable(map(split_definition, ode.bindings))),
        rates=tuple(chain.from_iterable(map(_split_rate, ode.rates))),
        checks=tuple(chain.from_iterable(map(split_check, ode.checks))),
        states=tuple(map(_split_state, ode.states)),
        outputs=tuple(map(_split_output, ode.outputs)),
    )


def split_definition(item: Definition) -> Iterable[Definition]:
    """Return the pieces of a definition."""
    match item:
        case Binding(range=None) | LinearSolve(range=None):
            return [map_definition(item, settle)]
        case Binding(value=value, range=IndexRange() as over):
            return [replace(item, range=r, value=v) for r, (v,) in pieces(over, value)]
        case LinearSolve(range=IndexRange() as over):
            return [_rows(item, r, entries) for r, entries in _solve_pieces(item, over)]
        case _:
            raise NotImplementedError(f"no way to split {type(item).__name__}")


def _solve_pieces(
    solve: LinearSolve, over: IndexRange
) -> list[tuple[IndexRange, tuple[Expr, ...]]]:
    return pieces(over, *chain.from_iterable(solve.matrix), *solve.right)


def _rows(solve: LinearSolve, over: IndexRange, entries: tuple[Expr, ...]) -> LinearSolve:
    n = len(solve.unknowns)
    matrix = tuple(entries[n * row : n * (row + 1)] for row in range(n))
    return replace(solve, range=over, matrix=matrix, right=entries[n * n :])


def _split_rate(rate: Rate) -> Iterable[Rate]:
    if rate.range is None:
        return [map_rate(rate, settle)]
    return [replace(rate, range=r, value=v) for r, (v,) in pieces(rate.range, rate.value)]


def _split_state(state: State) -> State:
    initial = _whole(state.range, state.initial)
    return state if initial is state.initial else replace(state, initial=initial)


def _split_output(output: Output) -> Output:
    value = _whole(output.range, output.value)
    return output if value is output.value else replace(output, value=value)


def split_check(check: Check) -> list[Check]:
    """Return the pieces of a check; those that indices alone fulfil vanish."""
    if check.range is None:
        condition = settle(check.condition)
        found = [check if condition is check.condition else replace(check, condition=condition)]
    else:
        found = [
            replace(check, range=r, condition=c) for r, (c,) in pieces(check.range, check.condition)
        ]
    return [item for item in found if item.condition != _TRUE]


def _whole(over: IndexRange | None, value: Expr) -> Expr:
    if over is None:
        return settle(value)
    found = pieces(over, value)
    return found[0][1][0] if len(found) == 1 else value


def _break(over: IndexRange, cuts: Iterable[int]) -> list[IndexRange]:
    """Return the parts of a range that begin at the cuts."""
    if not len(over):
        return []
    starts = sorted({over.first, *(cut for cut in cuts if over.first < cut <= over.last)})
    return [IndexRange(over.variable, a, b - 1) for a, b in pairwise([*starts, over.last + 1])]


def _collect_cuts(expr: Expr, over: IndexRange, cuts: set[int]) -> None:
    """Gather where conditions on the index change, following live branches only."""
    match expr:
        case If(condition, then, otherwise):
            own: set[int] = set()
            _collect_cuts(condition, over, own)
            cuts |= own
            for piece in _break(over, own):
                match _decide(condition, {over.variable: piece.first}):
                    case bool(known):
                        _collect_cuts(then if known else otherwise, piece, cuts)
                    case _:
                        _collect_cuts(then, piece, cuts)
                        _collect_cuts(otherwise, piece, cuts)
        case Sum(range=inner) if inner.variable == over.variable:
            pass
        case Call(function, (left, right)) if (
            function in _COMPARISONS and (root := _root(left, right, over.variable)) is not None
        ):
            cuts.update((ceil(root), floor(root) + 1))
        case _:
            for child in children(expr):
                _collect_cuts(child, over, cuts)


def _root(left: Expr, right: Expr, variable: str) -> Fraction | None:
    """Return where ``left - right`` is zero if it is affine in this variable alone."""
    form = difference(left, right)
    if form is None or set(form) != {None, variable}:
        return None
    return -form[None] / form[variable]


def _resolve(expr: Expr, sample: Sample) -> Expr:
    match expr:
        case If(condition, then, otherwise):
            match _decide(condition, sample):
                case bool(known):
                    return _resolve(then if known else otherwise, sample)
                case Expr() as undecided:
                    a, b = _resolve(then, sample), _resolve(otherwise, sample)
                    return replace(expr, condition=undecided, then=a, otherwise=b)
        case Sum():
            return _resolve_sum(expr, sample)
        case Call(function) if FUNCTIONS[function].boolean:
            decided = _decide(expr, sample)
            if isinstance(decided, bool):
                return _TRUE if decided else _FALSE
            return decided
        case _:
            return rebuild(expr, lambda child: _resolve(child, sample))


def _resolve_sum(expr: Sum, sample: Sample) -> Expr:
    parts = [
        replace(expr, range=piece, body=body)
        for piece, (body,) in pieces(expr.range, expr.body, inside=sample)
    ]
    return add(*parts) if parts else Number(0.0, span=expr.span)


def _decide(condition: Expr, sample: Sample) -> bool | Expr:
    """Return the truth of a condition where indices tell it, else what is left of it."""
    match condition:
        case Call("not", (inner,)):
            known = _decide(inner, sample)
            return not known if isinstance(known, bool) else replace(condition, args=(known,))
        case Call("and" | "or" as function, (left, right)):
            absorbing = function == "or"
            a, b = _decide(left, sample), _decide(right, sample)
            if a is absorbing or b is absorbing:
                return absorbing
            if isinstance(a, bool):
                return b
            return a if isinstance(b, bool) else replace(condition, args=(a, b))
        case Call(function, (left, right)) if function in _COMPARISONS:
            truth = _compare(function, left, right, sample)
            return _rebuilt(condition, sample) if truth is None else truth
        case _:
            return _rebuilt(condition, sample)


def _rebuilt(expr: Expr, sample: Sample) -> Expr:
    return rebuild(expr, lambda child: _resolve(child, sample))


def _compare(function: str, left: Expr, right: Expr, sample: Sample) -> bool | None:
    form = difference(left, right)
    if form is None:
        return None
    variables = [v for v in form if v is not None]
    # The sample stands for its piece in one variable; two would need an area.
    if len(variables) > 1 or any(v not in sample for v in variables):
        return None
    value = form[None] + sum(form[v] * sample[v] for v in variables)
    return {
        "<": value < 0,
        "<=": value <= 0,
        ">": value > 0,
        ">=": value >= 0,
        "==": value == 0,
        "!=": value != 0,
    }[function]


_TRUE, _FALSE = (Call("<=", (Number(0.0), Number(right))) for right in (0.0, -1.0))
