"""What an analysis found, as plain data, as JSON, and as something to look at."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from html import escape
from math import isfinite

from nsode.analysis.elements import Contact, Friction
from nsode.analysis.mass import EffectiveMass
from nsode.analysis.report import Table, lines, tables
from nsode.analysis.steps import StableStep
from nsode.diagnostics import Diagnostic

SCHEMA_VERSION = 1


@dataclass(frozen=True, slots=True)
class Unstable:
    """A mode that grows by itself, and the active set in which it does."""

    eigenvalue: complex
    modes: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Analysis:
    """What is known of a model before it runs.

    Attributes
    ----------
    mass : EffectiveMass
        W at the start.
    steps : tuple of StableStep
        The largest stable step of each method; empty where it is not known.
    unknown : str, optional
        Why it is not known.
    along : int
        How many states besides the start were looked at.
    sets : int, optional
        How many active sets were looked at; None where they are too many to list.
    own_modes : tuple of complex
        The model's own modes in those sets, in 1/s.
    growing : Unstable, optional
        The added mode that grows fastest whatever the step: friction can feed contacts
        that press at the same time.
    contacts, frictions : tuples
        Each element on its own.
    passive : bool
        Whether no element of the paper's law can create energy: alpha <= beta, and W is
        symmetric.
    unread : tuple of str
        States on which no force and no output depends.
    coinciding : tuple of pairs of str
        Elements that act at one and the same place.
    idle : tuple of str
        Elements that never act along the states that were given.
    diagnostics : tuple of Diagnostic
        Warnings.
    """

    name: str
    mass: EffectiveMass
    steps: tuple[StableStep, ...]
    unknown: str | None
    along: int
    sets: int | None
    own_modes: tuple[complex, ...]
    growing: Unstable | None
    contacts: tuple[Contact, ...]
    frictions: tuple[Friction, ...]
    passive: bool
    unread: tuple[str, ...]
    coinciding: tuple[tuple[str, str], ...]
    idle: tuple[str, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def stable_step(self) -> dict[str, float]:
        """The largest stable step of each method, in seconds."""
        return {step.method: step.step for step in self.steps}

    def as_json(self) -> dict[str, object]:
        """Return the analysis as plain data; what is not a finite number is null."""
        found = {
            "schema_version": SCHEMA_VERSION,
            "model": self.name,
            "stable_step": self.stable_step,
            "limits": [_limit(step) for step in self.steps],
            "unknown": self.unknown,
            "at": "the start" if not self.along else f"the start and {self.along} states",
            "active_sets": self.sets,
            "own_modes": [_complex(mode) for mode in self.own_modes],
            "growing": None if self.growing is None else _unstable(self.growing),
            "effective_mass": asdict(self.mass)
            | {"asymmetric": [list(pair) for pair in self.mass.asymmetric()]},
            "contacts": [asdict(contact) for contact in self.contacts],
            "frictions": [
                asdict(item) | {"may_resonate": item.may_resonate} for item in self.frictions
            ],
            "passive": self.passive,
            "unread_states": list(self.unread),
            "coinciding": [list(pair) for pair in self.coinciding],
            "idle": list(self.idle),
            "warnings": [{"code": d.code, "message": d.message} for d in self.diagnostics],
        }
        plain = _plain(found)
        assert isinstance(plain, dict)
        return plain

    def tables(self) -> list[Table]:
        """Return the parts of the report."""
        return tables(self)

    def __str__(self) -> str:
        return "\n".join(lines(self.tables(), self.name))

    def _repr_html_(self) -> str:
        return f"<h4>{escape(self.name)}</h4>" + "".join(t.html() for t in self.tables())

    def _repr_mimebundle_(self, **_: object) -> dict[str, object]:
        return {"text/plain": str(self), "text/html": self._repr_html_()}


def _limit(step: StableStep) -> dict[str, object]:
    return {
        "method": step.method,
        "step": step.step,
        "proven": step.proven,
        "found": step.found,
        "eigenvalue": _complex(step.eigenvalue),
        "frequency": step.frequency,
        "damping": step.damping,
        "modes": dict(step.modes),
        "own_step": step.own,
        "change": dict(step.change),
    }


def _unstable(growing: Unstable) -> dict[str, object]:
    return {"eigenvalue": _complex(growing.eigenvalue), "modes": dict(growing.modes)}


def _complex(value: complex) -> list[float]:
    return [value.real, value.imag]


def _plain(value: object) -> object:
    match value:
        case dict():
            return {str(key): _plain(inner) for key, inner in value.items()}
        case list() | tuple():
            return [_plain(inner) for inner in value]
        case float():
            return value if isfinite(value) else None
        case _:
            return value
