"""Proofs that a value keeps its sign.

The proof follows the structure of the expression, through bindings, from declared
bounds, assumptions and what dio, abs, norm and the like are known for. A parameter
without a bound lends the sign of its value; the proof says which it used, so that
just these can be guarded.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from nsode.expr import Call, Expr, If, Name, Number, Sum
from nsode.inclusion.sharing import Numbering
from nsode.ode import Parameter

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
_NONNEGATIVE = {"abs", "norm", "sqrt"}
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
    _known: dict[tuple[str, Goal], Proof | None] = field(default_factory=dict)
    _seen: dict[tuple[int, Goal], tuple[Expr, Proof | None]] = field(default_factory=dict)

    def assume(self, expr: Expr, goal: Goal) -> None:
        """Take ``expr goal 0`` for granted; a check guards it elsewhere."""
        scale, id = self.numbering.number(expr, {})
        self.facts.setdefault(id, set()).add(goal if scale > 0 else _OPPOSITE[goal])

    def prove(self, expr: Expr, goal: Goal) -> Proof | None:
        """Return the guards under which ``expr goal 0`` holds, None without a proof."""
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
            case Sum(body=body):
                return self.prove(body, _WEAK[goal]) if goal in {">=", "<="} else None
            case If(_, then, otherwise):
                return self._all((then, goal), (otherwise, goal))
            case Call("neg", (inner,)):
                return self.prove(inner, _OPPOSITE[goal])
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
        binding = self.numbering.bindings.get(expr.id)
        if binding is None:
            return None
        key = (expr.id, goal)
        if key not in self._known:
            self._known[key] = self.prove(binding.value, goal)
        return self._known[key]

    def _all(self, *goals: tuple[Expr, Goal]) -> Proof | None:
        guards = _NOTHING
        for expr, goal in goals:
            proof = self.prove(expr, goal)
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
        return self.prove(base, goal) if goal in {">", ">="} else None

    def _extreme(self, function: str, left: Expr, right: Expr, goal: Goal) -> Proof | None:
        if (function == "max") == (goal in {">", ">="}):
            return self._any(((left, goal),), ((right, goal),))
        return self._all((left, goal), (right, goal))

    def _function(self, function: str, args: tuple[Expr, ...], goal: Goal) -> Proof | None:
        if goal in {"<", "<="}:
            return self.prove(args[0], goal) if function in _ODD else None
        if function in _POSITIVE:
            return _NOTHING
        if function in _NONNEGATIVE:
            if goal == ">=":
                return _NOTHING
            return self._any(*(((arg, g),) for arg in args for g in _STRICT))
        if function in _ODD:
            return self.prove(args[0], goal)
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
