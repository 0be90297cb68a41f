"""Published approximations of dio and sgn. One file for each."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Protocol

from nsode.ode import AuxiliaryState, Binding, SetValuedTerm

#: Every law with its module; a law is imported when it is used.
LAWS: dict[str, str] = {"xiong2013": "nsode.regularizations.xiong2013"}


@dataclass(frozen=True, slots=True)
class Replacement:
    """What takes the place of a set-valued term: bindings now, states appended later."""

    bindings: tuple[Binding, ...]
    states: tuple[AuxiliaryState, ...]


class Law(Protocol):
    """An approximation of set-valued terms, as a module."""

    def constants(self, term: SetValuedTerm) -> tuple[str, ...]:
        """Return the names of the constants that a term needs, in the order of p."""
        ...

    def replace(self, term: SetValuedTerm, text: str) -> Replacement:
        """Return what takes the place of a term; ``text`` is how it was written."""
        ...


def law(name: str) -> Law:
    """Return the law of a name.

    Raises
    ------
    KeyError
        If there is none.
    """
    module: Law = import_module(LAWS[name])
    return module
