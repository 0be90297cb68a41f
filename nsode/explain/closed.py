"""The augmented ODE as the paper writes (37) and (45): forces in closed form."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from nsode.explain.definitions import behind
from nsode.expr import Expr, IndexRange
from nsode.ode import Binding, Definition, Rate, SetValuedTerm
from nsode.passes.split import pieces, split

if TYPE_CHECKING:
    from nsode.explain import Explanation


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
    return [*own, *(Rate(rate.state, value, over) for rate, (over, value) in parts)]


def values(explanation: Explanation) -> Iterator[Value | Definition]:
    """Yield what the rates rest on, in order; each term by the force that replaced it."""
    steps = {step.term.name: step for step in explanation.steps}
    for item in behind(explanation.inclusion):
        match item:
            case SetValuedTerm(name=name, range=over):
                for names, value in steps[name].values:
                    for part, piece in _parts(over, value):
                        yield Value(names, piece, part)
            case Binding(name=name, value=value, range=over):
                for part, piece in _parts(over, value):
                    yield Value((name,), piece, part)
            case _:
                yield item


def _parts(over: IndexRange | None, value: Expr) -> Iterator[tuple[IndexRange | None, Expr]]:
    if over is None:
        yield None, value
        return
    for part, (piece,) in pieces(over, value):
        yield part, piece
