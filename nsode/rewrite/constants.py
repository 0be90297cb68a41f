"""The constants of the laws become parameters of the ODE, so that they can be swept."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from nsode.diagnostics import Diagnostic, Label, ModelError, quoted, refuse, suggest
from nsode.evaluate import apply, evaluate
from nsode.expr import Call, Expr, Name, Number, names
from nsode.inclusion.elaborate import CONSTANTS
from nsode.inclusion.order import loop, order
from nsode.inclusion.review import in_words
from nsode.inclusion.units.laws import unit_in
from nsode.ode import Approximation, Check, DifferentialInclusion, Parameter, SetValuedTerm
from nsode.regularizations import LAWS, Condition, Constant, law, laws_of
from nsode.rewrite.fixed import Fixed
from nsode.source import NOWHERE


def constants(inclusion: DifferentialInclusion) -> tuple[Parameter, ...]:
    """Return the constants of every term as parameters, NaN where the model gives none.

    Raises
    ------
    ModelError
        NS101 for a constant that is read and not there, NS303 for an unknown setting,
        NS306 for an unknown law, NS301 and NS302 for values that the law cannot use, NS308
        for targets.
    """
    terms, problems = _usable(inclusion)
    fixed = Fixed.of(inclusion)
    formulas: dict[str, Expr | None] = {}
    for term in terms:
        given = dict(term.approximation.constants)
        for constant in needed(term):
            formula = given.get(constant.name, fixed.formula(constant.default))
            formulas[f"{term.name}.{constant.name}"] = formula
    unknown = {} if problems else dict.fromkeys(_unknown(inclusion, formulas))
    if unknown:
        raise ModelError(unknown, inclusion.source)
    formulas = _in_parameters(formulas, fixed)
    single = {p.name: p.values[0] for p in inclusion.parameters if len(p.values) == 1}
    values = _values(formulas, single)
    found = [
        _parameter(term, name, formulas[name], values[name])
        for term in terms
        for name in (f"{term.name}.{constant.name}" for constant in needed(term))
    ]
    problems.extend(_broken(terms, found, formulas))
    if problems:
        raise ModelError(dict.fromkeys(problems), inclusion.source)
    return tuple(found)


def _usable(inclusion: DifferentialInclusion) -> tuple[list[SetValuedTerm], list[Diagnostic]]:
    """Return the terms whose law and settings exist, and what is wrong with the others."""
    terms: list[SetValuedTerm] = []
    problems: list[Diagnostic] = []
    for term in _by_kind(inclusion):
        try:
            _check_law(term)
            _check_settings(term)
            terms.append(term)
        except ModelError as error:
            problems.extend(error.diagnostics)
    return terms, problems


def _parameter(term: SetValuedTerm, name: str, formula: Expr | None, value: float) -> Parameter:
    read = formula if formula is not None and any(True for _ in names(formula)) else None
    span = term.span if formula is None or formula.span == NOWHERE else formula.span
    unit = unit_in(term, name.removeprefix(f"{term.name}."))
    return Parameter(name, (value,), None, unit, read, term.name, span=span)


def guards(inclusion: DifferentialInclusion) -> Iterator[Check]:
    """Yield what the constants must satisfy, also when they are overridden."""
    for term, constant, (relation, bound, why) in _conditions(_by_kind(inclusion)):
        other = Name(f"{term.name}.{bound}") if isinstance(bound, str) else Number(bound)
        holds = Call(relation, (Name(f"{term.name}.{constant.name}"), other), span=term.span)
        shown = bound if isinstance(bound, str) else f"{bound:g}"
        reason = f"{constant.name} {relation} {shown}: {why}"
        yield Check("bound", holds, reason=reason, span=term.span)


def needed(term: SetValuedTerm) -> tuple[Constant, ...]:
    """Return the constants that the law of a term needs."""
    return law(term.approximation.law).constants(term)


def _by_kind(inclusion: DifferentialInclusion) -> list[SetValuedTerm]:
    """Return the terms in the order of their auxiliary states: first dio, then sgn."""
    return sorted(inclusion.terms, key=lambda term: term.kind)


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


def _check_settings(term: SetValuedTerm) -> None:
    approximation = term.approximation
    known = [constant.name for constant in needed(term)]
    for name, value in approximation.constants:
        if name not in known:
            listed = quoted(known)
            usual = approximation.law == Approximation().law
            raise ModelError(
                [
                    Diagnostic(
                        "NS303",
                        f"`{term.kind if usual else approximation.law}` has no constant `{name}`",
                        (Label(value.span, f"given for `{term.name}`"),),
                        notes=(f"its constants are {listed}",),
                        help=suggest(name, known),
                    )
                ]
            )
    for name, value in approximation.targets:
        raise refuse(
            "NS308",
            f"the target `{name}` cannot be turned into constants yet",
            value.span,
            help="give K, beta and, for dio, alpha",
        )


def _check_law(term: SetValuedTerm) -> None:
    name, able = term.approximation.law, laws_of(term.kind)
    if name in able:
        return
    exists = name in LAWS
    raise refuse(
        "NS306",
        f"`{name}` cannot stand for `{term.kind}`" if exists else f"there is no law `{name}`",
        term.approximation.span,
        f"`{term.name}` is a `{term.kind}`" if exists else "",
        help=(None if exists else suggest(name, LAWS))
        or f"the laws for `{term.kind}` are " + quoted(able),
    )


def _in_parameters(formulas: Mapping[str, Expr | None], fixed: Fixed) -> dict[str, Expr | None]:
    """Return formulas that read parameters and other constants, seen through lets.

    Raises
    ------
    ModelError
        NS111 for one that changes in a run.
    """
    known = replace(fixed, parameters=fixed.parameters | formulas.keys())
    found: dict[str, Expr | None] = {}
    for name, formula in formulas.items():
        found[name] = known.formula(formula)
        if formula is not None and found[name] is None:
            moving = (read for read in names(formula) if known.formula(read) is None)
            raise refuse(
                "NS111",
                f"the constant `{name}` must rest on parameters alone",
                next(moving, formula).span,
                "this is not made of parameters",
                help="use numbers, parameters, other constants, and short `let` of these",
            )
    return found


def _values(
    formulas: Mapping[str, Expr | None], parameters: Mapping[str, float]
) -> Mapping[str, float]:
    """Return the value of each constant, NaN where the model gives none."""
    given = {name: formula for name, formula in formulas.items() if formula is not None}
    reads = {name: [n.id for n in names(formula)] for name, formula in given.items()}
    ordered = order(list(given), reads)
    if len(ordered) < len(given):
        raise _circle(loop(list(given), reads), given)
    found = dict.fromkeys(formulas, math.nan) | dict(parameters)
    for name in ordered:
        found[name] = evaluate(given[name], lambda other, at: found[other])
        known = not any(math.isnan(found[other.id]) for other in names(given[name]))
        if math.isinf(found[name]) or (math.isnan(found[name]) and known):
            raise refuse(
                "NS116",
                f"the constant `{name}` is {in_words(found[name])}",
                given[name].span,
                help="check the numbers that go into it",
            )
    return found


def _circle(constants: Sequence[str], formulas: Mapping[str, Expr]) -> ModelError:
    path = " -> ".join(f"`{name}`" for name in [*constants[:5], constants[0]])
    labels = tuple(Label(formulas[name].span, f"gives `{name}`") for name in constants[:5])
    message = f"these constants are defined by each other: {path}"
    return ModelError([Diagnostic("NS106", message, labels, help="give one of them a number")])


def _broken(
    terms: Sequence[SetValuedTerm],
    found: Sequence[Parameter],
    formulas: Mapping[str, Expr | None],
) -> Iterator[Diagnostic]:
    """Yield an error for each condition that the constants of the model break."""
    values = {parameter.name: parameter.values[0] for parameter in found}
    for term, constant, condition in _conditions(terms):
        name, formula = f"{term.name}.{constant.name}", formulas[f"{term.name}.{constant.name}"]
        match condition.bound:
            case str(other):
                bound, limit = values[f"{term.name}.{other}"], formulas[f"{term.name}.{other}"]
            case bound:
                limit = None
        if formula is None or not _fails(values[name], condition.relation, bound):
            continue
        place = Label(formula.span, f"{values[name]:g}")
        if limit is None:
            yield _out_of_range(name, condition, place)
        else:
            yield _misordered(term, constant, condition, (place, Label(limit.span, f"{bound:g}")))


def _conditions(
    terms: Iterable[SetValuedTerm],
) -> Iterator[tuple[SetValuedTerm, Constant, Condition]]:
    for term in terms:
        for constant in needed(term):
            for condition in constant.conditions:
                yield term, constant, condition


def _fails(value: float, relation: str, bound: float) -> bool:
    """Tell whether a relation is broken; what is not known breaks none."""
    if math.isnan(value) or math.isnan(bound):
        return False
    return not apply(relation, value, bound)


_WORDS = {">": "must be greater than", ">=": "must be at least", "<=": "must be at most"}


def _out_of_range(name: str, condition: Condition, place: Label) -> Diagnostic:
    relation, bound, why = condition
    return Diagnostic(
        "NS301",
        f"`{name}` {_WORDS[relation]} {bound:g}",
        (Label(place.span, f"this is {place.text}"),),
        notes=(why,),
        help="choose a positive value" if (relation, bound) == (">", 0.0) else None,
    )


def _misordered(
    term: SetValuedTerm, constant: Constant, condition: Condition, labels: tuple[Label, Label]
) -> Diagnostic:
    return Diagnostic(
        "NS302",
        f"{constant.name} of `{term.name}` is greater than its {condition.bound}",
        labels,
        notes=(condition.why,),
        help=f"choose {constant.name} {condition.relation} {condition.bound}",
    )
