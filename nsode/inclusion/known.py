"""Values that are known before a run begins, since they rest on parameters alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from nsode.evaluate import evaluate, position
from nsode.expr import Expr, Sum, names, walk
from nsode.inclusion.order import deepest_first
from nsode.ode import Binding, Parameter, element

#: A name and the element of its family, None for a scalar.
_Key = tuple[str, int | None]
_At = Mapping[str, int]
_NO_INDEX: _At = {}
_GOLDEN = 0.6180339887498949


@dataclass(slots=True)
class Constants:
    """Values that rest on parameters alone, through lets; None for all others."""

    bindings: Mapping[str, Binding]
    values: dict[_Key, float | None]

    @classmethod
    def of(cls, parameters: Sequence[Parameter], bindings: Sequence[Binding]) -> Constants:
        """Return what is known of a model before a run."""
        values: dict[_Key, float | None] = {}
        for parameter in parameters:
            values.update(zip(places(parameter), parameter.values, strict=True))
        return cls({binding.name: binding for binding in bindings}, values)

    def of_all(self, exprs: Sequence[Expr], at: _At = _NO_INDEX) -> list[float] | None:
        """Return the values of expressions at an index, None unless all are constant."""
        for key in deepest_first(_keys(exprs, at), self._below, self.values):
            bound = key[0] in self.bindings
            self.values[key] = self._value(*self._inside(key)) if bound else None
        found = [self._value(expr, at) for expr in exprs]
        return None if None in found else [value for value in found if value is not None]

    def elsewhere(self) -> Constants:
        """Return what would be known at other values, in no simple relation to each other."""
        parameters = [key for key in self.values if key[0] not in self.bindings]
        values = {key: 0.5 + k * _GOLDEN % 1 for k, key in enumerate(parameters, start=1)}
        return Constants(self.bindings, dict(values))

    def read(self, exprs: Sequence[Expr], at: _At) -> dict[str, float]:
        """Return the parameters that constant expressions rest on, with their values."""
        keys: dict[_Key, None] = {}
        for key in deepest_first(_keys(exprs, at), self._below, keys):
            keys[key] = None
        found = {key: self.values[key] for key in keys if key[0] not in self.bindings}
        return {
            name if k is None else element(name, k): value
            for (name, k), value in found.items()
            if value is not None
        }

    def _inside(self, key: _Key) -> tuple[Expr, _At]:
        """Return what defines a value, and what its index is."""
        name, k = key
        binding = self.bindings[name]
        over = binding.range
        return binding.value, {} if over is None or k is None else {over.variable: k}

    def _below(self, key: _Key) -> Iterator[_Key]:
        if key[0] in self.bindings:
            expr, at = self._inside(key)
            yield from _keys([expr], at)

    def _value(self, expr: Expr, at: _At) -> float | None:
        if _has_sum(expr) or any(self.values.get(key) is None for key in _keys([expr], at)):
            return None
        return evaluate(expr, lambda name, k: self.values[name, k] or 0.0, at)


def _has_sum(expr: Expr) -> bool:
    return any(isinstance(node, Sum) for node in walk(expr))


def _keys(exprs: Sequence[Expr], at: _At) -> Iterator[_Key]:
    """Yield what expressions read, none of it in sums."""
    for expr in exprs:
        for name in () if _has_sum(expr) else names(expr):
            yield name.id, None if name.at is None else position(name.at, at)


def places(item: Parameter) -> list[tuple[str, int | None]]:
    """Return the name of a parameter with the index of each element, None for a scalar."""
    if item.range is None:
        return [(item.name, None)]
    return [(item.name, k) for k in range(item.range.first, item.range.last + 1)]
