"""What is written more than once is computed once, under a name of its own."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from math import copysign
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
)
from nsode.ode import Binding, Definition, defined, expressions
from nsode.passes.expressions import map_definition
from nsode.passes.prune import definition_reads

#: Functions that have a value everywhere: only these may leave a branch that may be dead.
_TOTAL = frozenset({"+", "neg", "*", "abs", "min", "max", "norm", "sin", "cos", "atan", "tanh"})


#: What functions cost, in additions, where that is not two; a sign costs nothing.
_PRICES = {"neg": 0, "+": 1, "*": 1, "abs": 1}
#: Definitions and values beyond which all stay as they are: from text to code would take half
#: as long again, for what an optimizing compiler finds too.
_MOST = 3000
_NONE: frozenset[str] = frozenset()


class Value(NamedTuple):
    """An expression, for each index of a range where it has one."""

    expr: Expr
    range: IndexRange | None = None


class _Facts(NamedTuple):
    """What is known of an expression: ``number`` is that of all which are equal to it.

    ``variables`` are the indices that it reads. It may fail where it may have no value in a
    branch that is not taken; an element may lie outside of its family there.
    """

    number: int
    variables: frozenset[str]
    price: int
    reads: bool
    may_fail: bool


class _Home(NamedTuple):
    """Where a value is the same: its number, and the range that it depends on."""

    number: int
    range: IndexRange | None


def share(
    given: Sequence[Definition], definitions: Sequence[Definition], values: Sequence[Value]
) -> tuple[list[Definition], list[Expr]]:
    """Return all definitions in an order that computes, and the values that read them.

    What ``definitions`` and ``values`` have in common over one range gets names; ``given``
    stays as it is. Nothing is reordered inside an expression, so every value stays what it
    was to the last bit. Scenes with very many definitions are left to the compiler.
    """
    if len(definitions) + len(values) > _MOST:
        return [*given, *definitions], [value.expr for value in values]
    roots = [Value(expr, item.range) for item in definitions for expr in expressions(item)]
    known = _Known()
    sharing = _Sharing(known, _common([*roots, *values], known))
    changed = [sharing.define(item) for item in definitions]
    results = [sharing.change(*value) for value in values]
    return _in_order([*given, *changed], sharing.made), results


class _Known:
    """Facts about expressions, each found once, however large it is and often it stands."""

    def __init__(self) -> None:
        self._facts: dict[int, tuple[_Facts, Expr]] = {}  # an id lasts as long as what has it
        self._leaves: dict[tuple[object, ...], _Facts] = {}
        self._numbers: dict[tuple[object, ...], int] = {}

    def of(self, expr: Expr) -> _Facts:
        """Return what is known of an expression."""
        if isinstance(expr, Name | Number | Index):
            return self._leaf(expr)
        found = self._facts.get(id(expr))
        if found is None:
            found = self._facts[id(expr)] = self._compound(expr), expr
        return found[0]

    def home(self, expr: Expr, over: IndexRange | None) -> _Home:
        """Return where an expression over a range is the same."""
        facts = self.of(expr)
        return _Home(facts.number, over if facts.variables else None)

    def _leaf(self, expr: Name | Number | Index) -> _Facts:
        at: Index | None = None
        key: tuple[object, ...]
        match expr:
            case Name(id, at):
                key = id, at
            case Number(value):
                key = value, copysign(1.0, value)
            case Index():
                key, at = (expr,), expr
        found = self._leaves.get(key)
        if found is None:
            read = frozenset({at.variable} if at is not None and at.variable else ())
            is_name = isinstance(expr, Name)
            facts = _Facts(self._number(key), read, 0, is_name, is_name and at is not None)
            found = self._leaves[key] = facts
        return found

    def _compound(self, expr: Expr) -> _Facts:
        parts = list(map(self.of, children(expr)))
        match expr:
            case Call(function, args):
                own: object = function
                price = (
                    0 if all(isinstance(arg, Number) for arg in args) else _PRICES.get(function, 2)
                )
            case If():
                own, price = If, 0
            case Sum(over):
                own, price = over, 0
            case _:
                raise NotImplementedError(f"no number for {type(expr).__name__}")
        may_fail = isinstance(expr, Call) and expr.function not in _TOTAL
        variables, reads = _NONE, False
        for part in parts:
            price += part.price
            reads = reads or part.reads
            may_fail = may_fail or part.may_fail
            if part.variables:
                variables |= part.variables
        number = self._number((own, *[part.number for part in parts]))
        return _Facts(number, variables, price, reads, may_fail)

    def _number(self, key: tuple[object, ...]) -> int:
        return self._numbers.setdefault(key, len(self._numbers))


class _Sharing:
    """Names for common expressions."""

    def __init__(self, known: _Known, common: frozenset[_Home]) -> None:
        self.made: list[Binding] = []
        self._known = known
        self._common = common
        self._names: dict[_Home, Name] = {}

    def define(self, item: Definition) -> Definition:
        """Return a definition that reads the names; a common one lends its own."""
        if isinstance(item, Binding):
            whole = self._known.home(item.value, item.range)
            if whole in self._common and whole not in self._names and whole.range == item.range:
                self._names[whole] = _element(item.name, item.range)
                return map_definition(item, lambda expr: self._inside(expr, item.range))
        return map_definition(item, lambda expr: self.change(expr, item.range))

    def change(self, expr: Expr, over: IndexRange | None) -> Expr:
        """Return an expression that reads the names."""
        if not isinstance(expr, Call | If | Sum):
            return expr
        home = self._known.home(expr, over)
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


def _common(roots: Sequence[Value], known: _Known) -> frozenset[_Home]:
    """Return where expressions are the same that are worth a name."""
    uses: defaultdict[_Home, list[bool]] = defaultdict(list)  # whether each is in a branch
    facts: dict[int, _Facts] = {}
    stack = [(expr, over, False) for expr, over in roots]
    while stack:
        expr, over, guarded = stack.pop()
        if _may_have_a_name(expr):
            found, home = known.of(expr), known.home(expr, over)
            if _can_stand(found, home):
                facts[home.number] = found
                uses[home].append(guarded)
                if len(uses[home]) > 1:
                    continue
        inner = None if isinstance(expr, Sum) else over
        for part, dead in _parts(expr):
            if isinstance(part, Call | If | Sum):
                stack.append((part, inner, guarded or dead))
    return frozenset(
        home
        for home, guards in uses.items()
        if len(guards) > 1
        and _saves(facts[home.number], len(guards))
        and not (all(guards) and facts[home.number].may_fail)
    )


def _can_stand(facts: _Facts, home: _Home) -> bool:
    return not facts.variables or (
        home.range is not None and facts.variables == {home.range.variable}
    )


def _parts(expr: Expr) -> list[tuple[Expr, bool]]:
    """Return what stands inside an expression, and whether it may be left uncomputed."""
    match expr:
        case If(condition, then, otherwise):
            return [(condition, False), (then, True), (otherwise, True)]
        case Call("and" | "or", (first, *further)):
            return [(first, False), *((part, True) for part in further)]
        case _:
            return [(part, False) for part in children(expr)]


def _element(name: str, over: IndexRange | None) -> Name:
    return Name(name, None if over is None else Index(over.variable))


def _may_have_a_name(expr: Expr) -> bool:
    match expr:
        case Call(function):
            return function != "neg" and not FUNCTIONS[function].boolean
        case _:
            return isinstance(expr, If)


def _saves(facts: _Facts, count: int) -> bool:
    """Whether a name saves operations, and more of them than it costs to read."""
    return facts.reads and facts.price * (count - 1) > 1
