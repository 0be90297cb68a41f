"""What the constants of a law must satisfy: in the model, and whenever they are overridden."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

from nsode.diagnostics import Diagnostic, Label
from nsode.evaluate import apply
from nsode.expr import Call, Name, Number
from nsode.ode import Check, SetValuedTerm
from nsode.regularizations import Condition, Constant
from nsode.rewrite.choices import needed
from nsode.rewrite.formulas import Formulas


def guards(terms: Iterable[SetValuedTerm]) -> Iterator[Check]:
    """Yield what the constants must satisfy, also when they are overridden."""
    for term, constant, (relation, bound, why) in _conditions(terms):
        other = Name(f"{term.name}.{bound}") if isinstance(bound, str) else Number(bound)
        holds = Call(relation, (Name(f"{term.name}.{constant.name}"), other), span=term.span)
        shown = bound if isinstance(bound, str) else f"{bound:g}"
        reason = f"{constant.name} {relation} {shown}: {why}"
        yield Check("bound", holds, reason=reason, span=term.span)


def broken(
    terms: Iterable[SetValuedTerm], values: Mapping[str, float], formulas: Formulas
) -> Iterator[Diagnostic]:
    """Yield an error for each condition that the constants of the model break."""
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
