"""Every state, and every element of a family, has exactly one equation."""

from __future__ import annotations

from collections.abc import Sequence

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.ode import Rate, State, element
from nsode.source import Span


def doubled(state: str, span: Span, first: Span) -> ModelError:
    """Return the error for two equations of one state."""
    return ModelError(
        [
            Diagnostic(
                "NS108",
                f"`der({state})` is given twice",
                (Label(span, "again here"), Label(first, "first here")),
                help="every state has exactly one equation: remove one, or add the two right sides",
            )
        ]
    )


def check_coverage(rates: Sequence[Rate], states: Sequence[State]) -> None:
    """Refuse states, and elements of families, without exactly one equation.

    Raises
    ------
    ModelError
        NS107 and NS108, and NS109 for equations of elements that do not exist.
    """
    found: dict[str, list[Rate]] = {}
    for rate in rates:
        found.setdefault(rate.state, []).append(rate)
    problems: list[Diagnostic] = []
    for state in states:
        mine = sorted(found.get(state.name, []), key=lambda r: r.range.first if r.range else 0)
        problems.extend(_uncovered(state, mine))
    if problems:
        raise ModelError(problems)


def _uncovered(state: State, mine: Sequence[Rate]) -> list[Diagnostic]:
    if state.range is None:
        if len(mine) > 1:
            return list(doubled(state.name, mine[1].span, mine[0].span).diagnostics)
        return [] if mine else [_missing(state, state.name)]
    problems: list[Diagnostic] = []
    expected, last = state.range.first, state.range.last
    for rate in mine:
        assert rate.range is not None
        if len(rate.range) == 0:
            continue
        outside = [k for k in rate.range[1:] if not state.range.first <= k <= last]
        if outside:
            problems.append(_outside(state, outside[0], rate))
            return problems
        if rate.range.first < expected:
            name = element(state.name, rate.range.first)
            problems.extend(doubled(name, rate.span, mine[0].span).diagnostics)
        elif rate.range.first > expected:
            problems.append(_missing(state, element(state.name, expected)))
        expected = max(expected, rate.range.last + 1)
    if expected <= last:
        problems.append(_missing(state, element(state.name, expected)))
    return problems


def _outside(state: State, k: int, rate: Rate) -> Diagnostic:
    assert state.range is not None
    return Diagnostic(
        "NS109",
        f"`{element(state.name, k)}` does not exist",
        (
            Label(rate.span, "this equation is for it"),
            Label(state.span, f"goes from {state.range.first} to {state.range.last}"),
        ),
        help="give the equation the range of the state",
    )


def _missing(state: State, element: str) -> Diagnostic:
    return Diagnostic(
        "NS107",
        f"`{element}` has no equation",
        (Label(state.span, "declared here"),),
        help=f"say how it changes: `der({element}) = ...`",
    )
