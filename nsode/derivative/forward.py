"""Derivatives in one direction: by one name, or along the motion of a system."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from nsode.derivative.rules import ONE, ZERO, guarded, partials, shifted, summed, times
from nsode.expr import (
    TIME,
    Call,
    Expr,
    If,
    Index,
    IndexRange,
    Name,
    add,
    children,
    multiply,
    negate,
)
from nsode.ode import (
    DOT_SUFFIX,
    Binding,
    Definition,
    LinearSolve,
    Rate,
    SetValuedTerm,
    System,
    defined,
    expressions,
)

Direction = Callable[[Name], Expr | None]


class Row(NamedTuple):
    """A value with its name, where it is no :class:`~nsode.ode.Rate`."""

    state: str
    value: Expr
    range: IndexRange | None = None


def tangent(expr: Expr, direction: Direction, taken: frozenset[str] = frozenset()) -> Expr | None:
    """Return the derivative of ``expr`` in a direction, None where it is zero.

    Parameters
    ----------
    expr : Expr
        A scalar expression.
    direction : callable
        The derivative of each name that ``expr`` reads; None for one that is constant.
    taken : frozenset of str
        Index variables in use outside ``expr``.
    """
    terms = []
    for partial in partials(expr, taken):
        inner = direction(partial.name)
        if inner is not None:
            term = guarded(partial.where, times(partial.coefficient, inner))
            terms.append(summed(partial.over, term))
    return add(*terms) if terms else None


def derivative(expr: Expr, by: str, at: Index | None = None) -> Expr:
    """Return the partial derivative of ``expr`` by one name, or one element of a family.

    Elements are told apart by how they are written: ``x[i]`` is not ``x[i+1]``.
    """

    def direction(name: Name) -> Expr | None:
        return ONE if name.id == by and name.at == at else None

    return tangent(expr, direction) or ZERO


def time_derivative(system: System, expr: Expr) -> tuple[tuple[Definition, ...], Expr]:
    """Return d(expr)/dt along the rates of ``system``, as :func:`time_derivatives` does."""
    definitions, ((_, value, _),) = time_derivatives(system, Row("", expr))
    return definitions, value


def time_derivatives(
    system: System, *rows: Rate | Row
) -> tuple[tuple[Definition, ...], tuple[Row, ...]]:
    """Return the derivatives of some values along the rates of ``system`` (Lie derivatives).

    Inputs and parameters are constant in time. The derivative of a name ``x``, unless it is
    a name itself, stands in a new definition ``x.dot``.

    Parameters
    ----------
    system : System
        The system whose rates move the states.
    *rows : Row
        What to derive; the values may read states, bindings and time.

    Returns
    -------
    definitions : tuple of Definition
        To be appended to the bindings of the system, in order.
    rows : tuple of Row
        The derivatives in terms of them, under the names that were given.

    Raises
    ------
    ValueError
        If a value reads a multiplier, whose derivative no equation gives.
    """
    motion = Motion.of(system)
    derived = [
        Row(state, motion.derivative(value, _variables(span)), span)
        for state, value, span in ((row.state, row.value, row.range) for row in rows)
    ]
    return tuple(motion.emitted), tuple(derived)


@dataclass(slots=True)
class Motion:
    """What moves, and the derivatives written so far.

    ``emitted`` holds the definitions of derivatives, in order. Where the derivative of a
    name is defined already, it is read.
    """

    rates: Mapping[str, Binding] = field(default_factory=dict)
    emitted: list[Definition] = field(default_factory=list)
    _definitions: dict[str, Definition] = field(default_factory=dict)
    _known: dict[str, Expr | None] = field(default_factory=dict)
    _rank: dict[str, int] = field(default_factory=dict)

    @classmethod
    def of(cls, system: System) -> Motion:
        """Return the motion of a system."""
        motion = cls(merged_rates(system.rates))
        for item in system.bindings:
            motion.define(item)
        return motion

    def define(self, item: Definition) -> None:
        """Take in a definition, behind those that it reads."""
        for name in defined(item):
            self._definitions[name] = item
            self._rank[name] = len(self._rank)

    def derivative(self, value: Expr, taken: frozenset[str] = frozenset()) -> Expr:
        """Return the derivative of a value in time, where some indices are taken."""
        self._prepare(value)
        return tangent(value, self._along, taken) or ZERO

    def _prepare(self, value: Expr) -> None:
        """Derive what a value rests on, in order, so that nothing recurses through names."""
        found: set[str] = set()
        waiting = [value]
        while waiting:
            for name in _derived(waiting.pop()):
                item = self._definitions.get(name)
                if item is None or isinstance(item, SetValuedTerm):
                    continue
                if name not in found and name not in self._known:
                    found.add(name)
                    waiting.extend(expressions(item))
        for name in sorted(found, key=self._rank.__getitem__):
            self._along(Name(name))

    def _along(self, name: Name) -> Expr | None:
        if name.id == TIME:
            return ONE
        if name.id not in self._known:
            self._known[name.id] = self._derive(name.id)
        return _read(self._known[name.id], name.at)

    def _derive(self, name: str) -> Expr | None:
        moving = self._definitions.get(f"{name}{DOT_SUFFIX}")
        if isinstance(moving, Binding):
            return _whole(moving)
        if name in self.rates:
            return self._emit(name, self.rates[name].value, self.rates[name].range)
        match self._definitions.get(name):
            case None:
                return None
            case Binding(_, value, span):
                derived = tangent(value, self._along, _variables(span))
                return None if derived is None else self._emit(name, derived, span)
            case LinearSolve() as solve:
                self._solve(solve)
                return self._known[name]
            case SetValuedTerm():
                raise ValueError(f"the multiplier `{name}` has no derivative in time")

    def _emit(self, name: str, value: Expr, span: IndexRange | None) -> Expr:
        """Name a derivative, unless it is a name already."""
        match value:
            case Name(at=None):
                return value
            case _:
                moving = Binding(f"{name}{DOT_SUFFIX}", value, span, role="part", span=value.span)
                self.emitted.append(moving)
                return _whole(moving)

    def _solve(self, solve: LinearSolve) -> None:
        """``M u = r`` gives ``M u' = r' - M' u``: the same matrix again."""
        right = []
        for row, value in zip(solve.matrix, solve.right, strict=True):
            terms = [tangent(value, self._along, _variables(solve.range))]
            for coefficient, unknown in zip(row, solve.unknowns, strict=True):
                moving = tangent(coefficient, self._along, _variables(solve.range))
                at = Index(solve.range.variable) if solve.range else None
                terms.append(moving and negate(multiply(moving, Name(unknown, at))))
            present = [term for term in terms if term is not None]
            right.append(add(*present) if present else ZERO)
        moved = tuple(f"{unknown}{DOT_SUFFIX}" for unknown in solve.unknowns)
        self.emitted.append(replace(solve, unknowns=moved, right=tuple(right)))
        at = Index(solve.range.variable) if solve.range else None
        self._known |= {u: Name(dot, at) for u, dot in zip(solve.unknowns, moved, strict=True)}


def _derived(expr: Expr) -> Iterator[str]:
    """Yield the names whose derivatives that of an expression needs: conditions have none."""
    stack = [expr]
    while stack:
        match stack.pop():
            case Name(id):
                yield id
            case If(_, then, otherwise):
                stack.extend((then, otherwise))
            case node:
                stack.extend(children(node))


def _whole(item: Binding) -> Name:
    """Return the name of a definition, of a family with its own index."""
    return Name(item.name, Index(item.range.variable) if item.range else None)


def _variables(span: IndexRange | None) -> frozenset[str]:
    return frozenset({span.variable}) if span else frozenset()


def _read(derived: Expr | None, at: Index | None) -> Expr | None:
    """Return a known derivative at the element ``at``."""
    match derived:
        case Name(at=Index(variable)) if variable is not None and at is not None:
            return shifted(derived, variable, at)
        case _:
            return derived


def merged_rates(rates: Iterable[Rate]) -> dict[str, Binding]:
    """Return one value for each state: pieces of a family under an ``if`` on the index."""
    pieces: dict[str, list[Rate]] = {}
    for rate in rates:
        pieces.setdefault(rate.state, []).append(rate)
    return {state: _merged(state, parts) for state, parts in pieces.items()}


def _merged(state: str, parts: list[Rate]) -> Binding:
    whole = parts[0].range
    if whole is None or len(parts) == 1:
        return Binding(state, parts[0].value, whole, role="part")
    spanned = [(part.range, part) for part in parts if part.range is not None]
    ordered = sorted(spanned, key=lambda pair: pair[0].first)
    variable = Index(whole.variable)
    value: Expr | None = None
    for span, part in reversed(ordered):
        own = shifted(part.value, span.variable, variable)
        inside = Call("<=", (variable, Index(None, span.last)))
        value = own if value is None else If(inside, own, value)
    assert value is not None
    covered = IndexRange(whole.variable, ordered[0][0].first, ordered[-1][0].last)
    return Binding(state, value, covered, role="part")
