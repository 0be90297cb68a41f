"""The constants of the laws become parameters of the ODE, so that they can be swept."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from nsode.diagnostics import Diagnostic, Label, ModelError, quoted, suggest
from nsode.expr import Expr, names
from nsode.inclusion.elaborate import CONSTANTS
from nsode.inclusion.units.laws import unit_in
from nsode.ode import DifferentialInclusion, Parameter, SetValuedTerm
from nsode.rewrite.choices import misfits, needed
from nsode.rewrite.conditions import broken
from nsode.rewrite.fixed import Fixed
from nsode.rewrite.formulas import Formulas, in_parameters, values
from nsode.source import NOWHERE


def by_kind(inclusion: DifferentialInclusion) -> list[SetValuedTerm]:
    """Return the terms in the order of their auxiliary states: first dio, then sgn."""
    return sorted(inclusion.terms, key=lambda term: term.kind)


def constants(inclusion: DifferentialInclusion) -> tuple[Parameter, ...]:
    """Return the constants of every term as parameters, NaN where the model gives none.

    Raises
    ------
    ModelError
        NS101 for a constant that is read and not there, NS303 for an unknown setting,
        NS306 for an unknown law, NS301 and NS302 for values that the law cannot use, NS308
        for targets.
    """
    terms, fixed = by_kind(inclusion), Fixed.of(inclusion)
    _refuse([problem for term in terms for problem in misfits(term)], inclusion)
    written = _written(terms, fixed)
    _refuse(list(_unknown(inclusion, written)), inclusion)
    formulas = in_parameters(written, fixed)
    found = values(formulas, inclusion.parameters)
    _refuse(list(broken(terms, found, formulas)), inclusion)
    return tuple(
        _parameter(term, name, formulas[name], found[name])
        for term in terms
        for name in (f"{term.name}.{constant.name}" for constant in needed(term))
    )


def _refuse(problems: Sequence[Diagnostic], inclusion: DifferentialInclusion) -> None:
    if problems:
        raise ModelError(dict.fromkeys(problems), inclusion.source)


def _written(terms: Sequence[SetValuedTerm], fixed: Fixed) -> Formulas:
    """Return what the model says that each constant is, or else its law."""
    found: dict[str, Expr | None] = {}
    for term in terms:
        given = dict(term.approximation.constants)
        for constant in needed(term):
            default = fixed.formula(constant.default)
            found[f"{term.name}.{constant.name}"] = given.get(constant.name, default)
    return found


def _parameter(term: SetValuedTerm, name: str, formula: Expr | None, value: float) -> Parameter:
    read = formula if formula is not None and any(True for _ in names(formula)) else None
    span = term.span if formula is None or formula.span == NOWHERE else formula.span
    unit = unit_in(term, name.removeprefix(f"{term.name}."))
    return Parameter(name, (value,), None, unit, read, term.name, span=span)


def _unknown(
    inclusion: DifferentialInclusion, formulas: Mapping[str, Expr | None]
) -> Iterator[Diagnostic]:
    """Yield an error for each constant that is read and that no law of the model has."""
    owners = {term.name for term in inclusion.terms}
    given = (formula for formula in formulas.values() if formula is not None)
    reading = (*given, *(state.initial for state in inclusion.states))
    for name in (name for expr in reading for name in names(expr)):
        owner, _, constant = name.id.rpartition(".")
        if owner in owners and constant in CONSTANTS and name.id not in formulas:
            listed = quoted(formulas)
            yield Diagnostic(
                "NS101",
                f"there is no constant `{name.id}`",
                (Label(name.span, "read here"),),
                notes=(f"the constants of the laws in this model are {listed}",),
                help=suggest(name.id, formulas),
            )
