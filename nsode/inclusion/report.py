"""Collecting what is wrong, so that one run tells all of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.source import NOWHERE, Source, Span
from nsode.syntax.parser import in_order

Item = TypeVar("Item")
Result = TypeVar("Result")


class PoisonedError(Exception):
    """Something reads a name whose own declaration was refused; said once is enough."""

    def __init__(self, name: str = "", span: Span = NOWHERE) -> None:
        self.name, self.span = name, span
        super().__init__(name)


class Collecting:
    """Hands what is refused inside to a report; a class, since every statement enters it."""

    __slots__ = ("report",)

    def __init__(self, report: Report) -> None:
        self.report = report

    def __enter__(self) -> None: ...

    def __exit__(self, kind: object, error: object, trace: object) -> bool:
        match error:
            case ModelError():
                self.report.found.extend(error.diagnostics)
            case PoisonedError():
                self.report.skipped.append(error)
            case _:
                return False
        return True


def each(change: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Return every item changed.

    Raises
    ------
    ModelError
        With what is wrong with any of them.
    """
    found: list[Result] = []
    problems: list[Diagnostic] = []
    for item in items:
        try:
            found.append(change(item))
        except ModelError as error:
            problems.extend(error.diagnostics)
    if problems:
        raise ModelError(problems)
    return found


@dataclass(slots=True)
class Report:
    """Diagnostics of one model, in the order found."""

    source: Source
    limits: Limits = DEFAULT_LIMITS
    found: list[Diagnostic] = field(default_factory=list)
    skipped: list[PoisonedError] = field(default_factory=list)

    def add(self, diagnostic: Diagnostic) -> None:
        """Keep one diagnostic."""
        self.found.append(diagnostic)

    def collecting(self) -> Collecting:
        """Keep what is refused inside, and go on behind it."""
        return Collecting(self)

    def each(self, change: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
        """Return every item changed, but for those that are refused."""
        found: list[Result] = []
        for item in items:
            with self.collecting():
                found.append(change(item))
        return found

    def needed(self, make: Callable[[], Result]) -> Result:
        """Return what nothing can go on without.

        Raises
        ------
        ModelError
            With everything found so far where it is refused.
        """
        with self.collecting():
            return make()
        self.raise_errors()
        raise AssertionError("what is poisoned has a cause")

    def ordered(self) -> list[Diagnostic]:
        """Return the diagnostics by place, each once."""
        unique = dict.fromkeys(self.found)
        return sorted(unique, key=lambda d: d.labels[0].span if d.labels else (0, 0))

    def raise_errors(self) -> None:
        """Refuse the model if anything so far is an error.

        Raises
        ------
        ModelError
            With everything found, warnings included.
        """
        if any(d.severity == "error" for d in self.found):
            raise ModelError(in_order(self.ordered(), self.limits), self.source)
        for error in self.skipped:  # nothing may be left out in silence
            message = f"`{error.name}` is read before its value is known"
            raise refuse("NS101", message, error.span, "read here")


#: Members of a circle that a message shows.
_SHOWN = 5


def in_a_circle(names: Sequence[str], spans: Mapping[str, Span], way_out: str) -> ModelError:
    """Return the error for definitions that need each other; ``spans`` in reading order."""
    path = [f"`{name}`" for name in names]
    if len(path) > _SHOWN:
        path[_SHOWN - 1 : -1] = ["..."]
    *places, last = spans.values()
    if not places:
        return refuse(
            "NS106", f"{path[0]} is defined by itself", last, "needs itself", help=way_out
        )
    labels = [Label(place, "needs the next") for place in places[: _SHOWN - 1]]
    labels.append(Label(last, "needs the first again"))
    return ModelError(
        [
            Diagnostic(
                "NS106",
                "these are defined by each other: " + " -> ".join([*path, path[0]]),
                tuple(labels),
                help=way_out,
            )
        ]
    )
