"""Models on the command line: read, compiled, and summed up on one line."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from nsode.cli.failure import io_diagnostic
from nsode.diagnostics import ModelError
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.ode import Binding, SetValuedTerm, size
from nsode.source import Source
from nsode.syntax.reading import decode, read

if TYPE_CHECKING:
    from nsode.compiler import Model


STANDARD_INPUT = "-"
_SHOWN = 6


def source_of(argument: str, limits: Limits = DEFAULT_LIMITS) -> Source:
    """Read the model that an argument names.

    Raises
    ------
    ModelError
        If it cannot be read.
    """
    if argument != STANDARD_INPUT:
        return read(argument, limits)
    try:
        content = sys.stdin.buffer.read(limits.size + 1)
    except OSError as error:
        raise ModelError([io_diagnostic("NS601", error)]) from error
    return decode("<stdin>", content, limits)


def load(argument: str, limits: Limits = DEFAULT_LIMITS) -> Model:
    """Load the model that an argument names.

    Raises
    ------
    ModelError
        If it cannot be read or is refused.
    """
    from nsode import compiler

    return compiler.compile_source(source_of(argument, limits), limits)


def summary(model: Model) -> str:
    """Return how large the augmented ODE of a model is, on one line."""
    ode = model.ode
    kept = {item.name for item in ode.bindings if isinstance(item, Binding)}
    terms = tuple(term for term in model.inclusion.terms if not kept.isdisjoint(term.multiplier))
    added = sum(map(size, ode.auxiliary))
    own = sum(map(size, ode.states)) - added
    auxiliary = f" + {added:,} auxiliary" if added else ""
    return f"{_count(own, 'state')}{auxiliary}, {_terms(terms)}"


def _terms(terms: tuple[SetValuedTerm, ...]) -> str:
    count = sum(map(size, terms))
    if not count:
        return "no set-valued term"
    shown = ", ".join(f"{_family(term)}: {term.kind}" for term in terms[:_SHOWN])
    more = ", ..." if len(terms) > _SHOWN else ""
    return f"{_count(count, 'set-valued term')} ({shown}{more})"


def _family(term: SetValuedTerm) -> str:
    if term.range is None:
        return term.name
    return f"{term.name}[{term.range.first}..{term.range.last}]"


def _count(number: int, thing: str) -> str:
    return f"{number:,} {thing}" + ("" if number == 1 else "s")
