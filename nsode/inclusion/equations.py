"""From equations linear in ``der()`` to rates, and to linear systems where they couple."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.expr import (
    Call,
    Expr,
    Index,
    IndexRange,
    Name,
    Number,
    add,
    divide,
    multiply,
    names,
    negate,
    rebuild,
)
from nsode.inclusion.values import is_zero
from nsode.ode import Binding, LinearSolve, Rate, State
from nsode.source import Span

#: ``der(x)`` is the name ``x.rate`` until its equation is solved, and behind it where read.
Unknown = Name


def derivative_name(state: str) -> str:
    """Return the internal name of the rate of a state."""
    return f"{state}.rate"


def state_of(unknown: Unknown) -> str:
    """Return the name of the state whose derivative this is."""
    return unknown.id.removesuffix(".rate")


@dataclass(frozen=True, slots=True)
class Row:
    """``sum of coefficient*unknown = right``, one scalar equation."""

    coefficients: tuple[tuple[Unknown, Expr], ...]
    right: Expr
    range: IndexRange | None
    span: Span

    @property
    def unknowns(self) -> tuple[Unknown, ...]:
        """The derivatives that it holds."""
        return tuple(unknown for unknown, _ in self.coefficients)


def row(left: Expr, right: Expr, range: IndexRange | None, span: Span) -> Row:
    """Return an equation with its derivatives on the left and the rest on the right.

    Raises
    ------
    ModelError
        NS112 if a derivative does not appear linearly, or if there is none.
    """
    on_left, left_rest = _linear(left)
    on_right, right_rest = _linear(right)
    for unknown, coefficient in on_right.items():
        on_left[unknown] = _joined(on_left.get(unknown), negate(coefficient))
    rest = right_rest if right_rest is not None else Number(0.0, span=right.span)
    if left_rest is not None:
        rest = add(rest, negate(left_rest))
    found = Row(tuple(on_left.items()), rest, range, span)
    if not found.coefficients:
        raise refuse(
            "NS112",
            "an equation says what `der(...)` of some state is",
            span,
            "there is no `der` here",
            help="write `let` for a quantity that is no state",
        )
    return _aligned(found)


def _joined(first: Expr | None, second: Expr) -> Expr:
    return second if first is None else add(first, second)


def _linear(expr: Expr) -> tuple[dict[Unknown, Expr], Expr | None]:
    """Return the coefficients of the derivatives in ``expr`` and what is left."""
    if not any(_is_unknown(name) for name in names(expr)):
        return {}, expr
    match expr:
        case Name():
            return {expr: Number(1.0, span=expr.span)}, None
        case Call("neg", (inner,)):
            found, rest = _linear(inner)
            return {u: negate(c) for u, c in found.items()}, None if rest is None else negate(rest)
        case Call("+", terms):
            return _linear_sum(terms)
        case Call("*", (left, right)):
            a, b = _linear(left), _linear(right)
            if not a[0]:
                return _scaled(b, lambda part: _times(left, part))
            if not b[0]:
                return _scaled(a, lambda part: _times(part, right))
        case Call("/", (left, right)):
            if not _linear(right)[0]:
                return _scaled(_linear(left), lambda part: divide(part, right))
    culprit = next(name for name in names(expr) if _is_unknown(name))
    raise refuse(
        "NS112",
        "an equation must be linear in `der(...)`",
        culprit.span,
        "not linear here",
        help="solve the equation for the derivative by hand",
    )


def _linear_sum(terms: Sequence[Expr]) -> tuple[dict[Unknown, Expr], Expr | None]:
    found: dict[Unknown, Expr] = {}
    rests: list[Expr] = []
    for term in terms:
        coefficients, rest = _linear(term)
        for unknown, coefficient in coefficients.items():
            found[unknown] = _joined(found.get(unknown), coefficient)
        if rest is not None:
            rests.append(rest)
    return found, add(*rests) if rests else None


def _scaled(
    part: tuple[dict[Unknown, Expr], Expr | None], change: Callable[[Expr], Expr]
) -> tuple[dict[Unknown, Expr], Expr | None]:
    found, rest = part
    return {u: change(c) for u, c in found.items()}, None if rest is None else change(rest)


def _times(left: Expr, right: Expr) -> Expr:
    if isinstance(right, Number) and right.value == 1.0:
        return left
    if isinstance(left, Number) and left.value == 1.0:
        return right
    return multiply(left, right)


def _is_unknown(name: Name) -> bool:
    return name.id.endswith(".rate")


def _aligned(found: Row) -> Row:
    """Move the index of a family's row so that it is the index of its first unknown."""
    at = found.unknowns[0].at
    if found.range is None or at is None or at.variable is None or at.offset == 0:
        return found
    variable, by = found.range.variable, -at.offset
    moved = IndexRange(variable, found.range.first - by, found.range.last - by)

    def move(expr: Expr) -> Expr:
        return shifted(expr, variable, by)

    return Row(
        tuple((_as_name(move(u)), move(c)) for u, c in found.coefficients),
        move(found.right),
        moved,
        found.span,
    )


def _as_name(expr: Expr) -> Name:
    assert isinstance(expr, Name)
    return expr


def shifted(expr: Expr, variable: str, by: int) -> Expr:
    """Return ``expr`` with ``variable + by`` in the place of ``variable``."""
    match expr:
        case Index(name, offset) if name == variable:
            return replace(expr, offset=offset + by)
        case Name(_, Index(name, offset) as at) if name == variable:
            return replace(expr, at=replace(at, offset=offset + by))
    return rebuild(expr, lambda part: shifted(part, variable, by))


def solve(
    rows: Sequence[Row], states: Sequence[State]
) -> tuple[list[Binding | LinearSolve], list[Rate]]:
    """Return the rate of every state, and what must be computed on the way.

    Rows with one derivative are divided; a row that also reads derivatives found that
    way reads them as names; rows that stay coupled become one linear system.

    Raises
    ------
    ModelError
        NS107 and NS108 for missing and doubled equations, NS113 for a coefficient that
        is zero, NS112 for systems that couple elements of a family.
    """
    bindings: list[Binding | LinearSolve] = []
    rates: list[Rate] = []
    open_rows = list(rows)
    solved: dict[Unknown, Rate] = {}
    while True:
        single = [r for r in open_rows if len(r.unknowns) == 1]
        if not single:
            break
        for found in single:
            rate = _single(found)
            rates.append(rate)
            solved.setdefault(found.unknowns[0], rate)
        open_rows = [r for r in open_rows if len(r.unknowns) > 1]
        open_rows = [_substitute(r, solved) for r in open_rows]
    for group in _coupled(open_rows):
        system = _system(group)
        bindings.append(system)
        rates.extend(
            Rate(state_of(unknown), unknown, group[0].range, span=r.span)
            for unknown, r in zip(_unknowns(group), group, strict=True)
        )
    _check_coverage(rates, states)
    named = {name.id for item in bindings for name in _reads(item) if _is_unknown(name)}
    named |= {name.id for r in rates for name in names(r.value) if _is_unknown(name)}
    defined = {u for item in bindings if isinstance(item, LinearSolve) for u in item.unknowns}
    for k, rate in enumerate(rates):
        name = derivative_name(rate.state)
        if name in named - defined:
            bindings.append(Binding(name, rate.value, rate.range, "part", span=rate.span))
            at = None if rate.range is None else Index(rate.range.variable)
            rates[k] = replace(rate, value=Name(name, at, span=rate.span))
    return bindings, rates


def _reads(item: Binding | LinearSolve) -> list[Name]:
    if isinstance(item, Binding):
        return list(names(item.value))
    return [name for part in (*item.right, *sum(item.matrix, ())) for name in names(part)]


def _single(found: Row) -> Rate:
    unknown, coefficient = found.coefficients[0]
    if is_zero(coefficient):
        raise refuse("NS113", "the coefficient of `der` is zero", found.span)
    value = found.right
    if not is_zero(value) and not (isinstance(coefficient, Number) and coefficient.value == 1.0):
        value = divide(found.right, coefficient)
    range = found.range
    if unknown.at is not None and unknown.at.variable is None:
        k = unknown.at.offset
        range = IndexRange("i", k, k)
    return Rate(state_of(unknown), value, range, span=found.span)


def _substitute(found: Row, solved: Mapping[Unknown, Rate]) -> Row:
    right = found.right
    kept: list[tuple[Unknown, Expr]] = []
    for unknown, coefficient in found.coefficients:
        if unknown in solved and solved[unknown].range == found.range:
            right = add(right, negate(_times(coefficient, unknown)))
        else:
            kept.append((unknown, coefficient))
    if not kept:
        raise _doubled(state_of(found.unknowns[0]), found.span, solved[found.unknowns[0]].span)
    return replace(found, coefficients=tuple(kept), right=right)


def _coupled(rows: Sequence[Row]) -> list[list[Row]]:
    """Group rows that share derivatives."""
    groups: list[tuple[set[Unknown], list[Row]]] = []
    for found in rows:
        mine, together = set(found.unknowns), [found]
        apart = []
        for unknowns, members in groups:
            if unknowns & mine:
                mine |= unknowns
                together = members + together
            else:
                apart.append((unknowns, members))
        groups = [*apart, (mine, together)]
    return [members for _, members in groups]


def _unknowns(group: Sequence[Row]) -> list[Unknown]:
    return list(dict.fromkeys(unknown for r in group for unknown in r.unknowns))


def _system(group: Sequence[Row]) -> LinearSolve:
    unknowns = _unknowns(group)
    span = group[0].span
    if len(unknowns) > len(group):
        listed = ", ".join(f"`der({state_of(u)})`" for u in unknowns)
        raise refuse(
            "NS107",
            f"{len(group)} equations for {len(unknowns)} derivatives: {listed}",
            span,
            "coupled here",
            help="every state has one equation",
        )
    if len(unknowns) < len(group):
        raise _doubled(state_of(unknowns[-1]), group[-1].span, group[0].span)
    _check_one_index(group)
    zero = Number(0.0, span=span)
    matrix = tuple(
        tuple(dict(r.coefficients).get(unknown, zero) for unknown in unknowns) for r in group
    )
    _check_regular(matrix, group)
    right = tuple(r.right for r in group)
    return LinearSolve(tuple(u.id for u in unknowns), matrix, right, group[0].range, span=span)


def _check_one_index(group: Sequence[Row]) -> None:
    range = group[0].range
    for found in group:
        for unknown in found.unknowns:
            at = unknown.at
            fits = at is None if range is None else at == Index(range.variable)
            if found.range != range or not fits:
                raise refuse(
                    "NS112",
                    "equations that couple elements of a family cannot be solved",
                    unknown.span,
                    "another element than its row's",
                    help="write the few elements out as states of their own",
                )


def _check_regular(matrix: tuple[tuple[Expr, ...], ...], group: Sequence[Row]) -> None:
    for k, entries in enumerate(zip(*matrix, strict=True)):
        if all(is_zero(entry) for entry in entries):
            raise refuse("NS113", f"column {k + 1} of the mass matrix is zero", group[0].span)
    for k, first in enumerate(matrix):
        for j in range(k):
            if matrix[j] == first:
                raise ModelError(
                    [
                        Diagnostic(
                            "NS113",
                            "the mass matrix is singular: two of its rows are equal",
                            (
                                Label(group[k].span, "this row"),
                                Label(group[j].span, "equals this one"),
                            ),
                            help="each equation must say something new about the derivatives",
                        )
                    ]
                )


def _doubled(state: str, span: Span, first: Span) -> ModelError:
    return ModelError(
        [
            Diagnostic(
                "NS108",
                f"`der({state})` is given twice",
                (Label(span, "again here"), Label(first, "first here")),
                help="every state has exactly one equation: remove one, or add the two right sides",
            )
        ]
    )


def _check_coverage(rates: Sequence[Rate], states: Sequence[State]) -> None:
    """Refuse states, and elements of families, without exactly one equation."""
    found: dict[str, list[Rate]] = {}
    for rate in rates:
        found.setdefault(rate.state, []).append(rate)
    problems: list[Diagnostic] = []
    for state in states:
        mine = sorted(found.get(state.name, []), key=lambda r: r.range.first if r.range else 0)
        problems.extend(_uncovered(state, mine))
    if problems:
        raise ModelError(problems)


def _uncovered(state: State, mine: Sequence[Rate]) -> list[Diagnostic]:
    if state.range is None:
        if len(mine) > 1:
            return list(_doubled(state.name, mine[1].span, mine[0].span).diagnostics)
        return [] if mine else [_missing(state, state.name)]
    problems: list[Diagnostic] = []
    expected = state.range.first
    for rate in mine:
        assert rate.range is not None
        if len(rate.range) == 0:
            continue
        if rate.range.first < expected:
            name = f"{state.name}[{rate.range.first}]"
            problems.extend(_doubled(name, rate.span, mine[0].span).diagnostics)
        elif rate.range.first > expected:
            problems.append(_missing(state, f"{state.name}[{expected}]"))
        expected = max(expected, rate.range.last + 1)
    if expected <= state.range.last and len(state.range):
        problems.append(_missing(state, f"{state.name}[{expected}]"))
    return problems


def _missing(state: State, element: str) -> Diagnostic:
    return Diagnostic(
        "NS107",
        f"`{element}` has no equation",
        (Label(state.span, "declared here"),),
        help=f"say how it changes: `der({element}) = ...`",
    )
