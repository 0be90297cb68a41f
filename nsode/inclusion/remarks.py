"""What is no error and yet worth saying."""

from __future__ import annotations

from collections.abc import Iterator

from nsode.diagnostics import Diagnostic, Label
from nsode.expr import Call, names
from nsode.inclusion.symbols import Symbols
from nsode.ode import DifferentialInclusion


def unused_names(symbols: Symbols) -> Iterator[Diagnostic]:
    """Warn of names that nothing reads."""
    for symbol in symbols.known.values():
        if (
            symbol.kind in {"parameter", "constant", "input", "let"}
            and symbol.name not in symbols.used
        ):
            yield Diagnostic(
                "NS401",
                f"the {symbol.kind} `{symbol.name}` is not used",
                (Label(symbol.span, "never read"),),
                help="remove it, or use it",
                severity="warning",
            )


def divided_factors(inclusion: DifferentialInclusion) -> Iterator[Diagnostic]:
    """Note factors divided by a parameter, which may be a mass."""
    parameters = {parameter.name for parameter in inclusion.parameters}
    for term in inclusion.terms:
        match term.factor:
            case Call("/", (_, divisor)) if all(name.id in parameters for name in names(divisor)):
                yield Diagnostic(
                    "NS405",
                    f"the factor of `{term.name}` holds a division: its K is per divisor",
                    (Label(divisor.span, "divides the factor"),),
                    help="if F is the force, divide behind the term: `F*sgn(v)/M`",
                    severity="note",
                )
