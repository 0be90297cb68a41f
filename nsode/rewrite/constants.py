"""K, alpha and beta become parameters of the ODE, so that they can be swept."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse, suggest
from nsode.evaluate import evaluate
from nsode.expr import Call, Expr, Name, Number, names
from nsode.ode import Check, DifferentialInclusion, Parameter, SetValuedTerm
from nsode.regularizations import LAWS, law


def constants(inclusion: DifferentialInclusion) -> tuple[Parameter, ...]:
    """Return the constants of every term as parameters, NaN where the model gives none.

    Raises
    ------
    ModelError
        NS303 for an unknown setting, NS306 for an unknown law, NS301 and NS302 for
        values that the law cannot use, NS308 for targets.
    """
    formulas: dict[str, Expr | None] = {}
    owners: dict[str, SetValuedTerm] = {}
    problems: list[Diagnostic] = []
    for term in _by_kind(inclusion):
        try:
            given = _given(term)
        except ModelError as error:
            problems.extend(error.diagnostics)
            continue
        for name in law(term.approximation.law).constants(term):
            formulas[f"{term.name}.{name}"] = given.get(name)
            owners[f"{term.name}.{name}"] = term
    values = {p.name: p.values[0] for p in inclusion.parameters if len(p.values) == 1}
    found: list[Parameter] = []
    for name, formula in formulas.items():
        value = math.nan if formula is None else _value(name, formulas, values, ())
        problems.extend(_positive(name, value, formula))
        read = formula if formula is not None and any(True for _ in names(formula)) else None
        span = owners[name].span if formula is None else formula.span
        found.append(
            Parameter(name, (value,), formula=read, constant_of=owners[name].name, span=span)
        )
    problems.extend(_ordered(found, formulas))
    if problems:
        raise ModelError(dict.fromkeys(problems), inclusion.source)
    return tuple(found)


def guards(inclusion: DifferentialInclusion) -> Iterator[Check]:
    """Yield what the constants must satisfy, also when they are overridden."""
    for term in _by_kind(inclusion):
        needed = law(term.approximation.law).constants(term)
        for name in needed:
            positive = Call(">", (Name(f"{term.name}.{name}"), Number(0.0)), span=term.span)
            yield Check("bound", positive, reason=f"{name} > 0", span=term.span)
        if "alpha" in needed:
            alpha, beta = Name(f"{term.name}.alpha"), Name(f"{term.name}.beta")
            passive = Call("<=", (alpha, beta), span=term.span)
            reason = "alpha > beta creates energy"
            yield Check("bound", passive, reason=reason, span=term.span)


def _by_kind(inclusion: DifferentialInclusion) -> list[SetValuedTerm]:
    """Return the terms in the order of their auxiliary states: first dio, then sgn."""
    return sorted(inclusion.terms, key=lambda term: term.kind)


def _given(term: SetValuedTerm) -> Mapping[str, Expr]:
    approximation = term.approximation
    if approximation.law not in LAWS:
        raise refuse(
            "NS306",
            f"there is no law `{approximation.law}`",
            approximation.span,
            help=suggest(approximation.law, LAWS) or "the laws are " + ", ".join(LAWS),
        )
    known = law(approximation.law).constants(term)
    for name, value in approximation.constants:
        if name not in known:
            listed = ", ".join(f"`{constant}`" for constant in known)
            raise ModelError(
                [
                    Diagnostic(
                        "NS303",
                        f"`{term.kind}` has no constant `{name}`",
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
    return dict(approximation.constants)


def _value(
    name: str,
    formulas: Mapping[str, Expr | None],
    values: Mapping[str, float],
    inside: tuple[str, ...],
) -> float:
    formula = formulas.get(name)
    if name in values:
        return values[name]
    if formula is None:
        return math.nan
    if name in inside:
        raise refuse("NS106", f"`{name}` is defined by itself", formula.span)
    return evaluate(formula, lambda other, at: _value(other, formulas, values, (*inside, name)))


def _positive(name: str, value: float, formula: Expr | None) -> list[Diagnostic]:
    if formula is None or value > 0 or math.isnan(value):
        return []
    return [
        Diagnostic(
            "NS301",
            f"`{name}` must be greater than 0",
            (Label(formula.span, f"this is {value:g}"),),
            notes=(_why(name),),
            help="choose a positive value",
        )
    ]


def _why(name: str) -> str:
    match name.rpartition(".")[2]:
        case "alpha":
            return "alpha = 0 divides by zero"
        case "beta":
            return "a negative beta grows without bound"
    return "it is a stiffness"


def _ordered(found: list[Parameter], formulas: Mapping[str, Expr | None]) -> list[Diagnostic]:
    values = {parameter.name: parameter.values[0] for parameter in found}
    problems: list[Diagnostic] = []
    for name, alpha in values.items():
        head, _, constant = name.rpartition(".")
        beta = values.get(f"{head}.beta", math.nan)
        formula, other = formulas[name], formulas.get(f"{head}.beta")
        if constant == "alpha" and alpha > beta and formula is not None and other is not None:
            problems.append(
                Diagnostic(
                    "NS302",
                    f"alpha of `{head}` is greater than its beta",
                    (Label(formula.span, f"{alpha:g}"), Label(other.span, f"{beta:g}")),
                    notes=("alpha > beta creates energy; alpha = beta is perfectly elastic",),
                    help="choose alpha <= beta",
                )
            )
    return problems
