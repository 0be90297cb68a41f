"""Which expressions are the same: numbers for values, looking through bindings.

Two expressions get one number if they agree up to the order of sums and products and
a numeric factor, which is kept apart. Every binding is numbered once, so the cost
stays linear however deep the bindings are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import NamedTuple

from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum, children
from nsode.inclusion.order import deepest_first
from nsode.ode import Binding


class Scaled(NamedTuple):
    """``scale`` times the value with number ``id``; 0 numbers the constant one."""

    scale: float
    id: int


_Place = tuple[str | None, int]
_Indices = Mapping[str, _Place]
_Key = tuple[str, _Place | None]
#: The number of the constant one.
ONE = 0


@dataclass(slots=True)
class Numbering:
    """Numbers of values, over the bindings known so far."""

    bindings: dict[str, Binding] = field(default_factory=dict)
    _numbers: dict[object, int] = field(default_factory=dict)
    _known: dict[_Key, Scaled] = field(default_factory=dict)

    @classmethod
    def over(cls, bindings: Iterable[Binding]) -> Numbering:
        """Return a numbering that looks through some bindings."""
        return cls({binding.name: binding for binding in bindings})

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
        return Scaled(scale, self._of(("vector", *_relative(found, scale))))

    def number(self, expr: Expr, indices: _Indices) -> Scaled:
        """Return the number of a scalar expression."""
        self._prepare(expr, indices)
        return self._number(expr, indices)

    def _prepare(self, expr: Expr, indices: _Indices) -> None:
        """Give numbers to what ``expr`` rests on, so that no recursion follows names."""
        for key in deepest_first(self._bound(expr, indices), self._below, self._known):
            binding, inside = self._inside(key)
            self._known[key] = self._number(binding.value, inside)

    def _below(self, key: _Key) -> Iterator[_Key]:
        binding, inside = self._inside(key)
        return self._bound(binding.value, inside)

    def _bound(self, expr: Expr, indices: _Indices) -> Iterator[_Key]:
        """Yield the bindings that an expression reads, with their places."""
        stack = [(expr, indices)]
        while stack:
            node, here = stack.pop()
            if isinstance(node, Name) and node.id in self.bindings:
                yield _key(node, here)
            elif isinstance(node, Sum):
                stack.append((node.body, _within(node.range, here)))
            else:
                stack.extend((child, here) for child in children(node))

    def _inside(self, key: _Key) -> tuple[Binding, _Indices]:
        """Return a binding and what its index stands for."""
        name, at = key
        binding = self.bindings[name]
        if binding.range is None or at is None:
            return binding, {}
        return binding, {binding.range.variable: at}

    def _number(self, expr: Expr, indices: _Indices) -> Scaled:
        match expr:
            case Number(value):
                return Scaled(value, ONE)
            case Index():
                return Scaled(1.0, self._of(("index", _place(expr, indices))))
            case Name():
                key = _key(expr, indices)
                return self._known[key] if key in self._known else self._plain(("name", key))
            case Call("neg", (inner,)):
                scale, id = self._number(inner, indices)
                return Scaled(-scale, id)
            case Call("+", terms):
                return self._sum([self._number(term, indices) for term in terms])
            case Call("*", (left, right)):
                return self._product(self._number(left, indices), self._number(right, indices))
            case Call("/", (left, right)):
                return self._quotient(self._number(left, indices), self._number(right, indices))
            case Call(function, args):
                return self._plain((function, *(self._number(arg, indices) for arg in args)))
            case If():
                return self._plain(("if", *(self._number(e, indices) for e in children(expr))))
            case Sum(over, body):
                number = self._number(body, _within(over, indices))
                return self._plain(("sum", over.first, over.last, number))
        raise NotImplementedError(f"no number for {type(expr).__name__}")

    def _of(self, structure: object) -> int:
        return self._numbers.setdefault(structure, len(self._numbers) + 1)

    def _plain(self, structure: object) -> Scaled:
        return Scaled(1.0, self._of(structure))

    def _sum(self, terms: list[Scaled]) -> Scaled:
        together: dict[int, float] = {}
        for scale, id in terms:
            together[id] = together.get(id, 0.0) + scale
        kept = [Scaled(scale, id) for id, scale in sorted(together.items()) if scale]
        if len(kept) == 1:
            return kept[0]
        if not kept:
            return Scaled(0.0, ONE)
        scale = kept[0].scale
        return Scaled(scale, self._of(("+", *_relative(kept, scale))))

    def _product(self, left: Scaled, right: Scaled) -> Scaled:
        scale = left.scale * right.scale
        if not isfinite(scale):
            return self._plain(("*", left, right))
        factors = sorted(one.id for one in (left, right) if one.id != ONE)
        if len(factors) < 2:
            return Scaled(scale, factors[0] if factors else ONE)
        return Scaled(scale, self._of(("*", *factors)))

    def _quotient(self, left: Scaled, right: Scaled) -> Scaled:
        if right.scale == 0 or not isfinite(left.scale / right.scale):
            return self._plain(("/", left, right))
        if right.id == ONE:
            return Scaled(left.scale / right.scale, left.id)
        return Scaled(left.scale / right.scale, self._of(("/", left.id, right.id)))


def _relative(terms: Iterable[Scaled], scale: float) -> Iterator[Scaled]:
    """Yield terms over a common factor, rounded so that 0.3/0.1 is 3."""
    return (Scaled(float(f"{term.scale / scale:.14g}"), term.id) for term in terms)


def _within(over: IndexRange, indices: _Indices) -> _Indices:
    """Return the indices inside a sum; its own is told apart from those outside."""
    taken = max((len(name) for name, _ in indices.values() if name), default=0)
    return {**indices, over.variable: ("#" * (taken + 1), 0)}


def _key(name: Name, indices: _Indices) -> _Key:
    return name.id, None if name.at is None else _place(name.at, indices)


def _place(index: Index, indices: _Indices) -> _Place:
    if index.variable is None:
        return None, index.offset
    variable, offset = indices.get(index.variable, (index.variable, 0))
    return variable, offset + index.offset
