"""What does not change while a model runs: formulas of parameters, seen through lets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import islice

from nsode.expr import Call, Expr, If, Index, Name, Number, rebuild, walk
from nsode.ode import Binding, DifferentialInclusion

#: Names seen through, and nodes of a formula, beyond which it counts as moving.
_DEPTH, _NODES = 20, 200


@dataclass(frozen=True, slots=True)
class Fixed:
    """The parameters, and the definitions that may be made of them."""

    parameters: frozenset[str]
    definitions: Mapping[str, Binding]

    @classmethod
    def of(cls, inclusion: DifferentialInclusion) -> Fixed:
        """Return what may be fixed in an inclusion."""
        bindings = (item for item in inclusion.bindings if isinstance(item, Binding))
        parameters = frozenset(parameter.name for parameter in inclusion.parameters)
        return cls(parameters, {item.name: item for item in bindings})

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
            or (isinstance(node, Name) and node.id in self.parameters and _is_one(node))
            for node in walk(expr)
        )

    def _through(self, expr: Expr) -> Expr:
        """Return an expression with each definition replaced by its formula."""
        match expr:
            case Name(id) if id in self.definitions and _is_one(expr):
                binding = self.definitions[id]
                if binding.range is None or expr.at is None:
                    return binding.value
                return _element(binding.value, binding.range.variable, expr.at.offset)
        return rebuild(expr, self._through)


def _is_one(name: Name) -> bool:
    """Tell whether a name is that of a scalar, or of an element that does not vary."""
    return name.at is None or name.at.variable is None


def _element(expr: Expr, variable: str, k: int) -> Expr:
    """Return the formula of a family for one of its elements."""
    match expr:
        case Index(name, offset) if name == variable:
            return Number(float(offset + k), span=expr.span)
        case Name(_, Index(name, offset) as at) if name == variable:
            return replace(expr, at=Index(None, offset + k, span=at.span))
    return rebuild(expr, lambda part: _element(part, variable, k))


def _is_long(expr: Expr) -> bool:
    return sum(1 for _ in islice(walk(expr), _NODES + 1)) > _NODES
