"""Proofs that a value keeps its sign.

The proof follows the structure of the expression, through bindings, from declared
bounds, assumptions and what dio, abs, norm and the like are known for. A parameter
without a bound lends the sign of its value; the proof says which it used, so that
just these can be guarded.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import product
from typing import Literal

from nsode.evaluate import evaluate
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum, names, walk
from nsode.inclusion.order import deepest_first
from nsode.inclusion.sharing import ONE, Numbering
from nsode.ode import Binding, Parameter

Goal = Literal[">=", ">", "<=", "<"]
Guard = tuple[str, Goal]
Proof = frozenset[Guard]

_NOTHING: Proof = frozenset()
_OPPOSITE: dict[Goal, Goal] = {">=": "<=", ">": "<", "<=": ">=", "<": ">"}
_WEAK: dict[Goal, Goal] = {">=": ">=", ">": ">=", "<=": "<=", "<": "<="}
_IMPLIES: dict[Goal, tuple[Goal, ...]] = {
    ">=": (">=", ">"),
    ">": (">",),
    "<=": ("<=", "<"),
    "<": ("<",),
}
_POSITIVE = {"exp", "cosh"}
_NONNEGATIVE = {"abs", "norm", "sqrt", "acos"}
_ODD = {"sinh", "tanh", "atan", "asin"}


@dataclass(slots=True)
class Prover:
    """Proves signs over the bindings of one model.

    ``facts`` maps the number of a value (see :class:`Numbering`) to what was assumed of
    it, ``bounds`` a name to what was declared; ``nonnegative`` are dio's multipliers.
    """

    numbering: Numbering
    parameters: Mapping[str, Parameter]
    facts: dict[int, set[Goal]] = field(default_factory=dict)
    bounds: dict[str, set[Goal]] = field(default_factory=dict)
    nonnegative: set[str] = field(default_factory=set)
    _known: dict[str, dict[Goal, Proof | None]] = field(default_factory=dict)
    _seen: dict[tuple[int, Goal], tuple[Expr, Proof | None]] = field(default_factory=dict)
    _indices: dict[str, IndexRange] = field(default_factory=dict)

    def assume(self, expr: Expr, goal: Goal) -> None:
        """Take ``expr goal 0`` for granted; a check guards it elsewhere."""
        scale, id = self.numbering.number(expr, {})
        if scale and id != ONE:
            self.facts.setdefault(id, set()).add(goal if scale > 0 else _OPPOSITE[goal])

    def prove(self, expr: Expr, goal: Goal, *over: IndexRange) -> Proof | None:
        """Return the guards under which ``expr goal 0`` holds, None without a proof.

        ``over`` are the index ranges under which the expression stands.
        """
        bindings = self.numbering.bindings
        for name in deepest_first(self._bound(expr), self._below, self._known):
            binding = bindings[name]
            with self._within(*_axes(binding)):
                self._known[name] = {g: self._prove(binding.value, g) for g in _OPPOSITE}
        with self._within(*over):
            return self._prove(expr, goal)

    def _bound(self, expr: Expr) -> Iterator[str]:
        return (name.id for name in names(expr) if name.id in self.numbering.bindings)

    def _below(self, name: str) -> Iterator[str]:
        return self._bound(self.numbering.bindings[name].value)

    @contextmanager
    def _within(self, *over: IndexRange) -> Iterator[None]:
        outside = self._indices
        self._indices = {**outside, **{axis.variable: axis for axis in over}}
        try:
            yield
        finally:
            self._indices = outside

    def _prove(self, expr: Expr, goal: Goal) -> Proof | None:
        key = (id(expr), goal)
        if key not in self._seen:
            proof = self._assumed(expr, goal)
            if proof is None:
                proof = self._structure(expr, goal)
            self._seen[key] = expr, proof  # the expression lives on, so that its id stays its own
        return self._seen[key][1]

    def _assumed(self, expr: Expr, goal: Goal) -> Proof | None:
        if not self.facts or isinstance(expr, Number):
            return None
        scale, id = self.numbering.number(expr, {})
        wanted = goal if scale > 0 else _OPPOSITE[goal]
        known = self.facts.get(id, set())
        return _NOTHING if scale and any(g in known for g in _IMPLIES[wanted]) else None

    def _structure(self, expr: Expr, goal: Goal) -> Proof | None:
        match expr:
            case Number(value):
                return _NOTHING if _holds(value, goal) else None
            case Name():
                return self._name(expr, goal)
            case Index():
                return _NOTHING if all(_holds(end, goal) for end in self._ends(expr)) else None
            case Sum(over, body) if goal in {">=", "<="}:
                with self._within(over):
                    return self._prove(body, goal)
            case If(_, then, otherwise):
                return self._all((then, goal), (otherwise, goal))
            case Call("neg", (inner,)):
                return self._prove(inner, _OPPOSITE[goal])
            case Call("+", _) if all(map(_is_affine, walk(expr))):
                return _NOTHING if all(_holds(end, goal) for end in self._extremes(expr)) else None
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
        if any(known in self.bounds.get(expr.id, ()) for known in _IMPLIES[goal]):
            return _NOTHING
        parameter = self.parameters.get(expr.id)
        if parameter is not None:
            held = all(_holds(value, goal) for value in parameter.values)
            return frozenset({(expr.id, goal)}) if held and parameter.values else None
        return self._known[expr.id][goal] if expr.id in self._known else None

    def _ends(self, index: Index) -> tuple[int, ...]:
        if index.variable is None:
            return (index.offset,)
        over = self._indices[index.variable]
        return (over.first + index.offset, over.last + index.offset) if len(over) else ()

    def _extremes(self, expr: Expr) -> Iterator[float]:
        """Yield a value that is linear in the indices at each corner of their ranges."""
        read = {n.variable for n in walk(expr) if isinstance(n, Index) and n.variable is not None}
        axes = [self._indices[variable] for variable in sorted(read)]
        if all(map(len, axes)):
            for corner in product(*((over.first, over.last) for over in axes)):
                yield evaluate(expr, _no_name, dict(zip(sorted(read), corner, strict=True)))

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


def _holds(value: float, goal: Goal) -> bool:
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


def _axes(binding: Binding) -> tuple[IndexRange, ...]:
    return () if binding.range is None else (binding.range,)
