"""Where the elements of families stand."""

from __future__ import annotations

from nsode.expr import TIME, IndexRange
from nsode.ode import AugmentedODE, Placed, defined


def ranges(ode: AugmentedODE) -> dict[str, IndexRange | None]:
    """Return the whole range of each name, which the bindings may define in pieces."""
    placed: list[Placed] = [*ode.parameters, *ode.inputs, *ode.states]
    found: dict[str, IndexRange | None] = {TIME: None, **{i.name: i.range for i in placed}}
    for item in ode.bindings:
        for name in defined(item):
            found[name] = _cover(found.get(name), item.range)
    return found


def _cover(one: IndexRange | None, other: IndexRange | None) -> IndexRange | None:
    if one is None or other is None:
        return other
    return IndexRange(one.variable, min(one.first, other.first), max(one.last, other.last))
