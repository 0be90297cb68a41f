"""chi >= 0: proved, or the model is refused."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum, add, children, negate
from nsode.inclusion.sharing import Numbering
from nsode.inclusion.signs import Goal, Prover
from nsode.ode import Binding, Check, DifferentialInclusion, Parameter, SetValuedTerm
from nsode.source import Source

_RELATIONS: dict[str, Goal] = {">=": ">=", ">": ">", "<=": "<=", "<": "<"}


def prover_of(inclusion: DifferentialInclusion, checks: Iterable[Check]) -> Prover:
    """Return a prover over the definitions of a model, its declared bounds and assumptions."""
    prover = Prover(Numbering(), {p.name: p for p in inclusion.parameters})
    for item in inclusion.bindings:
        match item:
            case Binding():
                prover.numbering.add(item)
            case SetValuedTerm(kind="dio"):
                prover.nonnegative.update(item.multiplier)
    for check in checks:
        _take(prover, check.condition, check.kind == "bound")
    return prover


def _take(prover: Prover, condition: Expr, bound: bool) -> None:
    match condition:
        case Call("and", (left, right)):
            _take(prover, left, bound)
            _take(prover, right, bound)
        case Call(relation, (Name(id, at) as name, Number(limit))) if bound:
            goal = _RELATIONS[relation]
            sign = _sign_beyond(limit, goal)
            if sign is not None:
                prover.bounds.setdefault(id, set()).add(sign)
            if at is None:
                prover.assume(_difference(name, Number(limit)), goal)
        case Call(relation, (left, right)) if relation in _RELATIONS:
            goal = _RELATIONS[relation]
            prover.assume(_difference(left, right), goal)
            for side, other, seen in ((left, right, goal), (right, left, _MIRRORED[goal])):
                sign = _sign_beyond(other.value, seen) if isinstance(other, Number) else None
                if sign is not None:
                    prover.assume(side, sign)


_MIRRORED: dict[Goal, Goal] = {">=": "<=", ">": "<", "<=": ">=", "<": ">"}


def _sign_beyond(limit: float, goal: Goal) -> Goal | None:
    """Return the sign of whatever is beyond a limit, where it has one."""
    if goal in {">=", ">"} and limit >= 0:
        return ">" if limit > 0 else goal
    if goal in {"<=", "<"} and limit <= 0:
        return "<" if limit < 0 else goal
    return None


def _difference(left: Expr, right: Expr) -> Expr:
    """Return ``left - right`` as one flat sum, as a factor would be written."""
    return add(*_terms(left), *(negate(term) for term in _terms(right)))


def _terms(expr: Expr) -> tuple[Expr, ...]:
    return expr.args if isinstance(expr, Call) and expr.function == "+" else (expr,)


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
    proof = prover.prove(factor, ">=", *_axes(term))
    if proof is None:
        raise _unproved(prover, term, factor, source)
    watched = Call(">=", (factor, Number(0.0)), span=factor.span)
    reason = f"the factor of `{term.name}`"
    checks = [Check("factor", watched, term.range, reason, span=factor.span)]
    for name, goal in sorted(proof):
        if goal == ">=" and (name, ">") in proof:
            continue
        checks.append(_guard(prover.parameters[name], goal, reason, term))
    return checks


def _axes(item: Binding | SetValuedTerm) -> tuple[IndexRange, ...]:
    return () if item.range is None else (item.range,)


def _guard(parameter: Parameter, goal: Goal, reason: str, term: SetValuedTerm) -> Check:
    at = None if parameter.range is None else Index(parameter.range.variable)
    condition = Call(goal, (Name(parameter.name, at), Number(0.0)), span=parameter.span)
    why = f"{reason} is nonnegative only then"
    return Check("bound", condition, parameter.range, why, span=term.span)


def _unproved(prover: Prover, term: SetValuedTerm, factor: Expr, source: Source) -> ModelError:
    culprit = _culprit(prover, factor, _axes(term))
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
                notes=(_reason(prover, culprit, source),),
                help=_way_out(prover, culprit, source),
            )
        ]
    )


class _Culprit(NamedTuple):
    """The smallest part that stands in the way of a proof, and what it would have to be."""

    part: Expr
    wanted: Goal
    over: tuple[IndexRange, ...]


def _culprit(prover: Prover, expr: Expr, over: tuple[IndexRange, ...]) -> _Culprit:
    found = _Culprit(expr, ">=", over)
    while (inner := _inner(prover, found)) is not None:
        found = inner
    return found


def _inner(prover: Prover, culprit: _Culprit) -> _Culprit | None:
    """Return the part of a part that stands in the way, None where there is no smaller one."""
    expr, wanted, over = culprit
    match expr:
        case Call("+", args) if any(_is_taken_away(arg) for arg in args):
            return None
        case Call("+" | "*", args):
            parts = [(arg, wanted) for arg in args]
        case If(_, then, otherwise):
            parts = [(then, wanted), (otherwise, wanted)]
        case Call("/", (dividend, divisor)):
            parts = [(dividend, wanted), (divisor, ">")]
        case Sum(inside, body):
            return _Culprit(body, wanted, (*over, inside))
        case Name(id) if id in prover.numbering.bindings:
            binding = prover.numbering.bindings[id]
            simple = not children(binding.value)
            return None if simple else _Culprit(binding.value, wanted, _axes(binding))
        case _:
            return None
    for part, goal in parts:
        if prover.prove(part, goal, *over) is None:
            return _Culprit(part, goal, over)
    return None


def _is_taken_away(term: Expr) -> bool:
    match term:
        case Call("neg", _):
            return True
        case Number(value):
            return value < 0
    return False


def _reason(prover: Prover, culprit: _Culprit, source: Source) -> str:
    match culprit.part:
        case Name(id) if id in prover.parameters:
            values = prover.parameters[id].values
            return f"the parameter `{id}` is {min(values, default=0):g}"
        case Name():
            return f"nothing bounds `{source.slice(culprit.part.span)}` from below"
        case Number(value):
            return f"{value:g} is negative"
        case Call("+", _):
            return "a difference may be negative"
        case Call("neg", _):
            return "a minus stands in front of it"
        case Call(function, _) if function.isalpha():
            return f"`{function}` takes both signs"
    return "a part of it takes both signs"


def _way_out(prover: Prover, culprit: _Culprit, source: Source) -> str:
    text = source.slice(culprit.part.span)
    positive = culprit.wanted == ">"
    match culprit.part:
        case Name(id) if id in prover.parameters:
            words = "greater than 0" if positive else "that is not negative"
            return f"give `{id}` a value {words}"
        case Name(at=Index()):
            return f"write `abs({text})` or `max(0, {text})`"
        case Name() if positive:
            return f"divide by something positive, or state `assume {text} > 0` if it always holds"
        case Name():
            return f"write `abs({text})`, or state `assume {text} >= 0` if it always holds"
        case Call("+", (left, Call("neg", (right,)))):
            assumed = f"assume {source.slice(left.span)} >= {source.slice(right.span)}"
            return f"write `max(0, {text})`, or state `{assumed}` if it always holds"
    return "write `abs(...)` or `max(0, ...)`, or state `assume ... >= 0` if it always holds"
