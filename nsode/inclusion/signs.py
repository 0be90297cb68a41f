"""Proofs that a value keeps its sign.

The proof follows the structure of the expression, through bindings, from declared
bounds, assumptions and what dio, abs, norm and the like are known for. A parameter
without a bound lends the sign of its value, and so does what is computed of parameters
alone; the proof says which it used, so that just these can be guarded.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import product
from math import isfinite
from typing import NamedTuple

from nsode.evaluate import evaluate
from nsode.expr import Call, Expr, If, Index, Name, Number, Sum, names, walk
from nsode.inclusion.facts import OPPOSITE, Facts, Goal
from nsode.inclusion.families import Axes, Case, Elements, cases, elements
from nsode.inclusion.order import deepest_first
from nsode.inclusion.sharing import Numbering
from nsode.ode import Parameter


class Guard(NamedTuple):
    """The sign that some elements of a parameter lend to a proof, or a value of parameters."""

    value: Expr
    goal: Goal
    elements: Elements


Proof = frozenset[Guard]

_NOTHING: Proof = frozenset()
_WEAK: dict[Goal, Goal] = {">=": ">=", ">": ">=", "<=": "<=", "<": "<="}
_POSITIVE = {"exp", "cosh"}
_NONNEGATIVE = {"abs", "norm", "sqrt", "acos"}
_ODD = {"sinh", "tanh", "atan", "asin"}


@dataclass(slots=True)
class Prover:
    """Proves signs over the bindings of one model.

    ``facts`` are bounds and assumptions, which checks guard elsewhere; ``nonnegative`` are
    dio's multipliers.
    """

    numbering: Numbering
    parameters: Mapping[str, Parameter]
    facts: Facts = field(init=False)
    nonnegative: set[str] = field(default_factory=set)
    _known: dict[str, dict[Goal, Proof | None]] = field(default_factory=dict)
    _seen: dict[tuple[int, Goal], tuple[Expr, Proof | None]] = field(default_factory=dict)
    _over: Axes = ()

    def __post_init__(self) -> None:
        self.facts = Facts(self.numbering)

    def prove(self, expr: Expr, goal: Goal, over: Axes = ()) -> Proof | None:
        """Return the guards under which ``expr goal 0`` holds, None without a proof.

        ``over`` are the index ranges under which the expression stands.
        """
        return self.prove_all([Case(expr, over)], goal)

    def prove_all(self, parts: Sequence[Case], goal: Goal) -> Proof | None:
        """Return the guards under which every part has a sign, None without a proof."""
        bindings = self.numbering.bindings
        read = (name for part in parts for name in self._bound(part.expr))
        for name in deepest_first(read, self._below, self._known):
            inner = cases(bindings[name].value, bindings[name].range)
            self._known[name] = {g: self._prove_parts(inner, g) for g in OPPOSITE}
        return self._prove_parts(parts, goal)

    def _prove_parts(self, parts: Sequence[Case], goal: Goal) -> Proof | None:
        guards = _NOTHING
        for expr, over in parts:
            with self._within(over):
                proof = self._prove(expr, goal)
            if proof is None:
                return None
            guards |= proof
        return guards

    def _bound(self, expr: Expr) -> Iterator[str]:
        return (name.id for name in names(expr) if name.id in self.numbering.bindings)

    def _below(self, name: str) -> Iterator[str]:
        return self._bound(self.numbering.bindings[name].value)

    @contextmanager
    def _within(self, over: Axes) -> Iterator[None]:
        if not over:
            yield
            return
        outside = self._over, self._seen
        self._over, self._seen = (*self._over, *over), {}
        try:
            yield
        finally:
            self._over, self._seen = outside

    def _prove(self, expr: Expr, goal: Goal) -> Proof | None:
        key = (id(expr), goal)
        if key not in self._seen:
            assumed = self.facts.tell(expr, goal, self._over)
            proof = _NOTHING if assumed else self._structure(expr, goal)
            if proof is None:
                proof = self._lent(expr, goal)
            self._seen[key] = expr, proof  # the expression lives on, so that its id stays its own
        return self._seen[key][1]

    def _structure(self, expr: Expr, goal: Goal) -> Proof | None:
        match expr:
            case Number(value):
                return _NOTHING if holds(value, goal) else None
            case Name():
                return self._name(expr, goal)
            case Index():
                ends = elements(expr, self._over)
                return _NOTHING if all(holds(end, goal) for end in ends) else None
            case Sum(over, body) if goal in {">=", "<="}:
                with self._within((over,)):
                    return self._prove(body, goal)
            case If(_, then, otherwise):
                return self._all((then, goal), (otherwise, goal))
            case Call("neg", (inner,)):
                return self._prove(inner, OPPOSITE[goal])
            case Call("+", _) if all(map(_is_affine, walk(expr))):
                return _NOTHING if all(holds(end, goal) for end in self._extremes(expr)) else None
            case Call("+", terms):
                return self._sum(terms, goal)
            case Call("*" | "/", (left, right)):
                return self._product(expr.function, left, right, goal)
            case Call("^", (base, exponent)):
                return self._power(base, exponent, goal)
            case Call("max" | "min", (left, right)):
                return self._extreme(expr.function, left, right, goal)
            case Call(function, args):
                return self._function(function, args, goal)
        return None

    def _name(self, expr: Name, goal: Goal) -> Proof | None:
        if expr.id in self.nonnegative:
            return _NOTHING if goal == ">=" else None
        parameter = self.parameters.get(expr.id)
        if parameter is not None:
            lent = Guard(replace(expr, at=None), goal, elements(expr.at, self._over))
            held = all(holds(value, goal) for _, value in values_at(parameter, lent.elements))
            return frozenset({lent}) if held else None
        return self._known[expr.id][goal] if expr.id in self._known else None

    def _lent(self, expr: Expr, goal: Goal) -> Proof | None:
        """Take the sign of a value of single parameters, where no structure tells it."""
        if not isinstance(expr, Call):
            return None
        for node in walk(expr):
            match node:
                case Name(id, None) if id in self.parameters:
                    pass
                case Name() | Index() | Sum():
                    return None
        value = evaluate(expr, lambda name, _: self.parameters[name].values[0], {})
        held = isfinite(value) and holds(value, goal)
        return frozenset({Guard(expr, goal, (0, 0))}) if held else None

    def _extremes(self, expr: Expr) -> Iterator[float]:
        """Yield a value that is linear in the indices at each corner of their ranges."""
        read = {n.variable for n in walk(expr) if isinstance(n, Index) and n.variable is not None}
        axes = [axis for axis in self._over if axis.variable in read]
        for corner in product(*((axis.first, axis.last) for axis in axes)):
            at = {axis.variable: k for axis, k in zip(axes, corner, strict=True)}
            yield evaluate(expr, _no_name, at)

    def _all(self, *goals: tuple[Expr, Goal]) -> Proof | None:
        guards = _NOTHING
        for expr, goal in goals:
            proof = self._prove(expr, goal)
            if proof is None:
                return None
            guards |= proof
        return guards

    def _any(self, *choices: tuple[tuple[Expr, Goal], ...]) -> Proof | None:
        for choice in choices:
            proof = self._all(*choice)
            if proof is not None:
                return proof
        return None

    def _sum(self, terms: tuple[Expr, ...], goal: Goal) -> Proof | None:
        weak = self._all(*((term, _WEAK[goal]) for term in terms))
        if weak is None or goal in {">=", "<="}:
            return weak
        strict = self._any(*(((term, goal),) for term in terms))
        return None if strict is None else weak | strict

    def _product(self, function: str, left: Expr, right: Expr, goal: Goal) -> Proof | None:
        if function == "*" and goal == ">=" and self._same(left, right):
            return _NOTHING
        strict = goal in {">", "<"}
        up: Goal = ">" if strict else ">="
        down: Goal = "<" if strict else "<="
        beside_up: Goal = ">" if function == "/" else up
        beside_down: Goal = "<" if function == "/" else down
        if goal in {">", ">="}:
            return self._any(((left, up), (right, beside_up)), ((left, down), (right, beside_down)))
        return self._any(((left, down), (right, beside_up)), ((left, up), (right, beside_down)))

    def _same(self, left: Expr, right: Expr) -> bool:
        a, b = self.numbering.number(left, {}), self.numbering.number(right, {})
        return a.id == b.id and a.scale * b.scale >= 0

    def _power(self, base: Expr, exponent: Expr, goal: Goal) -> Proof | None:
        if goal == ">=" and isinstance(exponent, Number) and exponent.value % 2 == 0:
            return _NOTHING
        return self._prove(base, goal) if goal in {">", ">="} else None

    def _extreme(self, function: str, left: Expr, right: Expr, goal: Goal) -> Proof | None:
        if (function == "max") == (goal in {">", ">="}):
            return self._any(((left, goal),), ((right, goal),))
        return self._all((left, goal), (right, goal))

    def _function(self, function: str, args: tuple[Expr, ...], goal: Goal) -> Proof | None:
        if goal in {"<", "<="}:
            return self._prove(args[0], goal) if function in _ODD else None
        if function in _POSITIVE:
            return _NOTHING
        if function in _NONNEGATIVE:
            return _NOTHING if goal == ">=" else self._nonzero(function, args)
        if function in _ODD:
            return self._prove(args[0], goal)
        return None

    def _nonzero(self, function: str, args: tuple[Expr, ...]) -> Proof | None:
        """Prove that a function that is never negative is not zero either."""
        match function:
            case "sqrt":
                return self._prove(args[0], ">")
            case "abs" | "norm":
                return self._any(*(((arg, goal),) for arg in args for goal in _STRICT))
        return None


_STRICT: tuple[Goal, Goal] = (">", "<")


def values_at(parameter: Parameter, read: Elements) -> Iterator[tuple[int, float]]:
    """Yield the index and the value of some elements of a parameter."""
    offset = 0 if parameter.range is None else parameter.range.first
    for k in range(read[0], read[1] + 1):
        yield k, parameter.values[k - offset]


def holds(value: float, goal: Goal) -> bool:
    """Tell whether a number has a sign."""
    match goal:
        case ">=":
            return value >= 0
        case ">":
            return value > 0
        case "<=":
            return value <= 0
    return value < 0


def _is_affine(expr: Expr) -> bool:
    """Tell whether a part of an expression may stand in one that is linear in indices."""
    match expr:
        case Number() | Index() | Call("+" | "neg", _):
            return True
        case Call("*", (Number(), _) | (_, Number())):
            return True
    return False


def _no_name(name: str, at: int | None) -> float:
    raise AssertionError(name)
