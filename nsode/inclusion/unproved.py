"""What stands in the way of a proof that chi >= 0, in words, and the way out."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import Call, Expr, If, Name, Number, Sum, children
from nsode.inclusion.facts import Goal, indices
from nsode.inclusion.families import Axes, Case, cases, elements
from nsode.inclusion.signs import Prover, holds, values_at
from nsode.ode import SetValuedTerm, element
from nsode.source import Source


def unproved(
    prover: Prover, term: SetValuedTerm, parts: Iterable[Case], source: Source
) -> ModelError:
    """Return the error for the factor of a term, which is written in parts over its range."""
    factor = term.factor
    assert factor is not None
    case = next(case for case in parts if prover.prove(case.expr, ">=", case.over) is None)
    culprit = _culprit(prover, case)
    argument = source.on_one_line(term.argument[0].span.to(term.argument[-1].span))
    shown = f"the factor `{written(term, source)}` of `sgn({argument})`"
    start = culprit.part.span.start
    inside = [span for span in term.written if span.start <= start < span.end]
    whole = term.written[0] if len(term.written) == 1 else term.span
    labels = [Label(next(iter(inside), whole), "this factor may change sign")]
    if not inside:
        labels.append(Label(culprit.part.span, "because of this"))
    return ModelError(
        [
            Diagnostic(
                "NS201",
                f"cannot prove that {shown} is nonnegative",
                tuple(labels),
                notes=(_reason(prover, culprit, source),),
                help=_way_out(prover, culprit, source),
            )
        ]
    )


def written(term: SetValuedTerm, source: Source) -> str:
    """Return the factor of a term as a person wrote it, without the sgn that it may enclose."""
    return "*".join(map(source.on_one_line, term.written)) or "1"


class _Culprit(NamedTuple):
    """The smallest part that stands in the way of a proof, and what it would have to be."""

    part: Expr
    wanted: Goal
    over: Axes


def _culprit(prover: Prover, case: Case) -> _Culprit:
    found = _Culprit(case.expr, ">=", case.over)
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
            parts = [_Culprit(arg, wanted, over) for arg in args]
        case If(_, then, otherwise):
            parts = [_Culprit(then, wanted, over), _Culprit(otherwise, wanted, over)]
        case Call("/", (dividend, divisor)):
            parts = [_Culprit(dividend, wanted, over), _Culprit(divisor, ">", over)]
        case Sum(inside, body):
            parts = [_Culprit(body, wanted, (*over, inside))]
        case Name(id) if id in prover.numbering.bindings:
            binding = prover.numbering.bindings[id]
            if not children(binding.value):
                return None
            found = cases(binding.value, binding.range)
            parts = [_Culprit(case.expr, wanted, case.over) for case in found]
        case _:
            return None
    return next((part for part in parts if prover.prove(*part) is None), None)


def _is_taken_away(term: Expr) -> bool:
    match term:
        case Call("neg", _):
            return True
        case Number(value):
            return value < 0
    return False


def _reason(prover: Prover, culprit: _Culprit, source: Source) -> str:
    match culprit.part:
        case Name(id) as name if id in prover.parameters:
            shown, value = _broken(prover, name, culprit)
            return f"the parameter `{shown}` is {value:g}"
        case Name():
            return f"nothing bounds `{source.on_one_line(culprit.part.span)}` from below"
        case Number(value):
            return f"{value:g} is negative"
        case Call("+", _):
            return "a difference may be negative"
        case Call("neg", _):
            return "a minus stands in front of it"
        case Call(function, _) if function.isalpha():
            return f"`{function}` takes both signs"
    return "a part of it takes both signs"


def _broken(prover: Prover, name: Name, culprit: _Culprit) -> tuple[str, float]:
    """Return the name of a parameter that has the wrong sign, or of its element, and its value."""
    parameter = prover.parameters[name.id]
    values = values_at(parameter, elements(name.at, culprit.over))
    k, value = next((k, value) for k, value in values if not holds(value, culprit.wanted))
    return parameter.name if parameter.range is None else element(parameter.name, k), value


def _way_out(prover: Prover, culprit: _Culprit, source: Source) -> str:
    text = source.on_one_line(culprit.part.span)
    relation = ">" if culprit.wanted == ">" else ">="
    match culprit.part:
        case Name(id) as name if id in prover.parameters:
            words = "greater than 0" if relation == ">" else "that is not negative"
            return f"give `{_broken(prover, name, culprit)[0]}` a value {words}"
        case Name():
            way_out = "divide by something positive" if relation == ">" else f"write `abs({text})`"
            return _or_assume(way_out, f"{text} {relation} 0", culprit)
        case Call("+", (left, Call("neg", (right,)))):
            above = f"{source.on_one_line(left.span)} >= {source.on_one_line(right.span)}"
            return _or_assume(f"write `max(0, {text})`", above, culprit)
    return "write `abs(...)` or `max(0, ...)`, or state `assume ... >= 0` if it always holds"


def _or_assume(way_out: str, condition: str, culprit: _Culprit) -> str:
    """Add the assumption that would do; that of a family holds for each index."""
    read = {index.variable for index in indices(culprit.part)}
    axes = [axis for axis in culprit.over if axis.variable in read]
    if len(axes) > 1:
        return way_out
    each = "".join(f"for {axis.variable} in {axis.first}..{axis.last}: " for axis in axes)
    return f"{way_out}, or state `{each}assume {condition}` if it always holds"
