"""The units of what approximates an element, from those of the element."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from nsode.dimension import ONE, SECOND, Dimension, power, product, quotient
from nsode.ode import SetValuedTerm


class _Powers(NamedTuple):
    """A unit as a product of powers: of the multiplier, of the gap or velocity, of time."""

    force: int = 0
    argument: int = 0
    time: int = 0


_Table = Mapping[str, Mapping[str, _Powers]]

_TARGETS: _Table = {
    "dio": {
        "restitution": _Powers(),
        "impact_speed": _Powers(argument=1, time=-1),
        "penetration": _Powers(argument=1),
        "effective_mass": _Powers(force=1, argument=-1, time=2),
    },
    "sgn": {
        "presliding": _Powers(argument=1, time=1),
        "damping_ratio": _Powers(),
        "effective_mass": _Powers(force=1, argument=-1, time=1),
    },
}
_TIME = _Powers(time=1)
_GAP = _Powers(argument=1)
_SLIDING = _Powers(argument=1, time=1)
_SPRING = _Powers(force=1, argument=-1)
_DAMPER = _Powers(force=1, argument=-1, time=1)
_BRISTLE = _Powers(force=1, argument=-1, time=-1)
_FRICTION = _Powers(force=1, argument=-1)
_KELVIN_VOIGT = {"dio": {"K": _SPRING, "B": _DAMPER}}
#: What the constants and the states of each law measure; any other, such as Hunt and Crossley's K,
#: whose unit depends on n, is not checked.
_CONSTANTS: Mapping[str, _Table] = {
    "xiong2013": {
        "dio": {"K": _SPRING, "alpha": _TIME, "beta": _TIME, "e": _GAP},
        "sgn": {"K": _BRISTLE, "beta": _TIME, "a": _SLIDING},
    },
    "kelvin_voigt": _KELVIN_VOIGT,
    "clipped_kelvin_voigt": _KELVIN_VOIGT,
    "hunt_crossley": {"dio": {"c": _Powers(argument=-1, time=1), "n": _Powers()}},
    "lugre": {
        "sgn": {
            "K": _BRISTLE,
            "B": _FRICTION,
            "D": _FRICTION,
            "F0": _Powers(force=1),
            "a": _SLIDING,
        },
    },
    "smoothing": {"sgn": {"epsilon": _Powers(argument=1)}},
}


def constant(
    term: SetValuedTerm, name: str, force: Dimension | None, argument: Dimension | None
) -> Dimension | None:
    """Return the dimension of a constant, None where nothing tells."""
    powers = _powers(term, name)
    return None if powers is None else _combined(powers, force, argument)


def unit_in(term: SetValuedTerm, name: str) -> str | None:
    """Return the unit in SI of a constant or state of a term, None where nothing tells."""
    found = constant(term, name, *term.dimensions)
    return None if found is None else str(found)


@cache
def _combined(
    powers: _Powers, force: Dimension | None, argument: Dimension | None
) -> Dimension | None:
    found = power(SECOND, Fraction(powers.time))
    for of, exponent in ((force, powers.force), (argument, powers.argument)):
        if exponent and of is None:
            return None
        if exponent and of is not None:
            found = product(found, power(of, Fraction(exponent)))
    return found


def force(term: SetValuedTerm, stiffness: Dimension, argument: Dimension) -> Dimension | None:
    """Return the dimension of the multiplier of a term with this K, None where nothing tells."""
    for_unit_force = constant(term, "K", ONE, argument)
    if for_unit_force is None:
        return None
    return quotient(stiffness, for_unit_force)


def follows_from_units(term: SetValuedTerm, name: str) -> bool:
    """Tell whether the unit of a constant depends on those of its element."""
    powers = _powers(term, name)
    return powers is not None and (powers.force, powers.argument) != (0, 0)


def _powers(term: SetValuedTerm, name: str) -> _Powers | None:
    constants = _CONSTANTS.get(term.approximation.law, {}).get(term.kind, {})
    return constants.get(name) or _TARGETS[term.kind].get(name)
