"""The constants of each element, elements with equal constants together."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from nsode.explain import Explanation


class Constant(NamedTuple):
    """What a constant is called, as ``K``, its value (NaN where none is given), and its unit."""

    name: str
    value: float
    unit: str


def constants(explanation: Explanation) -> dict[tuple[Constant, ...], list[str]]:
    """Return the elements by the constants that they have."""
    groups: dict[tuple[Constant, ...], list[str]] = {}
    for step in explanation.steps:
        own = [p for p in explanation.ode.parameters if p.constant_of == step.term.name]
        found = tuple(Constant(_short(p.name), p.values[0], _shown(p.unit)) for p in own)
        if found:
            groups.setdefault(found, []).append(step.term.name)
    return groups


def _short(name: str) -> str:
    return name.rpartition(".")[2]


def _shown(unit: str | None) -> str:
    return unit if unit is not None and unit != "1" else ""
