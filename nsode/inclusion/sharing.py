"""Which expressions are the same: numbers for values, looking through bindings.

Two expressions get one number if they agree up to the order of sums and products and
a numeric factor, which is kept apart. Every binding is numbered once, so the cost
stays linear however deep the bindings are.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from nsode.expr import Call, Expr, If, Index, Name, Number, Sum
from nsode.ode import Binding


class Scaled(NamedTuple):
    """``scale`` times the value with number ``id``; 0 numbers the constant one."""

    scale: float
    id: int


_Place = tuple[str | None, int]
_Indices = Mapping[str, _Place]
_ONE = 0


@dataclass(slots=True)
class Numbering:
    """Numbers of values, over the bindings known so far."""

    bindings: dict[str, Binding] = field(default_factory=dict)
    _numbers: dict[object, int] = field(default_factory=dict)
    _known: dict[object, Scaled] = field(default_factory=dict)

    def add(self, binding: Binding) -> None:
        """Let later expressions look through a binding."""
        self.bindings[binding.name] = binding

    def vector(self, components: tuple[Expr, ...], variable: str | None = None) -> Scaled:
        """Return the number of a vector, with one common factor.

        ``variable`` is the index over which the vector is a family: families over one
        range agree whatever their index is called.
        """
        indices: _Indices = {} if variable is None else {variable: ("#", 0)}
        found = [self.number(component, indices) for component in components]
        scale = next((one.scale for one in found if one.scale), 1.0)
        return Scaled(scale, self._of(("vector", *((s / scale, id) for s, id in found))))

    def number(self, expr: Expr, indices: _Indices) -> Scaled:
        """Return the number of a scalar expression."""
        match expr:
            case Number(value):
                return Scaled(value, _ONE)
            case Index():
                return Scaled(1.0, self._of(("index", self._place(expr, indices))))
            case Name():
                return self._name(expr, indices)
            case Call("neg", (inner,)):
                scale, id = self.number(inner, indices)
                return Scaled(-scale, id)
            case Call("+", terms):
                return self._sum([self.number(term, indices) for term in terms])
            case Call("*", (left, right)):
                return self._product(self.number(left, indices), self.number(right, indices))
            case Call("/", (left, right)):
                return self._quotient(self.number(left, indices), self.number(right, indices))
            case Call(function, args):
                numbers = tuple(self.number(arg, indices) for arg in args)
                return Scaled(1.0, self._of((function, numbers)))
            case If(condition, then, otherwise):
                parts = (condition, then, otherwise)
                numbers = tuple(self.number(part, indices) for part in parts)
                return Scaled(1.0, self._of(("if", numbers)))
            case Sum(over, body):
                variable, first, last = over
                inside = {**indices, variable: ("sum", 0)}
                number = self.number(body, inside)
                return Scaled(1.0, self._of(("sum", first, last, number)))
        raise NotImplementedError(f"no number for {type(expr).__name__}")

    def _of(self, structure: object) -> int:
        return self._numbers.setdefault(structure, len(self._numbers) + 1)

    def _place(self, index: Index, indices: _Indices) -> _Place:
        if index.variable is None:
            return None, index.offset
        variable, offset = indices.get(index.variable, (index.variable, 0))
        return variable, offset + index.offset

    def _name(self, expr: Name, indices: _Indices) -> Scaled:
        at = None if expr.at is None else self._place(expr.at, indices)
        key = (expr.id, at)
        if key in self._known:
            return self._known[key]
        binding = self.bindings.get(expr.id)
        if binding is None:
            found = Scaled(1.0, self._of(("name", key)))
        elif binding.range is None or at is None:
            found = self.number(binding.value, {})
        else:
            found = self.number(binding.value, {binding.range.variable: at})
        self._known[key] = found
        return found

    def _sum(self, terms: list[Scaled]) -> Scaled:
        kept = sorted((term for term in terms if term.scale), key=lambda term: term.id)
        if len(kept) == 1:
            return kept[0]
        if not kept:
            return Scaled(0.0, _ONE)
        scale = kept[0].scale
        return Scaled(scale, self._of(("+", *((s / scale, id) for s, id in kept))))

    def _product(self, left: Scaled, right: Scaled) -> Scaled:
        scale = left.scale * right.scale
        factors = sorted(one.id for one in (left, right) if one.id != _ONE)
        if len(factors) < 2:
            return Scaled(scale, factors[0] if factors else _ONE)
        return Scaled(scale, self._of(("*", *factors)))

    def _quotient(self, left: Scaled, right: Scaled) -> Scaled:
        if right.scale == 0:
            return Scaled(1.0, self._of(("/", left, right)))
        if right.id == _ONE:
            return Scaled(left.scale / right.scale, left.id)
        return Scaled(left.scale / right.scale, self._of(("/", left.id, right.id)))
