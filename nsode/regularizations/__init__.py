"""Published approximations of dio and sgn. One file for each."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Literal, NamedTuple, Protocol

from nsode.expr import Expr
from nsode.ode import AuxiliaryState, Binding, SetValuedTerm

Kind = Literal["dio", "sgn"]


class Entry(NamedTuple):
    """What is known of a law before it is imported: what it approximates, and how.

    ``reads_velocity`` where the force of a contact depends on psi', ``pulls`` where it may
    be negative.
    """

    kinds: tuple[Kind, ...]
    reads_velocity: bool = False
    pulls: bool = False


#: Every law: ``name`` is the module ``nsode.regularizations.name``, imported when used.
LAWS: dict[str, Entry] = {
    "xiong2013": Entry(("dio", "sgn")),
    "kelvin_voigt": Entry(("dio",), reads_velocity=True, pulls=True),
    "clipped_kelvin_voigt": Entry(("dio",), reads_velocity=True),
    "hunt_crossley": Entry(("dio",), reads_velocity=True),
    "lugre": Entry(("sgn",)),
    "smoothing": Entry(("sgn",)),
}


class Condition(NamedTuple):
    """What a constant must satisfy, against a number or another constant of its term.

    ``why`` says what goes wrong otherwise.
    """

    relation: Literal[">", ">=", "<="]
    bound: float | str
    why: str


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of a law.

    Attributes
    ----------
    name : str
        ``K`` stands for the parameter ``N.K`` of a term N.
    conditions : tuple of Condition
        What its value must satisfy.
    default : Expr, optional
        Its value where none is given, if that is made of parameters alone.
    equal : Expr, optional
        The same quantity from the constants of another law, when a model changes its law.
    shared : bool
        Whether constants of this name in other laws are the same quantity.
    """

    name: str
    conditions: tuple[Condition, ...]
    default: Expr | None = None
    equal: Expr | None = None
    shared: bool = True


@dataclass(frozen=True, slots=True)
class Replacement:
    """What takes the place of a set-valued term: bindings now, states appended later."""

    bindings: tuple[Binding, ...]
    states: tuple[AuxiliaryState, ...] = ()


class Law(Protocol):
    """An approximation of set-valued terms, as a module."""

    def constants(self, term: SetValuedTerm) -> tuple[Constant, ...]:
        """Return the constants that a term needs, in the order of p."""
        ...

    def replace(self, term: SetValuedTerm, text: str, velocity: Expr | None) -> Replacement:
        """Return what takes the place of a term.

        ``text`` is how it was written; ``velocity`` is psi', for a law that reads it.
        """
        ...


def law(name: str) -> Law:
    """Return the law of a name.

    Raises
    ------
    KeyError
        If there is none.
    """
    if name not in LAWS:
        raise KeyError(name)
    module: Law = import_module(f"nsode.regularizations.{name}")
    return module


def laws_of(kind: str) -> tuple[str, ...]:
    """Return the names of the laws that approximate ``dio`` or ``sgn``."""
    return tuple(name for name, entry in LAWS.items() if kind in entry.kinds)
