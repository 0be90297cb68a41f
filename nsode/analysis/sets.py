"""Active sets: which contacts press, which friction sticks, and the linear ODE inside each.

The matrices are those of the paper's approximation, (24)-(25) and (18), where ``max`` and
``sat`` have taken one branch; so they hold exactly, however far the set reaches.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, product
from math import prod

import numpy as np

from nsode.analysis.local import Constants, Element, Local
from nsode.analysis.point import Matrix, Vector
from nsode.analysis.reach import subsets

#: More sets than these are not listed; a bound takes their place.
MOST_SETS = 4096


@dataclass(frozen=True, slots=True)
class Mode:
    """What one element does: ``open``, ``contact``, ``stick``, ``slip`` or ``free``.

    ``direction`` is the unit vector of slip. Friction without a normal force is ``free``.
    """

    kind: str
    direction: tuple[float, ...] = ()

    def __str__(self) -> str:
        match self.direction:
            case ():
                return self.kind
            case (sign,):
                return f"{self.kind}{'+' if sign > 0 else '-'}"
            case direction:
                axis = next(i for i, value in enumerate(direction) if value)
                return f"{self.kind}{'+' if direction[axis] > 0 else '-'}{'xyz'[axis]}"


OPEN, CONTACT, STICK, FREE = Mode("open"), Mode("contact"), Mode("stick"), Mode("free")
ActiveSet = tuple[Mode, ...]


def slips(dimension: int) -> tuple[Mode, ...]:
    """Return the modes of slip that stand for all directions."""
    axes = np.eye(dimension)
    return tuple(
        Mode("slip", tuple((sign * axis).tolist())) for axis in axes for sign in (1.0, -1.0)
    )


@dataclass(frozen=True, slots=True)
class Family:
    """The active sets of a scene at a point: those that one state can reach."""

    elements: tuple[Element, ...]
    local: Local
    excluded: tuple[frozenset[int], ...]

    @property
    def contacts(self) -> list[Element]:
        """The dio elements."""
        return [element for element in self.elements if element.is_contact]

    def options(self, pressing: frozenset[int]) -> list[tuple[Mode, ...]]:
        """Return the modes of each element where these contacts press."""
        contacts = {e.number: k for k, e in enumerate(self.contacts)}
        loaded = np.zeros(self.local.force.shape[1])
        for element in self.contacts:
            if contacts[element.number] in pressing:
                loaded[list(element.rows)] = 1.0
        found: list[tuple[Mode, ...]] = []
        for element in self.elements:
            if element.is_contact:
                found.append((CONTACT if contacts[element.number] in pressing else OPEN,))
            elif self._is_loaded(element, loaded):
                found.append((STICK, *slips(len(element.rows))))
            else:
                found.append((FREE,))
        return found

    def _is_loaded(self, element: Element, loaded: Vector) -> bool:
        """Whether chi can be positive under these contacts."""
        k = element.number
        contacts = [row for e in self.contacts for row in e.rows]
        depends = np.abs(self.local.factor_force[k, contacts])
        return bool(depends @ loaded[contacts] > 0 or self.local.idle_factor[k] > 0)

    def __iter__(self) -> Iterator[ActiveSet]:
        for pressing in subsets(len(self.contacts), list(self.excluded)):
            yield from product(*self.options(pressing))

    def listed(self, most: int = MOST_SETS) -> list[ActiveSet] | None:
        """Return all sets, or None where there are more than ``most``."""
        if len(self.contacts) > 16:
            return None
        sets = list(islice(self, most + 1))
        return sets if len(sets) <= most else None

    def count(self) -> int:
        """Return an upper bound of how many sets there are."""
        return prod(2 if e.is_contact else 1 + 2 * len(e.rows) for e in self.elements)


def matrix(
    local: Local, elements: Sequence[Element], constants: Sequence[Constants], active: ActiveSet
) -> Matrix:
    """Return the matrix of (x, e, a) inside an active set.

    The auxiliary states stand in the places of their multipliers, behind x.
    """
    n, m = local.force.shape
    law = np.zeros((m, n + m))
    rates = np.zeros((m, n + m))
    for element, mode, given in zip(elements, active, constants, strict=True):
        for row in element.rows:
            own = np.zeros(n + m)
            own[n + row] = 1.0
            slope = np.concatenate([local.slope[row], np.zeros(m)])
            if element.is_contact:
                law[row], rates[row] = _contact(mode, given, own, slope)
            else:
                law[row] = given.stiffness * (own + given.beta * slope)
                rates[row] = slope
        if not element.is_contact and mode is not STICK:
            rows = list(element.rows)
            law[rows] = _slip(local, element, mode, law)
            drawn = law[rows] / given.stiffness
            drawn[range(len(rows)), [n + row for row in rows]] -= 1.0
            rates[rows] = drawn / given.beta
    motion = np.hstack([local.state, np.zeros((n, m))]) + local.force @ law
    return np.vstack([motion, rates])


def _contact(mode: Mode, given: Constants, own: Vector, slope: Vector) -> tuple[Vector, Vector]:
    """(25) and (24), where the contact presses or is open."""
    if mode is OPEN:
        return np.zeros_like(own), -own / given.beta
    rate = -(slope + own) / given.alpha
    return given.stiffness * (own + given.beta * rate), rate


def _slip(local: Local, element: Element, mode: Mode, law: Matrix) -> Matrix:
    """(18) beyond its limit: the force follows chi along the direction of slip.

    Across it, a force of fixed size that turns is as stiff as stick where slip begins,
    and softer beyond; the beginning is taken.
    """
    rows = list(element.rows)
    if mode is FREE:
        return np.zeros_like(law[rows])
    n = local.state.shape[0]
    k = element.number
    direction = np.array(mode.direction)
    factor = local.factor_force[k] @ law
    factor[:n] += local.factor_state[k]
    across = np.eye(len(rows)) - np.outer(direction, direction)
    slid: Matrix = np.outer(direction, factor) + across @ law[rows]
    return slid
