"""chi >= 0: proved, or the model is refused."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import Call, Expr, If, Index, Name, Number, children, subtract
from nsode.inclusion.signs import Goal, Prover
from nsode.ode import Check, Parameter, SetValuedTerm
from nsode.source import Source

_RELATIONS: dict[str, Goal] = {">=": ">=", ">": ">", "<=": "<=", "<": "<"}


def take_checks(prover: Prover, checks: Iterable[Check]) -> None:
    """Let proofs use declared bounds and assumptions."""
    for check in checks:
        _take(prover, check.condition, check.kind == "bound")


def _take(prover: Prover, condition: Expr, bound: bool) -> None:
    match condition:
        case Call("and", (left, right)):
            _take(prover, left, bound)
            _take(prover, right, bound)
        case Call(relation, (Name(id), Number(limit))) if bound:
            goal = _RELATIONS[relation]
            if goal in {">=", ">"} and limit >= 0:
                prover.bounds.setdefault(id, set()).add(">" if limit > 0 else goal)
            if goal in {"<=", "<"} and limit <= 0:
                prover.bounds.setdefault(id, set()).add("<" if limit < 0 else goal)
        case Call(relation, (left, right)) if relation in _RELATIONS:
            prover.assume(subtract(left, right), _RELATIONS[relation])


def prove_factor(prover: Prover, term: SetValuedTerm, source: Source) -> list[Check]:
    """Prove that the factor of a term is nonnegative.

    Returns
    -------
    list of Check
        chi >= 0 itself, to be watched at run time, and the sign of each parameter that
        lent the sign of its value.

    Raises
    ------
    ModelError
        NS201 without a proof.
    """
    factor = term.factor
    if factor is None:
        return []
    proof = prover.prove(factor, ">=")
    if proof is None:
        raise _unproved(prover, term, factor, source)
    watched = Call(">=", (factor, Number(0.0)), span=factor.span)
    reason = f"the factor of `{term.name}`"
    checks = [Check("factor", watched, term.range, reason, span=factor.span)]
    for name, goal in sorted(proof):
        checks.append(_guard(prover.parameters[name], goal, reason, term))
    return checks


def _guard(parameter: Parameter, goal: Goal, reason: str, term: SetValuedTerm) -> Check:
    at = None if parameter.range is None else Index(parameter.range.variable)
    condition = Call(goal, (Name(parameter.name, at), Number(0.0)), span=parameter.span)
    why = f"{reason} is nonnegative only then"
    return Check("bound", condition, parameter.range, why, span=term.span)


def _unproved(prover: Prover, term: SetValuedTerm, factor: Expr, source: Source) -> ModelError:
    culprit = _culprit(prover, factor)
    shown = source.slice(factor.span) or "1"
    argument = source.slice(term.argument[0].span.to(term.argument[-1].span))
    labels = [Label(factor.span, "this factor may change sign")]
    if not factor.span.start <= culprit.part.span.start < factor.span.end:
        labels.append(Label(culprit.part.span, "because of this"))
    return ModelError(
        [
            Diagnostic(
                "NS201",
                f"cannot prove that the factor `{shown}` of `sgn({argument})` is nonnegative",
                tuple(labels),
                notes=(_reason(prover, culprit),),
                help=_way_out(prover, culprit),
            )
        ]
    )


class _Culprit(NamedTuple):
    """The smallest part that stands in the way of a proof, and what it would have to be."""

    part: Expr
    wanted: Goal


def _culprit(prover: Prover, expr: Expr, wanted: Goal = ">=") -> _Culprit:
    match expr:
        case Call("+", args) | Call("*", args):
            for arg in args:
                if prover.prove(arg, wanted) is None:
                    return _culprit(prover, arg, wanted)
        case Call("/", (dividend, divisor)):
            if prover.prove(dividend, wanted) is None:
                return _culprit(prover, dividend, wanted)
            return _culprit(prover, divisor, ">")
        case If(_, then, otherwise):
            for arg in (then, otherwise):
                if prover.prove(arg, wanted) is None:
                    return _culprit(prover, arg, wanted)
        case Name(id) if id in prover.numbering.bindings:
            inner = prover.numbering.bindings[id].value
            if children(inner):
                return _culprit(prover, inner, wanted)
    return _Culprit(expr, wanted)


def _reason(prover: Prover, culprit: _Culprit) -> str:
    match culprit.part:
        case Name(id) if id in prover.parameters:
            values = prover.parameters[id].values
            return f"the parameter `{id}` is {min(values, default=0):g}"
        case Name(id):
            return f"nothing bounds `{id}` from below"
        case Number(value):
            return f"{value:g} is negative"
        case Call(function, _) if function.isalpha() and function != "neg":
            return f"`{function}` takes both signs"
    return "a part of it takes both signs"


def _way_out(prover: Prover, culprit: _Culprit) -> str:
    words = "greater than 0" if culprit.wanted == ">" else "that is not negative"
    match culprit.part:
        case Name(id) if id in prover.parameters:
            return f"give `{id}` a value {words}"
        case Name(id) if culprit.wanted == ">":
            return f"divide by something positive, or state `assume {id} > 0` if it always holds"
        case Name(id):
            return f"write `abs({id})`, or state `assume {id} >= 0` if it always holds"
    return "write `abs(...)` or `max(0, ...)`, or state `assume ... >= 0` if it always holds"
