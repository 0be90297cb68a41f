"""The units that a model declares: of its names, its settings and its run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple, TypeVar

from nsode.diagnostics import Diagnostic, ModelError
from nsode.dimension import Dimension
from nsode.inclusion.units.inference import head
from nsode.inclusion.units.quantity import Quantity
from nsode.inclusion.units.reading import measure
from nsode.ode import (
    Binding,
    Definition,
    DifferentialInclusion,
    Input,
    Output,
    Parameter,
    SetValuedTerm,
    State,
)
from nsode.source import Span
from nsode.syntax import ast

_Item = TypeVar("_Item", State, Input, Parameter, Output)


class DeclaredUnit(NamedTuple):
    """A unit as written, and what it makes known; a coherent one converts nothing."""

    written: ast.Unit
    quantity: Quantity
    coherent: bool

    @property
    def in_si(self) -> str:
        """The unit that values have once they are converted."""
        return self.written.text if self.coherent else str(self.quantity.dimension)


@dataclass(slots=True)
class Declared:
    """Every unit of a model.

    ``settings`` are those of each ``approximate``, by its place; ``elements`` the dimensions
    of the multiplier and the argument of each set-valued term.
    """

    names: dict[str, DeclaredUnit] = field(default_factory=dict)
    elements: dict[str, tuple[Dimension | None, Dimension | None]] = field(default_factory=dict)
    settings: dict[Span, Mapping[str, ast.Setting]] = field(default_factory=dict)
    run: list[ast.Setting] = field(default_factory=list)
    unknown: list[Diagnostic] = field(default_factory=list)

    def of(self, name: str) -> DeclaredUnit | None:
        """Return the unit of a name or of one of its components."""
        return self.names.get(head(name))

    def measured(self, unit: ast.Unit) -> DeclaredUnit | None:
        """Return a unit with its measure, None (and an error kept) for an unknown one."""
        try:
            scale, dimension = measure(unit)
        except ModelError as error:
            self.unknown.extend(error.diagnostics)
            return None
        return DeclaredUnit(unit, Quantity(dimension, text=unit.text), scale == 1)


def declared_units(model: ast.Model) -> Declared:
    """Collect the units of a model."""
    found = Declared()
    for statement in model.statements:
        match statement:
            case ast.ApproximateStatement(settings=settings):
                found.settings[statement.span] = {s.name.text: s for s in settings}
            case ast.SimulateStatement(settings):
                found.run.extend(settings)
            case (
                ast.ParameterDeclaration(declarator=declarator, unit=ast.Unit() as unit)
                | ast.InputDeclaration(declarator=declarator, unit=ast.Unit() as unit)
                | ast.StateDeclaration(declarator=declarator, unit=ast.Unit() as unit)
                | ast.LetDeclaration(declarator=declarator, unit=ast.Unit() as unit)
                | ast.ForceDeclaration(declarator=declarator, unit=ast.Unit() as unit)
                | ast.OutputDeclaration(declarator=declarator, unit=ast.Unit() as unit)
            ):
                known = found.measured(unit)
                if known is not None:
                    found.names[declarator.name.text] = known
    return found


def any_unit(model: ast.Model) -> bool:
    """Tell whether a model names a unit at all."""
    return any(True for _ in _units(model))


def _units(model: ast.Model) -> Iterator[ast.Unit]:
    for statement in model.statements:
        unit = getattr(statement, "unit", None)
        if unit is not None:
            yield unit
        for setting in getattr(statement, "settings", ()):
            if setting.unit is not None:
                yield setting.unit


def stated_in_si(inclusion: DifferentialInclusion, declared: Declared) -> DifferentialInclusion:
    """Return the inclusion with the unit of each item in which its values stand."""

    def stated(item: _Item) -> _Item:
        unit = declared.of(item.name)
        if unit is None or unit.in_si == item.unit:
            return item
        return replace(item, unit=unit.in_si)

    def definition(item: Definition) -> Definition:
        if isinstance(item, SetValuedTerm):
            return replace(item, dimensions=declared.elements[item.name])
        if not isinstance(item, Binding) or item.role not in ("let", "force"):
            return item
        unit = declared.of(item.name)
        return item if unit is None or unit.in_si == item.unit else replace(item, unit=unit.in_si)

    return replace(
        inclusion,
        states=tuple(map(stated, inclusion.states)),
        inputs=tuple(map(stated, inclusion.inputs)),
        parameters=tuple(map(stated, inclusion.parameters)),
        bindings=tuple(map(definition, inclusion.bindings)),
        outputs=tuple(map(stated, inclusion.outputs)),
    )
