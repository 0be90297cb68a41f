"""A differential inclusion at one point, as numbers: its elements and its linear model there."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from nsode.analysis.point import Matrix, Vector
from nsode.ode import SetValuedTerm

#: The law whose active sets, bounces and stick the analysis knows.
LAW = "xiong2013"
#: Products of a few numbers below it are finite.
ENDLESS = 1e60


@dataclass(frozen=True, slots=True)
class Constants:
    """The constants of one element; alpha NaN for sgn.

    All are NaN where the model gives none, or where the element has another law.
    """

    stiffness: float
    alpha: float
    beta: float

    @property
    def known(self) -> bool:
        """Whether all constants are given, positive, and of use in products of a few."""
        values = (
            (self.stiffness, self.beta)
            if np.isnan(self.alpha)
            else (self.stiffness, self.alpha, self.beta)
        )
        return all(1 / ENDLESS < v < ENDLESS for v in values)


@dataclass(frozen=True, slots=True)
class Element:
    """One set-valued term, or one element of a family of them.

    ``rows`` are the places of its components among the multipliers.
    """

    name: str
    term: SetValuedTerm
    rows: tuple[int, ...]
    number: int

    @property
    def is_contact(self) -> bool:
        """Whether this is a dio term."""
        return self.term.kind == "dio"


@dataclass(frozen=True, slots=True)
class Local:
    """The linear model at a point: x in n places, multipliers in m, elements in k.

    Attributes
    ----------
    rates : (n,) array
        x' without any multiplier.
    state, force : (n, n) and (n, m) arrays
        d(x')/dx and d(x')/d(lambda).
    argument, velocity : (m,) arrays
        The gaps and sliding velocities; psi' for dio and again theta for sgn.
    slope : (m, n) array
        d(argument)/dx.
    motion, lift : (m, n) and (m, m) arrays
        d(y)/dx and d(y)/d(lambda), where y is psi' for dio and theta for sgn.
    idle_factor : (k,) array
        chi without any multiplier; 0 for dio.
    factor, factor_state, factor_force : (k,), (k, n) and (k, m) arrays
        chi and its derivatives; 0 for dio.
    """

    rates: Vector
    state: Matrix
    force: Matrix
    argument: Vector
    velocity: Vector
    slope: Matrix
    motion: Matrix
    lift: Matrix
    idle_factor: Vector
    factor: Vector
    factor_state: Matrix
    factor_force: Matrix

    @property
    def is_finite(self) -> bool:
        """Whether every number is finite; a singular mass matrix has none that are."""
        return self._below(np.inf)

    @property
    def is_moderate(self) -> bool:
        """Whether products of a few numbers are finite."""
        return self._below(ENDLESS)

    def _below(self, limit: float) -> bool:
        return all((np.abs(getattr(self, f.name)) < limit).all() for f in fields(self))
