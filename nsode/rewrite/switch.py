"""Other laws for the same model, with what they can take over from the constants it has.

A constant keeps its value where the other law has one of the same name and meaning (K);
another may be the same quantity in other terms (B = K*beta). Every other constant takes
the default of its law, or has no value until somebody gives it one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import isnan

from nsode.diagnostics import Diagnostic, ModelError, quoted, refuse, suggest
from nsode.expr import Expr, Name, Number, names, rebuild
from nsode.ode import (
    Approximation,
    Definition,
    DifferentialInclusion,
    Parameter,
    SetValuedTerm,
    State,
)
from nsode.regularizations import Constant, Kind, law, laws_of


def with_laws(
    inclusion: DifferentialInclusion, parameters: Iterable[Parameter], laws: Mapping[Kind, str]
) -> DifferentialInclusion:
    """Return the inclusion with another law for every term of some kinds.

    Parameters
    ----------
    inclusion : DifferentialInclusion
        The model as it is.
    parameters : iterable of Parameter
        Those of its augmented ODE, with the constants that count now.
    laws : mapping
        The name of a law for ``dio``, for ``sgn``, or for both.

    Raises
    ------
    ModelError
        NS306 for a name that is no law of its kind, or where something else reads a
        constant that the other law does not have.
    """
    for kind, name in laws.items():
        _check(kind, name)
    switch = _Switch.of(inclusion, parameters, laws)
    return replace(
        inclusion,
        bindings=tuple(switch.definition(item) for item in inclusion.bindings),
        states=tuple(switch.state(item) for item in inclusion.states),
    )


def _check(kind: Kind, name: str) -> None:
    able = laws_of(kind)
    if name not in able:
        listed = quoted(able)
        message = f"`{name}` is no law for `{kind}`"
        hint = suggest(name, able) or f"the laws for `{kind}` are {listed}"
        raise ModelError([Diagnostic("NS306", message, help=hint)])


@dataclass(frozen=True, slots=True)
class _Switch:
    """The constants that have a value, and those that are about to go."""

    laws: Mapping[Kind, str]
    known: Mapping[str, Expr]
    gone: frozenset[str]

    @classmethod
    def of(
        cls,
        inclusion: DifferentialInclusion,
        parameters: Iterable[Parameter],
        laws: Mapping[Kind, str],
    ) -> _Switch:
        constants = [p for p in parameters if p.constant_of is not None]
        known = {
            p.name: Number(p.values[0], span=p.span) if p.formula is None else p.formula
            for p in constants
            if p.formula is not None or not isnan(p.values[0])
        }
        kept = {
            f"{term.name}.{constant.name}"
            for term in inclusion.terms
            for constant in law(laws.get(term.kind, term.approximation.law)).constants(term)
        }
        return cls(laws, known, frozenset(p.name for p in constants).difference(kept))

    def definition(self, item: Definition) -> Definition:
        if not isinstance(item, SetValuedTerm):
            return item
        return replace(item, approximation=self._approximation(item))

    def state(self, state: State) -> State:
        return replace(state, initial=self._without(self.gone, state.initial))

    def _approximation(self, term: SetValuedTerm) -> Approximation:
        old = term.approximation
        name = self.laws.get(term.kind, old.law)
        before = {constant.name: constant for constant in law(old.law).constants(term)}
        values = (
            (constant.name, self._value(term, constant, before.get(constant.name), name != old.law))
            for constant in law(name).constants(term)
        )
        return replace(
            old,
            law=name,
            constants=tuple((name, value) for name, value in values if value is not None),
            targets=(),
            span=old.span if name == old.law else term.span,
        )

    def _value(
        self, term: SetValuedTerm, constant: Constant, before: Constant | None, other: bool
    ) -> Expr | None:
        """Return what a constant takes over, None where nothing tells."""
        name = f"{term.name}.{constant.name}"
        same = before is not None and (not other or (before.shared and constant.shared))
        if same and name in self.known:
            return self._without(self.gone, self.known[name])
        equal = constant.equal
        if not other or equal is None or any(n.id not in self.known for n in names(equal)):
            return None
        return self._without(self.gone | {name}, equal)

    def _without(self, gone: frozenset[str], expr: Expr) -> Expr:
        """Return an expression that reads no constant that is gone."""
        if not isinstance(expr, Name):
            return rebuild(expr, lambda child: self._without(gone, child))
        if expr.id not in gone:
            return expr
        if expr.id in self.known:
            return self._without(self.gone, self.known[expr.id])
        raise refuse(
            "NS306",
            f"`{expr.id}` is read here, which has no value and is no constant of the other law",
            expr.span,
        )
