"""What a law cannot represent, seen before anything is replaced."""

from __future__ import annotations

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import Expr, names
from nsode.ode import Definition, DifferentialInclusion, SetValuedTerm, defined, expressions
from nsode.regularizations import LAWS


def check_laws(inclusion: DifferentialInclusion) -> None:
    """Refuse gaps that move with an input under laws that read psi', and pulling factors.

    Raises
    ------
    ModelError
        NS306 with every term that is affected.
    """
    definitions = {name: item for item in inclusion.bindings for name in defined(item)}
    inputs = {entry.name for entry in inclusion.inputs}
    pulling = {
        name: term
        for term in inclusion.terms
        if LAWS[term.approximation.law].pulls
        for name in term.multiplier
    }
    problems: list[Diagnostic] = []
    for term in inclusion.terms:
        if LAWS[term.approximation.law].reads_velocity:
            reached = _reached(term.argument[0], definitions)
            problems.extend(_moved(term, name) for name in sorted(reached & inputs))
        if pulling and term.factor is not None:
            reached = _reached(term.factor, definitions)
            problems.extend(
                _negative(term, contact) for name, contact in pulling.items() if name in reached
            )
    if problems:
        raise ModelError(problems, inclusion.source)


def _reached(expr: Expr, definitions: dict[str, Definition]) -> set[str]:
    """Return the names that an expression reads, through definitions but not through terms."""
    found: set[str] = set()
    waiting = [name.id for name in names(expr)]
    while waiting:
        name = waiting.pop()
        item = definitions.get(name)
        if name not in found and item is not None and not isinstance(item, SetValuedTerm):
            waiting.extend(read.id for part in expressions(item) for read in names(part))
        found.add(name)
    return found


def _moved(term: SetValuedTerm, name: str) -> Diagnostic:
    return Diagnostic(
        "NS306",
        f"`{term.approximation.law}` cannot stand for `{term.name}`",
        (Label(term.span, f"this gap moves with the input `{name}`"),),
        notes=("the law needs the velocity of the gap; the rate of an input is not known",),
        help=f"make `{name}` a state whose rate is the input, or choose `xiong2013`",
    )


def _negative(term: SetValuedTerm, contact: SetValuedTerm) -> Diagnostic:
    law = contact.approximation.law
    return Diagnostic(
        "NS306",
        f"`{law}` cannot stand for `{contact.name}`",
        (
            Label(contact.span, f"`{law}` may pull"),
            Label(term.span, "and the factor of this term would be negative"),
        ),
        notes=("that the factor is nonnegative was proved from a contact that never pulls",),
        help=f"choose a law for `{contact.name}` that never pulls",
    )
