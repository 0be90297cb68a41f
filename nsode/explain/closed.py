"""The augmented ODE as the paper writes (37) and (45): forces in closed form."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from nsode.explain.definitions import behind
from nsode.expr import Call, Expr, IndexRange, Number, add, rebuild
from nsode.ode import Definition, Rate, SetValuedTerm
from nsode.passes.expressions import map_definition, map_rate
from nsode.passes.split import pieces, split, split_definition

if TYPE_CHECKING:
    from nsode.explain import Explanation


_ZERO = Number(0.0)


class Value(NamedTuple):
    """``names = value``; a vector where there are several."""

    names: tuple[str, ...]
    value: Expr
    range: IndexRange | None


def rates(explanation: Explanation) -> list[Rate]:
    """Return the rates of the model's own states, then those that were appended."""
    appended = {item.name for item in explanation.ode.auxiliary}
    own = [rate for rate in split(explanation.ode).rates if rate.state not in appended]
    closed = [rate for step in explanation.steps for rate in step.rates]
    parts = [(rate, part) for rate in closed for part in _parts(rate.range, rate.value)]
    whole = [*own, *(Rate(rate.state, value, over) for rate, (over, value) in parts)]
    return [map_rate(rate, _without_zeros) for rate in whole]


def values(explanation: Explanation) -> Iterator[Value | Definition]:
    """Yield what the rates rest on, in order; each term by the force that replaced it."""
    steps = {step.term.name: step for step in explanation.steps}
    for item in behind(explanation.inclusion):
        if isinstance(item, SetValuedTerm):
            for names, value in steps[item.name].values:
                for part, piece in _parts(item.range, value):
                    yield Value(names, _without_zeros(piece), part)
        else:
            for definition in split_definition(item):
                yield map_definition(definition, _without_zeros)


def _parts(over: IndexRange | None, value: Expr) -> Iterator[tuple[IndexRange | None, Expr]]:
    if over is None:
        yield None, value
        return
    for part, (piece,) in pieces(over, value):
        yield part, piece


def _without_zeros(expr: Expr) -> Expr:
    """Leave out the zeros that are added where a family has a wall."""
    inner = rebuild(expr, _without_zeros)
    match inner:
        case Call("+", terms):
            kept = [term for term in terms if term not in (_ZERO, Call("neg", (_ZERO,)))]
            return add(*kept) if kept else _ZERO
        case _:
            return inner
