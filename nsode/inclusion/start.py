"""What can be said before a run begins, since it rests on parameters alone."""

from __future__ import annotations

from collections.abc import Iterator

from nsode.diagnostics import Diagnostic, Label
from nsode.expr import TIME, Name, names
from nsode.inclusion.elaborate import CONSTANTS
from nsode.inclusion.families import cases
from nsode.inclusion.known import Constants
from nsode.inclusion.symbols import Symbols
from nsode.ode import Binding, Check, DifferentialInclusion


def broken_assumptions(inclusion: DifferentialInclusion) -> Iterator[Diagnostic]:
    """Yield an error for each assumption that the parameters of the model break."""
    bindings = [item for item in inclusion.bindings if isinstance(item, Binding)]
    known = Constants.of(inclusion.parameters, bindings)
    for check in inclusion.checks:
        if check.kind == "assume" and (where := _broken(check, known)) is not None:
            yield Diagnostic(
                "NS307",
                "the parameters of the model break this assumption",
                (Label(check.span, where),),
                help="change the parameters or the assumption",
            )


def _broken(check: Check, known: Constants) -> str | None:
    """Return where an assumption does not hold, None where it does or nobody knows."""
    for condition, axes in cases(check.condition, check.range):
        if not axes and known.of_all([condition]) == [0.0]:
            return "does not hold"
        for variable, first, last in axes:
            for k in range(first, last + 1):
                found = known.of_all([condition], {variable: k})
                if found is None:
                    break
                if found == [0.0]:
                    return f"does not hold for `{variable} = {k}`"
    return None


def moving_starts(inclusion: DifferentialInclusion, symbols: Symbols) -> Iterator[Diagnostic]:
    """Yield an error for each initial value that reads what changes in a run."""
    fixed = _fixed(inclusion)
    for state in inclusion.states:
        for name in names(state.initial):
            if name.id not in fixed:
                yield Diagnostic(
                    "NS111",
                    f"the initial value of `{state.name}` must rest on parameters alone",
                    (Label(name.span, f"this is {_kind(name, symbols)}"),),
                    help="use numbers, parameters, and `let` of these",
                )
                break


def _fixed(inclusion: DifferentialInclusion) -> set[str]:
    """Return the names whose values are known before a run."""
    found = {parameter.name for parameter in inclusion.parameters}
    found |= {f"{term.name}.{constant}" for term in inclusion.terms for constant in CONSTANTS}
    for item in inclusion.bindings:
        if isinstance(item, Binding) and all(name.id in found for name in names(item.value)):
            found.add(item.name)
    return found


def _kind(name: Name, symbols: Symbols) -> str:
    if name.id == TIME:
        return "the time"
    symbol = symbols.known.get(name.id.partition(".")[0].partition("[")[0])
    match symbol and symbol.kind:
        case "input":
            return "an input"
        case "let":
            return "a `let` that changes in a run"
        case str(kind):
            return f"a {kind}"
    return "not known before a run"
