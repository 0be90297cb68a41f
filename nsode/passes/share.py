"""What is written more than once is computed once, under a name of its own."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from nsode.expr import FUNCTIONS, Call, Expr, If, Index, Name, Number, Sum, children, rebuild, walk
from nsode.ode import Binding, Definition, defined, expressions
from nsode.passes.expressions import map_definition
from nsode.passes.prune import definition_reads

#: Functions that have a value everywhere: only these may leave a branch that may be dead.
_TOTAL = frozenset({"+", "neg", "*", "abs", "min", "max", "norm", "sin", "cos", "atan", "tanh"})


def share(
    given: Sequence[Definition], definitions: Sequence[Definition], values: Sequence[Expr]
) -> tuple[list[Definition], list[Expr]]:
    """Return all definitions in an order that computes, and the values that read them.

    What ``definitions`` and ``values`` have in common gets names; ``given`` stays as it is.
    What reads an open index stays where it is, and nothing is reordered inside an
    expression, so every value stays what it was to the last bit.
    """
    sharing = _Sharing(_common([*(e for d in definitions for e in expressions(d)), *values]))
    changed = [sharing.define(item) for item in definitions]
    results = [sharing.change(value) for value in values]
    return _in_order([*given, *changed], sharing.made), results


class _Sharing:
    """Names for common expressions."""

    def __init__(self, common: frozenset[Expr]) -> None:
        self.made: list[Binding] = []
        self._common = common
        self._names: dict[Expr, Name] = {}

    def define(self, item: Definition) -> Definition:
        """Return a definition that reads the names; a common one lends its own."""
        match item:
            case Binding(name, value, None) if value in self._common and value not in self._names:
                self._names[value] = Name(name)
                return map_definition(item, lambda expr: rebuild(expr, self.change))
            case _:
                return map_definition(item, self.change)

    def change(self, expr: Expr) -> Expr:
        """Return an expression that reads the names."""
        if not isinstance(expr, Call | If | Sum):
            return expr
        if expr not in self._common:
            return rebuild(expr, self.change)
        if expr not in self._names:
            value = rebuild(expr, self.change)
            name = f"shared.{len(self.made) + 1}"
            self.made.append(Binding(name, value, role="part", span=expr.span))
            self._names[expr] = Name(name)
        return self._names[expr]


def _in_order(definitions: Sequence[Definition], made: Sequence[Binding]) -> list[Definition]:
    """Put what was made right behind what it reads: further on it would part two loops."""
    place = {name: k for k, item in enumerate(definitions) for name in defined(item)}
    ranked: list[tuple[int, int, Definition]] = [(k, 0, item) for k, item in enumerate(definitions)]
    for number, item in enumerate(made, 1):
        place[item.name] = max((place.get(name, -1) for name in definition_reads(item)), default=-1)
        ranked.append((place[item.name], number, item))
    return [item for _, _, item in sorted(ranked, key=lambda entry: entry[:2])]


def _common(roots: Sequence[Expr]) -> frozenset[Expr]:
    """Return the expressions that are worth a name."""
    uses: defaultdict[Expr, list[bool]] = defaultdict(list)  # whether each is in a branch
    stack = [(root, False) for root in roots]
    while stack:
        expr, guarded = stack.pop()
        if _may_have_a_name(expr):
            known = uses[expr]
            known.append(guarded)
            if len(known) > 1 and not _is_indexed(expr):
                continue
        stack += _inside(expr, guarded)
    return frozenset(
        expr
        for expr, guards in uses.items()
        if len(guards) > 1 and _is_worth(expr, len(guards)) and not (all(guards) and _fails(expr))
    )


def _inside(expr: Expr, guarded: bool) -> list[tuple[Expr, bool]]:
    """Return what stands inside an expression, and whether it may be left uncomputed."""
    match expr:
        case If(condition, then, otherwise):
            return [(condition, guarded), (then, True), (otherwise, True)]
        case Call("and" | "or", (first, *further)):
            return [(first, guarded), *((part, True) for part in further)]
        case _:
            return [(part, guarded) for part in children(expr)]


def _may_have_a_name(expr: Expr) -> bool:
    match expr:
        case Call(function):
            return function != "neg" and not FUNCTIONS[function].boolean
        case _:
            return isinstance(expr, If)


def _is_worth(expr: Expr, count: int) -> bool:
    """Whether a name saves something, and may stand outside of every loop."""
    if _is_indexed(expr) or not any(isinstance(node, Name) for node in walk(expr)):
        return False
    return sum(map(_is_operation, walk(expr))) * (count - 1) > 1


def _is_indexed(expr: Expr) -> bool:
    return any(isinstance(node, Name | Index) and _runs(node) for node in walk(expr))


def _runs(node: Name | Index) -> bool:
    at = node.at if isinstance(node, Name) else node
    return at is not None and at.variable is not None


def _is_operation(expr: Expr) -> bool:
    match expr:
        case Call(function, args):
            return function != "neg" and not all(isinstance(arg, Number) for arg in args)
        case _:
            return False


def _fails(expr: Expr) -> bool:
    """Whether an expression may have no value in a branch that is not taken."""
    return any(isinstance(node, Call) and node.function not in _TOTAL for node in walk(expr))
