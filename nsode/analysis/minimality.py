"""What a scene could do without: states that nothing reads, elements that coincide."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from nsode.analysis.local import Element, Local
from nsode.analysis.scene import Scene
from nsode.ode import AugmentedODE, element_names
from nsode.passes.prune import prune

_EQUAL = 1e-12


def unread_states(ode: AugmentedODE) -> tuple[str, ...]:
    """Return the states on which no force and no other output depends."""
    kept = prune(ode, [output.name for output in ode.outputs])
    left = {state.name for state in kept.states}
    return tuple(element_names(state for state in ode.states if state.name not in left))


def coinciding(scene: Scene, local: Local) -> tuple[tuple[str, str], ...]:
    """Return the pairs of elements whose arguments are multiples of each other.

    Only arguments that are affine in the state can be told.
    """
    if scene.moves(scene.of_arguments):
        return ()
    return tuple(_pairs(scene, local))


def _pairs(scene: Scene, local: Local) -> Iterator[tuple[str, str]]:
    rows = np.hstack([local.slope, local.argument[:, None]])
    for a, b in combinations(scene.elements, 2):
        if a.term.kind == b.term.kind and len(a.rows) == len(b.rows) and _multiple(rows, a, b):
            yield a.name, b.name


def _multiple(rows: np.ndarray, a: Element, b: Element) -> bool:
    first, second = rows[list(a.rows)].ravel(), rows[list(b.rows)].ravel()
    length = float(first @ first)
    if length == 0:
        return False
    factor = float(first @ second) / length
    close = np.allclose(second, factor * first, rtol=0, atol=_EQUAL * float(np.abs(second).max()))
    return close and (factor > 0 or (not a.is_contact and factor != 0))
