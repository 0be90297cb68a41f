"""What does not change while a model runs: formulas of parameters, seen through lets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice

from nsode.expr import Call, Expr, If, Name, Number, rebuild, walk
from nsode.ode import Binding, DifferentialInclusion

#: Names seen through, and nodes of a formula, beyond which it counts as moving.
_DEPTH, _NODES = 20, 200


@dataclass(frozen=True, slots=True)
class Fixed:
    """The parameters of one number, and the definitions that may be made of them."""

    parameters: frozenset[str]
    definitions: Mapping[str, Expr]

    @classmethod
    def of(cls, inclusion: DifferentialInclusion) -> Fixed:
        """Return what may be fixed in an inclusion."""
        single = (p.name for p in inclusion.parameters if len(p.values) == 1 and p.range is None)
        bindings = (item for item in inclusion.bindings if isinstance(item, Binding))
        return cls(
            frozenset(single), {item.name: item.value for item in bindings if item.range is None}
        )

    def formula(self, expr: Expr | None) -> Expr | None:
        """Return an expression in parameters alone; None where it moves."""
        for _ in range(_DEPTH):
            if expr is None or _is_long(expr):
                return None
            if self._is_made_of_parameters(expr):
                return expr
            expr = self._through(expr)
        return None

    def _is_made_of_parameters(self, expr: Expr) -> bool:
        return all(
            isinstance(node, Number | Call | If)
            or (isinstance(node, Name) and node.at is None and node.id in self.parameters)
            for node in walk(expr)
        )

    def _through(self, expr: Expr) -> Expr:
        """Return an expression with each definition replaced by its formula."""
        if isinstance(expr, Name):
            return self.definitions.get(expr.id, expr)
        return rebuild(expr, self._through)


def _is_long(expr: Expr) -> bool:
    return sum(1 for _ in islice(walk(expr), _NODES + 1)) > _NODES
