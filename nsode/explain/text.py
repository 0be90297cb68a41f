"""An explanation for a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import isnan
from typing import TYPE_CHECKING

from nsode.explain.closed import Value, rates, values
from nsode.explain.constants import Constant, constants
from nsode.explain.definitions import behind, fixed
from nsode.explain.plain import number, over, plain
from nsode.expr import Expr, Index, IndexRange, Name, Number, multiply
from nsode.ode import (
    RATE_SUFFIX,
    Binding,
    Definition,
    LinearSolve,
    Rate,
    SetValuedTerm,
    System,
    size,
)

if TYPE_CHECKING:
    from nsode.explain import Explanation, Step

Row = tuple[str, str, str]


def text(explanation: Explanation, *, color: bool = False) -> str:
    """Return an explanation as lines for a terminal."""

    def head(words: str) -> str:
        return f"\033[1m{words}\033[0m" if color else words

    return "\n".join(line.rstrip() for line in _lines(explanation, head)) + "\n"


def _lines(explanation: Explanation, head: Callable[[str], str]) -> Iterator[str]:
    inclusion, ode = explanation.inclusion, explanation.ode
    if not explanation.steps:
        yield head(f"{ode.name}: no set-valued term, so nothing is replaced")
        yield ""
        yield head("The ODE")
        yield from _closed(explanation)
        return
    yield head(f"{ode.name}: from the differential inclusion to an ODE")
    yield ""
    yield head("The differential inclusion, as in (31)")
    yield from _equations(inclusion.rates, behind(inclusion), inclusion)
    dio = [step for step in explanation.steps if step.term.kind == "dio"]
    sgn = [step for step in explanation.steps if step.term.kind == "sgn"]
    for found, title, form in (
        (dio, "First, each dio(psi) is replaced", "K*max(0, e - beta*(psi + e)/alpha)"),
        (sgn, "Next, each chi*sgn(theta) is replaced", "K*sat(chi/K, a + beta*theta)"),
    ):
        if found:
            yield ""
            of_paper = all(step.law == "xiong2013" for step in found)
            yield head(f"{title} by {form}" if of_paper else f"{title} by its law")
            for step in found:
                yield from _step(step)
    appended_by = [(rate, step) for step in explanation.steps for rate in step.rates]
    if appended_by:
        yield ""
        yield head("Finally, the states e and a are appended")
        yield from _table(_appended(rate, step) for rate, step in appended_by)
    appended = sum(map(size, ode.auxiliary))
    own = sum(map(size, ode.states)) - appended
    yield ""
    states = "state" if own == 1 else "states"
    yield head(f"The augmented ODE, as in (32): {own} {states} and {appended} appended")
    yield from _closed(explanation)
    rows = list(_constants(explanation))
    if rows:
        yield ""
        yield head("Constants")
        yield from _table(rows)


def _closed(explanation: Explanation) -> Iterator[str]:
    yield from _equations(rates(explanation), values(explanation), explanation.inclusion)


def _equations(
    rates: Iterable[Rate], items: Iterable[Value | Definition], system: System
) -> Iterator[str]:
    """Yield the rates, also those that a mass matrix couples, and what they rest on."""
    rows = [_rate(rate) for rate in rates if not _has_a_name(rate)]
    where: list[Row] = []
    for item in items:
        (rows if isinstance(item, LinearSolve) else where).extend(_definition(item, system))
    yield from _table(rows)
    if where:
        yield "where"
        yield from _table(where)


def _has_a_name(rate: Rate) -> bool:
    """Whether a rate is defined elsewhere, so that here stands nothing but its name."""
    return isinstance(rate.value, Name) and rate.value.id == rate.state + RATE_SUFFIX


def _rate(rate: Rate) -> Row:
    return f"der({_named((rate.state,), rate.range)})", _equals(rate.value, rate.range), ""


def _equals(value: Expr, range: IndexRange | None) -> str:
    return f"= {plain(fixed(value, range))}{over(range)}"


def _named(names: tuple[str, ...], range: IndexRange | None) -> str:
    at = None if range is None else Index(range.variable)
    shown = [plain(fixed(Name(id, at), range)) for id in names]
    return shown[0] if len(shown) == 1 else f"[{', '.join(shown)}]"


def _definition(item: Value | Definition, system: System) -> Iterator[Row]:
    match item:
        case Value(names, value, range):
            yield _named(names, range), _equals(value, range), ""
        case Binding(name, value, range):
            yield _named((name,), range), _equals(value, range), ""
        case SetValuedTerm():
            line = f"line {system.source.position(item.span.start).line}"
            yield _named(item.multiplier, item.range), f"in {law(item)}{over(item.range)}", line
        case LinearSolve(unknowns, matrix, right, range):
            rows = ", ".join(f"[{_listed(row, range)}]" for row in matrix)
            sides = _listed(right, range)
            yield f"[{rows}]*{_named(unknowns, range)}", f"= [{sides}]{over(range)}", ""


def _listed(entries: Iterable[Expr], range: IndexRange | None) -> str:
    return ", ".join(plain(fixed(entry, range)) for entry in entries)


def law(term: SetValuedTerm) -> str:
    """Return the law of a term, as a person writes it."""
    parts = [plain(part) for part in term.argument]
    argument = parts[0] if len(parts) == 1 else f"[{', '.join(parts)}]"
    if term.factor is None or term.factor == Number(1.0):
        return f"{term.kind}({argument})"
    return f"{plain(multiply(term.factor, Name(f'{term.kind}({argument})')))}"


def _step(step: Step) -> Iterator[str]:
    number = f"({step.numbers[0]})" if step.numbers else step.law
    yield f"  line {step.line}: {step.written}"
    yield from _table(_value(ids, value, step, number) for ids, value in step.values)


def _value(names: tuple[str, ...], value: Expr, step: Step, number: str) -> Row:
    over = step.term.range
    return f"  {_named(names, over)}", _equals(value, over), number


def _appended(rate: Rate, step: Step) -> Row:
    left, value, _ = _rate(rate)
    return left, value, f"({step.numbers[1]})" if step.numbers else ""


def _constants(explanation: Explanation) -> Iterator[Row]:
    for group, terms in constants(explanation).items():
        shown = ", ".join(map(_constant, group))
        yield f"{', '.join(terms)}:", shown, ""


def _constant(item: Constant) -> str:
    if isnan(item.value):
        return f"{item.name} not given"
    return f"{item.name} = {number(item.value)} {item.unit}".rstrip()


#: A left side beyond this many characters does not push the others to the right.
_WIDEST = 24


def _table(rows: Iterable[Row]) -> Iterator[str]:
    """Align the relations of some rows, and what is said about them."""
    found = list(rows)
    left = max((len(row[0]) for row in found if len(row[0]) <= _WIDEST), default=0)
    right = max((len(row[1]) for row in found if row[2]), default=0)
    for name, value, remark in found:
        line = f"  {name:<{left}} {value}"
        yield f"{line:<{left + right + 3}}   {remark}" if remark else line
