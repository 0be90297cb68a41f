"""Signs that are taken for granted: of one value, or of the elements of a family."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from nsode.expr import Expr, Index, IndexRange, Name, Sum, children, rebuild
from nsode.inclusion.families import Axes, Elements, Runs, elements
from nsode.inclusion.sharing import ONE, Numbering

#: How a value compares with zero.
Goal = Literal[">=", ">", "<=", "<"]

OPPOSITE: dict[Goal, Goal] = {">=": "<=", ">": "<", "<=": ">=", "<": ">"}
#: What a sign implies, itself included.
WEAKER: dict[Goal, tuple[Goal, ...]] = {
    ">=": (">=",),
    ">": (">", ">="),
    "<=": ("<=",),
    "<": ("<", "<="),
}
_SCALAR: Elements = (0, 0)
#: What the index of a family is called, whatever the text calls it.
_ANY = "#"


class _Place(NamedTuple):
    """A value up to where it stands in its family, and the elements where it does."""

    scale: float
    id: int
    elements: Elements


@dataclass(slots=True)
class Facts:
    """What is known of values by their numbers, however they are written."""

    numbering: Numbering
    _known: dict[tuple[int, Goal], Runs] = field(default_factory=dict)

    def add(self, expr: Expr, goal: Goal, over: Axes) -> None:
        """Take ``expr goal 0`` for granted at every index."""
        place = self._place(expr, over)
        if place is not None and place.scale and place.id != ONE:
            for weaker in WEAKER[goal if place.scale > 0 else OPPOSITE[goal]]:
                self._known.setdefault((place.id, weaker), Runs()).add(place.elements)

    def tell(self, expr: Expr, goal: Goal, over: Axes) -> bool:
        """Tell whether ``expr goal 0`` was taken for granted at every index."""
        place = self._place(expr, over) if self._known else None
        if place is None or not place.scale:
            return False
        known = self._known.get((place.id, goal if place.scale > 0 else OPPOSITE[goal]))
        return known is not None and known.holds(place.elements)

    def _place(self, expr: Expr, over: Axes) -> _Place | None:
        """Return where a value stands; None where it has several indices.

        ``x[i + 2]`` for i in 1..3 is the family ``x[#]`` at 3..5, ``x[7]`` the same at 7.
        """
        read = list(indices(expr))
        if not read:
            return _Place(*self.numbering.number(expr, {}), _SCALAR)
        if all(index.variable is None for index in read):
            expr, over = _lifted(expr), (IndexRange(_ANY, 0, 0),)
            read = list(indices(expr))
        moving = [index for index in read if index.variable is not None]
        least = min(moving, key=lambda index: index.offset)
        if any(index.variable != least.variable for index in moving) or least.variable is None:
            return None
        number = self.numbering.number(expr, {least.variable: (_ANY, -least.offset)})
        return _Place(*number, elements(least, over))


def indices(expr: Expr) -> Iterator[Index]:
    """Yield every index in an expression but those of its own sums."""
    match expr:
        case Index():
            yield expr
        case Name(at=Index() as at):
            yield at
        case Sum(over, body):
            yield from (index for index in indices(body) if index.variable != over.variable)
        case _:
            for child in children(expr):
                yield from indices(child)


def _lifted(expr: Expr) -> Expr:
    """Return an expression with an index in the place of constant subscripts."""
    match expr:
        case Index(None, offset):
            return Index(_ANY, offset)
        case Name(id, Index(None, offset)):
            return Name(id, Index(_ANY, offset))
    return rebuild(expr, _lifted)
