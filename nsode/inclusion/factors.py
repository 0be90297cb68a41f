"""chi >= 0: proved, or the model is refused."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import chain

from nsode.expr import Call, Expr, Index, IndexRange, Name, Number, add, negate
from nsode.inclusion.facts import OPPOSITE, Facts, Goal
from nsode.inclusion.families import Axes, cases
from nsode.inclusion.report import Report
from nsode.inclusion.sharing import Numbering
from nsode.inclusion.signs import Guard, Proof, Prover
from nsode.inclusion.unproved import unproved, written
from nsode.ode import Binding, Check, DifferentialInclusion, Parameter, SetValuedTerm
from nsode.source import Source

_RELATIONS: dict[str, Goal] = {">=": ">=", ">": ">", "<=": "<=", "<": "<"}
_NEGATED = {">=": "<", ">": "<=", "<=": ">", "<": ">="}


def prover_of(inclusion: DifferentialInclusion) -> Prover:
    """Return a prover over the definitions of a model, its declared bounds and assumptions."""
    prover = Prover(Numbering(), {p.name: p for p in inclusion.parameters})
    for item in inclusion.bindings:
        match item:
            case Binding():
                prover.numbering.add(item)
            case SetValuedTerm(kind="dio"):
                prover.nonnegative.update(item.multiplier)
    for check in inclusion.checks:
        for condition, over in cases(check.condition, check.range):
            _take(prover.facts, condition, over)
    return prover


def _take(facts: Facts, condition: Expr, over: Axes) -> None:
    match condition:
        case Call("and", (left, right)):
            _take(facts, left, over)
            _take(facts, right, over)
        case Call("not", (Call(relation, sides),)) if relation in _NEGATED:
            _take(facts, Call(_NEGATED[relation], sides), over)
        case Call("==", sides):
            _take(facts, Call(">=", sides), over)
            _take(facts, Call("<=", sides), over)
        case Call(relation, (left, right)) if relation in _RELATIONS:
            goal = _RELATIONS[relation]
            facts.add(_difference(left, right), goal, over)
            for side, other, seen in ((left, right, goal), (right, left, OPPOSITE[goal])):
                sign = _sign_beyond(other.value, seen) if isinstance(other, Number) else None
                if sign is not None:
                    facts.add(side, sign, over)


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


def with_proved_factors(
    inclusion: DifferentialInclusion, terms: Iterable[SetValuedTerm], report: Report
) -> DifferentialInclusion:
    """Return the inclusion with nonnegative factors, and with checks of what proves them."""
    prover = prover_of(inclusion)
    found = report.each(lambda term: prove_factor(prover, term, inclusion.source), terms)
    proved = {term.name: term for term, _ in found}
    bindings = (
        proved.get(item.name, item) if isinstance(item, SetValuedTerm) else item
        for item in inclusion.bindings
    )
    checks = chain(inclusion.checks, *(checks for _, checks in found))
    return replace(inclusion, bindings=tuple(bindings), checks=tuple(checks))


def prove_factor(
    prover: Prover, term: SetValuedTerm, source: Source
) -> tuple[SetValuedTerm, list[Check]]:
    """Prove that the factor of a term is nonnegative.

    A factor that is declared to be at most zero is one of the other sign:
    ``chi*sgn(theta)`` is ``(-chi)*sgn(-theta)``.

    Returns
    -------
    SetValuedTerm
        The term with a nonnegative factor.
    list of Check
        chi >= 0 itself, to be watched at run time, and the sign of each parameter, or
        value of parameters, that lent it.

    Raises
    ------
    ModelError
        NS201 without a proof.
    """
    if term.factor is None:
        return term, []
    parts = cases(term.factor, term.range)
    guards = prover.prove_all(parts, ">=")
    if guards is not None:
        return term, _checks(prover, term, term.factor, guards, source)
    guards = prover.prove_all(parts, "<=")
    if guards is None or any(guard.goal in {"<=", "<"} for guard in guards):
        raise unproved(prover, term, parts, source)
    mirrored = replace(
        term, factor=negate(term.factor), argument=tuple(negate(part) for part in term.argument)
    )
    return mirrored, _checks(prover, term, negate(term.factor), guards, source)


def _checks(
    prover: Prover, term: SetValuedTerm, factor: Expr, guards: Proof, source: Source
) -> list[Check]:
    watched = Call(">=", (factor, Number(0.0)), span=factor.span)
    reason = f"the factor `{written(term, source)}` of `{term.name}`"
    checks = [Check("factor", watched, term.range, reason, span=factor.span)]
    for guard in sorted(guards, key=repr):
        if guard.goal == ">=" and guard._replace(goal=">") in guards:
            continue
        checks.append(_checked(prover.parameters, guard, reason, term))
    return checks


def _checked(
    parameters: Mapping[str, Parameter], guard: Guard, reason: str, term: SetValuedTerm
) -> Check:
    value, over = guard.value, None
    if isinstance(value, Name) and (family := parameters[value.id].range) is not None:
        value = replace(value, at=Index(family.variable))
        over = IndexRange(family.variable, *guard.elements)
    condition = Call(guard.goal, (value, Number(0.0)), span=value.span)
    why = f"{reason} may then be negative"
    return Check("bound", condition, over, why, span=term.span)
