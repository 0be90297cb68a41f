"""What is known before a run begins, since it rests on parameters alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from nsode.diagnostics import Diagnostic, Label
from nsode.evaluate import evaluate
from nsode.expr import TIME, Expr, Index, Name, Sum, names, walk
from nsode.inclusion.elaborate import CONSTANTS
from nsode.inclusion.order import deepest_first
from nsode.inclusion.symbols import Symbols
from nsode.ode import Binding, DifferentialInclusion, Parameter


@dataclass(slots=True)
class Constants:
    """Values of scalars that rest on parameters alone, through lets."""

    bindings: Mapping[str, Binding]
    values: dict[str, float | None]

    @classmethod
    def of(cls, parameters: Sequence[Parameter], bindings: Sequence[Binding]) -> Constants:
        """Return what is known of a model before a run."""
        values = {p.name: p.values[0] if p.range is None else None for p in parameters}
        return cls({b.name: b for b in bindings if b.range is None}, values)

    def of_all(self, exprs: Sequence[Expr]) -> list[float] | None:
        """Return the values of expressions, None unless all are constant."""
        for name in deepest_first(self._bound(exprs), self._below, self.values):
            self.values[name] = self._value(self.bindings[name].value)
        found = [self._value(expr) for expr in exprs]
        return None if None in found else [value for value in found if value is not None]

    def _bound(self, exprs: Sequence[Expr]) -> Iterator[str]:
        return (n.id for expr in exprs for n in names(expr) if n.id in self.bindings)

    def _below(self, name: str) -> Iterator[str]:
        return self._bound([self.bindings[name].value])

    def _value(self, expr: Expr) -> float | None:
        for node in walk(expr):
            if isinstance(node, Index | Sum) or (
                isinstance(node, Name) and self.values.get(node.id) is None
            ):
                return None
        return evaluate(expr, lambda name, at: self.values[name] or 0.0)


def broken_assumptions(inclusion: DifferentialInclusion) -> Iterator[Diagnostic]:
    """Yield an error for each assumption that the parameters of the model break."""
    bindings = [item for item in inclusion.bindings if isinstance(item, Binding)]
    known = Constants.of(inclusion.parameters, bindings)
    for check in inclusion.checks:
        if check.kind == "assume" and known.of_all([check.condition]) == [0.0]:
            yield Diagnostic(
                "NS307",
                "the parameters of the model break this assumption",
                (Label(check.span, "does not hold"),),
                help="change the parameters or the assumption",
            )


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
