"""W, the effective inverse mass: what each multiplier does to each gap and each slip.

``W_ij = d(psi_i'')/d(lambda_j)`` for a dio term i and ``-d(theta_i')/d(lambda_j)`` for a sgn
term i (the Delassus matrix). It is symmetric where forces enter through the Jacobians of
psi and theta, as in mechanics they do. On a first-order state the rate psi' itself
follows the multiplier, and W is that of psi'.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nsode.analysis.local import Element, Local
from nsode.analysis.point import Matrix
from nsode.analysis.reach import nonnegative_least_squares
from nsode.analysis.scene import Scene
from nsode.diagnostics import Diagnostic, Label

_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class EffectiveMass:
    """W at the start of a run.

    Attributes
    ----------
    names : tuple of str
        The multipliers, in the order of rows and columns.
    matrix : tuple of tuples of float
        W.
    degrees : tuple of int
        Relative degree of each argument: how often it is derived in time until a
        multiplier shows; 0 where none does.
    varies : bool
        Whether W depends on the state, on time or on an input.
    formulas : tuple of tuples of str, optional
        W in symbols, for small scenes.
    """

    names: tuple[str, ...]
    matrix: tuple[tuple[float, ...], ...]
    degrees: tuple[int, ...]
    varies: bool
    formulas: tuple[tuple[str, ...], ...] | None = None

    @property
    def array(self) -> Matrix:
        """W as an array."""
        return np.array(self.matrix).reshape(len(self.names), len(self.names))

    def asymmetric(self) -> tuple[tuple[str, str], ...]:
        """Return the pairs where a force does not enter through the Jacobian of its argument."""
        w = self.array
        scale = np.abs(w).max(initial=0.0)
        pairs = np.argwhere(np.triu(np.abs(w - w.T) > 1e-9 * scale, 1))
        return tuple((self.names[i], self.names[j]) for i, j in pairs)


def effective_mass(scene: Scene, local: Local) -> EffectiveMass:
    """Return W at a point."""
    through_state = local.motion @ local.force
    w = through_state.copy()
    degrees = np.zeros(len(w), dtype=int)
    for element in scene.elements:
        rows = list(element.rows)
        if element.is_contact:
            direct = local.lift[rows].any()
            w[rows] = local.lift[rows] if direct else through_state[rows]
            degrees[rows] = 1 if direct else 2 * int(through_state[rows].any())
        else:
            w[rows] = -through_state[rows]
            degrees[rows] = int(through_state[rows].any())
    return EffectiveMass(
        tuple(component_names(scene.elements)),
        tuple(tuple(row) for row in (w + 0.0).tolist()),
        tuple(degrees.tolist()),
        scene.moves(scene.of_motions) or _force_moves(scene),
    )


def _force_moves(scene: Scene) -> bool:
    """Whether the way in which multipliers drive the states changes along a run."""
    rates = scene.of_rates
    entries = tuple(e for e in rates.entries if e.column.id in scene.multipliers)
    return scene.moves(type(rates)(rates.definitions, entries))


def component_names(elements: Sequence[Element]) -> list[str]:
    """Return the names of the multipliers, in order of their places."""
    named: dict[int, str] = {}
    for element in elements:
        for k, row in enumerate(element.rows):
            named[row] = element.name if len(element.rows) == 1 else f"{element.name}.{'xyz'[k]}"
    return [named[row] for row in sorted(named)]


def static_load(scene: Scene, local: Local, mass: EffectiveMass) -> list[float]:
    """Return the contact forces that would hold the scene at rest against its own rates."""
    rows = [row for e in scene.elements if e.is_contact for row in e.rows]
    load = [0.0] * len(mass.names)
    if rows:
        pressing = -(local.motion @ local.rates)[rows]
        w = mass.array[np.ix_(rows, rows)]
        # Scaled, as its tolerance is absolute and products of huge numbers overflow.
        of_w, of_pressing = (np.abs(part).max() or 1.0 for part in (w, pressing))
        forces = nonnegative_least_squares(w / of_w, pressing / of_pressing) * (of_pressing / of_w)
        for row, force in zip(rows, forces.tolist(), strict=True):
            load[row] = force
    return load


def feeding(scene: Scene, mass: EffectiveMass) -> list[Diagnostic]:
    """Return a warning for each term whose force drives what it should resist."""
    w = mass.array
    found: dict[str, Diagnostic] = {}
    for element in scene.elements:
        block = w[np.ix_(element.rows, element.rows)]
        least = np.linalg.eigvalsh(0.5 * (block + block.T)).min()
        if least < -_ROUNDING * np.abs(w).max():
            found.setdefault(element.term.name, _feeding(element))
    return list(found.values())


def _feeding(element: Element) -> Diagnostic:
    term = element.term
    if element.is_contact:
        message = f"`{term.name}` pulls its gap shut instead of pushing it open"
        help = "change the sign of the force where it enters the equations"
    else:
        message = f"`{term.name}` feeds energy: it drives the sliding that it should resist"
        help = "friction enters with a minus: `-chi*sgn(theta)`"
    return Diagnostic(
        "NS402", message, (Label(term.span, "this term"),), help=help, severity="warning"
    )
