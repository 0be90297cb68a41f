"""Whether there is each law that a model chooses, and what the model gives it."""

from __future__ import annotations

from collections.abc import Iterator

from nsode.diagnostics import Diagnostic, Label, quoted, suggest
from nsode.ode import Approximation, SetValuedTerm
from nsode.regularizations import LAWS, Constant, law, laws_of


def needed(term: SetValuedTerm) -> tuple[Constant, ...]:
    """Return the constants that the law of a term needs."""
    return law(term.approximation.law).constants(term)


def misfits(term: SetValuedTerm) -> Iterator[Diagnostic]:
    """Yield what is wrong with the law of a term, or else with its settings."""
    name, able = term.approximation.law, laws_of(term.kind)
    if name not in able:
        yield _no_law(term, able)
        return
    yield from _unknown_constants(term)
    if term.kind == "sgn" and term.approximation.at_equilibrium:
        yield _no_equilibrium(term)
    if term.approximation.targets:
        targets = quoted(target for target, _ in term.approximation.targets)
        yield Diagnostic(
            "NS308",
            f"{targets} cannot be turned into constants yet",
            tuple(Label(value.span) for _, value in term.approximation.targets),
            help="give K, beta and, for dio, alpha",
        )


def _no_law(term: SetValuedTerm, able: tuple[str, ...]) -> Diagnostic:
    name, listed = term.approximation.law, quoted(able)
    exists = name in LAWS
    near = None if exists else suggest(name, LAWS)
    return Diagnostic(
        "NS306",
        f"`{name}` cannot stand for `{term.kind}`" if exists else f"there is no law `{name}`",
        (Label(term.approximation.span, f"`{term.name}` is a `{term.kind}`" if exists else ""),),
        help=near or f"the laws for `{term.kind}` are {listed}",
    )


def _no_equilibrium(term: SetValuedTerm) -> Diagnostic:
    return Diagnostic(
        "NS303",
        "`at equilibrium` is for `dio` alone",
        (Label(term.approximation.span, f"`{term.name}` is a `sgn`"),),
        notes=(
            "a contact at rest presses in until it carries its load; a friction at rest "
            "balances whatever pushes, which may be anything up to its factor",
        ),
        help=f"leave it out for `{term.name}`, whose displacement starts at 0",
    )


def _unknown_constants(term: SetValuedTerm) -> Iterator[Diagnostic]:
    approximation = term.approximation
    known = [constant.name for constant in needed(term)]
    listed = quoted(known)
    usual = approximation.law == Approximation().law
    for name, value in approximation.constants:
        if name not in known:
            yield Diagnostic(
                "NS303",
                f"`{term.kind if usual else approximation.law}` has no constant `{name}`",
                (Label(value.span, f"given for `{term.name}`"),),
                notes=(f"its constants are {listed}",),
                help=suggest(name, known),
            )
