"""What is written more than once is computed once, under a name of its own."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from nsode.expr import (
    FUNCTIONS,
    Call,
    Expr,
    If,
    Index,
    IndexRange,
    Name,
    Number,
    Sum,
    children,
    rebuild,
    walk,
)
from nsode.ode import Binding, Definition, defined, expressions
from nsode.passes.expressions import map_definition
from nsode.passes.prune import definition_reads

#: Functions that have a value everywhere: only these may leave a branch that may be dead.
_TOTAL = frozenset({"+", "neg", "*", "abs", "min", "max", "norm", "sin", "cos", "atan", "tanh"})


class Value(NamedTuple):
    """An expression, for each index of a range where it has one."""

    expr: Expr
    range: IndexRange | None = None


def share(
    given: Sequence[Definition], definitions: Sequence[Definition], values: Sequence[Value]
) -> tuple[list[Definition], list[Expr]]:
    """Return all definitions in an order that computes, and the values that read them.

    What ``definitions`` and ``values`` have in common over one range gets names; ``given``
    stays as it is. Nothing is reordered inside an expression, so every value stays what it
    was to the last bit.
    """
    roots = [Value(expr, item.range) for item in definitions for expr in expressions(item)]
    sharing = _Sharing(_common([*roots, *values]))
    changed = [sharing.define(item) for item in definitions]
    results = [sharing.change(*value) for value in values]
    return _in_order([*given, *changed], sharing.made), results


class _Sharing:
    """Names for common expressions."""

    def __init__(self, common: frozenset[Value]) -> None:
        self.made: list[Binding] = []
        self._common = common
        self._names: dict[Value, Name] = {}

    def define(self, item: Definition) -> Definition:
        """Return a definition that reads the names; a common one lends its own."""
        if isinstance(item, Binding):
            whole = _at_home(item.value, item.range)
            if whole in self._common and whole not in self._names and whole.range == item.range:
                self._names[whole] = _element(item.name, item.range)
                return map_definition(item, lambda expr: self._inside(expr, item.range))
        return map_definition(item, lambda expr: self.change(expr, item.range))

    def change(self, expr: Expr, over: IndexRange | None) -> Expr:
        """Return an expression that reads the names."""
        if not isinstance(expr, Call | If | Sum):
            return expr
        home = _at_home(expr, over)
        if home not in self._common:
            return self._inside(expr, over)
        if home not in self._names:
            value = self._inside(expr, over)
            name = f"shared.{len(self.made) + 1}"
            self.made.append(Binding(name, value, home.range, role="part", span=expr.span))
            self._names[home] = _element(name, home.range)
        return self._names[home]

    def _inside(self, expr: Expr, over: IndexRange | None) -> Expr:
        inner = None if isinstance(expr, Sum) else over
        return rebuild(expr, lambda part: self.change(part, inner))


def _in_order(definitions: Sequence[Definition], made: Sequence[Binding]) -> list[Definition]:
    """Put what was made right behind what it reads: further on it would part two loops."""
    place = {name: k for k, item in enumerate(definitions) for name in defined(item)}
    ranked: list[tuple[int, int, Definition]] = [(k, 0, item) for k, item in enumerate(definitions)]
    for number, item in enumerate(made, 1):
        place[item.name] = max((place.get(name, -1) for name in definition_reads(item)), default=-1)
        ranked.append((place[item.name], number, item))
    return [item for _, _, item in sorted(ranked, key=lambda entry: entry[:2])]


def _common(roots: Sequence[Value]) -> frozenset[Value]:
    """Return the expressions that are worth a name."""
    uses: defaultdict[Value, list[bool]] = defaultdict(list)  # whether each is in a branch
    stack = [(root, False) for root in roots]
    while stack:
        (expr, over), guarded = stack.pop()
        if _may_have_a_name(expr):
            home = _at_home(expr, over)
            uses[home].append(guarded)
            if len(uses[home]) > 1 and _can_stand(home):
                continue
        inner = None if isinstance(expr, Sum) else over
        stack += [(Value(part, inner), guarded or dead) for part, dead in _parts(expr)]
    return frozenset(
        value
        for value, guards in uses.items()
        if len(guards) > 1
        and _can_stand(value)
        and _saves(value.expr, len(guards))
        and not (all(guards) and _fails(value.expr))
    )


def _parts(expr: Expr) -> Iterator[tuple[Expr, bool]]:
    """Yield what stands inside an expression, and whether it may be left uncomputed."""
    match expr:
        case If(condition, then, otherwise):
            yield from ((condition, False), (then, True), (otherwise, True))
        case Call("and" | "or", (first, *further)):
            yield first, False
            yield from ((part, True) for part in further)
        case _:
            yield from ((part, False) for part in children(expr))


def _at_home(expr: Expr, over: IndexRange | None) -> Value:
    """Return an expression with the range that it depends on."""
    return Value(expr, over if over is not None and any(_indices(expr)) else None)


def _indices(expr: Expr) -> Iterator[str]:
    """Yield the index variables that an expression reads."""
    for node in walk(expr):
        match node:
            case Name(_, Index(str() as variable)) | Index(str() as variable):
                yield variable
            case _:
                pass


def _can_stand(value: Value) -> bool:
    own = None if value.range is None else value.range.variable
    return all(variable == own for variable in _indices(value.expr))


def _element(name: str, over: IndexRange | None) -> Name:
    return Name(name, None if over is None else Index(over.variable))


def _may_have_a_name(expr: Expr) -> bool:
    match expr:
        case Call(function):
            return function != "neg" and not FUNCTIONS[function].boolean
        case _:
            return isinstance(expr, If)


def _saves(expr: Expr, count: int) -> bool:
    """Whether a name saves operations, and more of them than it costs to read."""
    if not any(isinstance(node, Name) for node in walk(expr)):
        return False
    return sum(map(_price, walk(expr))) * (count - 1) > 1


def _price(node: Expr) -> int:
    match node:
        case Call("neg", _):
            return 0
        case Call(function, args) if not all(isinstance(arg, Number) for arg in args):
            return 1 if function in ("+", "*", "abs") else 2
        case _:
            return 0


def _fails(expr: Expr) -> bool:
    """Whether an expression may have no value in a branch that is not taken.

    An element may lie outside of its family there.
    """
    return any(
        (isinstance(node, Call) and node.function not in _TOTAL)
        or (isinstance(node, Name) and node.at is not None)
        for node in walk(expr)
    )
