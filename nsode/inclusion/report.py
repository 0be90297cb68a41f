"""Collecting what is wrong, so that one run tells all of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from nsode.diagnostics import Diagnostic, ModelError
from nsode.source import Source


class PoisonedError(Exception):
    """Something reads a name whose own declaration was refused; said once is enough."""


@dataclass(slots=True)
class Report:
    """Diagnostics of one model, in the order found."""

    source: Source
    found: list[Diagnostic] = field(default_factory=list)

    def add(self, diagnostic: Diagnostic) -> None:
        """Keep one diagnostic."""
        self.found.append(diagnostic)

    @contextmanager
    def collecting(self) -> Iterator[None]:
        """Keep what is refused inside, and go on behind it."""
        try:
            yield
        except ModelError as error:
            self.found.extend(error.diagnostics)
        except PoisonedError:
            pass

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
            raise ModelError(self.ordered(), self.source)
