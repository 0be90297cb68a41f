"""An explanation with its equations typeset: Markdown or LaTeX."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import isnan
from typing import TYPE_CHECKING

from nsode.backends.latex import DOCUMENT, Environment, lower
from nsode.backends.latex.equations import (
    aligned,
    columns,
    definition,
    definitions,
    environment,
    one,
    over,
    state_space,
    vector,
)
from nsode.backends.latex.names import escape, unit, word
from nsode.explain.closed import Value, rates, values
from nsode.explain.constants import Constant, constants
from nsode.explain.definitions import behind
from nsode.expr import Number
from nsode.ode import Definition

if TYPE_CHECKING:
    from nsode.explain import Explanation, Step


@dataclass(frozen=True, slots=True)
class Style:
    """How headings, code and displayed equations look, and the document around them."""

    heading: str
    code: Callable[[str], str]
    display: str
    document: Callable[[str, str], str]


def _markdown(title: str, body: str) -> str:
    return f"# {title}\n\n{body}"


def _latex(title: str, body: str) -> str:
    return DOCUMENT.format(title=escape(title), body=body)


def _typewriter(text: str) -> str:
    return rf"\texttt{{{escape(text)}}}"


MARKDOWN = Style("## {}\n\n", lambda text: f"`{text}`", "$$\n{}\n$$\n\n", _markdown)
LATEX = Style("\\subsection*{{{}}}\n", _typewriter, "\\[\n{}\n\\]\n", _latex)


_TITLES = {"dio": "First, replace dio", "sgn": "Next, replace sgn with its factor"}


def typeset(explanation: Explanation, style: Style) -> str:
    """Return an explanation in one of the styles."""
    body = "".join(_parts(explanation, style)).rstrip() + "\n"
    return style.document(explanation.ode.name, body)


def _parts(explanation: Explanation, style: Style) -> Iterator[str]:
    inclusion = explanation.inclusion
    env = environment(inclusion, explanation.ode)
    if explanation.steps:
        yield style.heading.format("The differential inclusion")
        yield style.display.format(state_space(inclusion, env))
        yield from _where([definitions(behind(inclusion), env)], style)
        yield from _replacements(explanation, env, style)
        appended = list(_appended(explanation, env))
        if appended:
            yield style.heading.format("Finally, append the states")
            yield style.display.format(aligned(appended))
    yield style.heading.format("The augmented ODE" if explanation.steps else "The ODE")
    yield style.display.format(columns(rates(explanation), "=", env))
    rows = [row for item in values(explanation) for row in _definition(item, env)]
    yield from _where([aligned(rows)] if rows else [], style)
    given = list(_constants(explanation, env))
    if given:
        yield style.heading.format("Constants")
        yield style.display.format(aligned(given))


def _where(equations: Iterable[str], style: Style) -> Iterator[str]:
    for equation in equations:
        yield "where\n\n"
        yield style.display.format(equation)


def _replacements(explanation: Explanation, env: Environment, style: Style) -> Iterator[str]:
    for kind, title in _TITLES.items():
        found = [step for step in explanation.steps if step.term.kind == kind]
        if found:
            yield style.heading.format(title)
        for step in found:
            yield f"Line {step.line}: {style.code(step.written)} is replaced by\n\n"
            yield style.display.format(_forces(step, env))


def _definition(item: Value | Definition, env: Environment) -> Iterator[str]:
    if isinstance(item, Value):
        yield _equation(item, env, " &= ")
    else:
        yield from definition(item, env)


def _equation(item: Value, env: Environment, relation: str) -> str:
    inner = env if item.range is None else env.inside(item.range)
    left = vector(item.names, item.range, env)
    return f"{left}{relation}{lower(item.value, inner)}{over(item.range)}"


def _forces(step: Step, env: Environment) -> str:
    found = [Value(names, value, step.term.range) for names, value in step.values]
    tag = rf" \tag{{{step.numbers[0]}}}" if step.numbers else ""
    if len(found) == 1:
        return _equation(found[0], env, " = ") + tag
    return aligned(_equation(item, env, " &= ") for item in found) + tag


def _constants(explanation: Explanation, env: Environment) -> Iterator[str]:
    for group, terms in constants(explanation).items():
        of = ", ".join(str(env.symbols.get(name, word(name))) for name in terms)
        shown = r", \; ".join(_constant(item, env) for item in group)
        yield rf"{of} &: \quad {shown}"


def _constant(item: Constant, env: Environment) -> str:
    if isnan(item.value):
        return rf"{word(item.name)} \text{{ not given}}"
    measured = rf" \, {unit(item.unit)}" if item.unit else ""
    return f"{word(item.name)} = {lower(Number(item.value), env)}{measured}"


def _appended(explanation: Explanation, env: Environment) -> Iterator[str]:
    for step in explanation.steps:
        for rate in step.rates:
            inner = env if rate.range is None else env.inside(rate.range)
            left = one(env.symbols[rate.state].dot, rate.range, env)
            number = rf" && \text{{({step.numbers[1]})}}" if step.numbers else ""
            yield f"{left} &= {lower(rate.value, inner)}{over(rate.range)}{number}"
