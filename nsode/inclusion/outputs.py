"""Outputs: what a model asks for, and every force."""

from __future__ import annotations

from collections.abc import Iterator

from nsode.expr import Index, Name
from nsode.inclusion.definitions import Definitions
from nsode.inclusion.elaborate import elaborate
from nsode.inclusion.fitting import declared_shape, fitted
from nsode.inclusion.indices import index_range
from nsode.inclusion.kinds import number
from nsode.inclusion.review import Review
from nsode.inclusion.symbols import Scope
from nsode.inclusion.units import in_si
from nsode.inclusion.values import each, scalars, shape, suffixes
from nsode.ode import Output
from nsode.syntax.ast import OutputDeclaration


def output(declaration: OutputDeclaration, scope: Scope, review: Review) -> list[Output]:
    """``output depth = max(0, R - p.z) {m}``: one output for each component.

    Raises
    ------
    ModelError
        If its value has no shape or not the one declared.
    """
    declarator, unit = declaration.declarator, declaration.unit
    over = index_range(declarator.range, scope)
    value = each(number, elaborate(declaration.value, scope.with_index(over)))
    value = fitted(value, over, declared_shape(declarator, scope), declarator)
    review.check(value)
    name, written = declarator.name, None if unit is None else unit.text
    return [
        Output(name.text + suffix, in_si(part, unit), over, written, span=name.span)
        for suffix, part in zip(suffixes(shape(value)), scalars(value), strict=True)
    ]


def force_outputs(definitions: Definitions) -> Iterator[Output]:
    """Yield every force as an output, to stand behind the declared ones."""
    for force in definitions.forces:
        symbol = definitions.symbols.known[force]
        at = None if symbol.range is None else Index(symbol.range.variable)
        for suffix in suffixes(symbol.shape):
            value = Name(force + suffix, at, span=symbol.span)
            yield Output(value.id, value, symbol.range, symbol.unit, span=symbol.span)
