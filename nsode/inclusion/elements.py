"""Which set-valued terms are one element: one auxiliary state for each distinct one."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from nsode.diagnostics import Diagnostic, Label
from nsode.expr import Expr, Index, Name, Number, multiply, negate, rebuild
from nsode.inclusion.sharing import Numbering, Scaled
from nsode.ode import Binding, Definition, LinearSolve, Role, SetValuedTerm


class _Identity(NamedTuple):
    """Terms with equal identities are one element."""

    kind: str
    argument: int
    mirrored: bool
    factor: Scaled | None
    first: int | None
    last: int | None


@dataclass(frozen=True, slots=True)
class Elements:
    """The distinct elements; ``aliases`` are the other terms, as multiples of them.

    ``names`` maps the name of every term that a person may write to its element,
    ``renamed`` the provisional names of inline terms to their final ones.
    """

    terms: tuple[SetValuedTerm, ...]
    aliases: tuple[Binding, ...]
    names: Mapping[str, SetValuedTerm]
    renamed: Mapping[str, str]
    notes: tuple[Diagnostic, ...]


def distinct(terms: list[SetValuedTerm], inline: set[str], bindings: Iterable[Binding]) -> Elements:
    """Find the distinct elements; the first written gives the name and the constants.

    dio terms agree up to a positive factor of the gap, which scales the multiplier;
    sgn terms up to any factor of the velocity, of which only the sign counts.
    """
    numbering = Numbering.over(bindings)
    first: dict[_Identity, tuple[SetValuedTerm, float]] = {}
    kept: list[SetValuedTerm] = []
    same: list[tuple[SetValuedTerm, SetValuedTerm, float]] = []
    for term in sorted(terms, key=lambda term: (term.kind, term.span)):  # a factor may hold dio
        identity, scale = _identity(term, numbering)
        known, known_scale = first.setdefault(identity, (term, scale))
        if known is term:
            kept.append(term)
            continue
        ratio = scale / known_scale
        if term.kind == "sgn":
            ratio = math.copysign(1.0, ratio)
        same.append((term, known, ratio))
        for alias in _alias(term, known, ratio, inline):
            numbering.add(alias)
    renamed = _final_names(kept, same, inline)
    aliases: list[Binding] = []
    for term, element, ratio in same:
        if ratio != 1.0 or term.name not in inline:
            aliases.extend(_alias(term, element, ratio, inline))
    names = {renamed.get(term.name, term.name): term for term in kept}
    names |= {renamed.get(term.name, term.name): element for term, element, _ in same}
    final = {name: _renamed_term(term, renamed) for name, term in names.items()}
    return Elements(
        tuple(_renamed_term(term, renamed) for term in kept),
        tuple(rename_binding(alias, renamed) for alias in aliases),
        final,
        renamed,
        tuple(_two_factors(kept, numbering, renamed)),
    )


def _identity(term: SetValuedTerm, numbering: Numbering) -> tuple[_Identity, float]:
    variable = None if term.range is None else term.range.variable
    argument = numbering.vector(term.argument, variable)
    factor = None
    if term.factor is not None:
        indices = {} if variable is None else {variable: ("#", 0)}
        factor = numbering.number(term.factor, indices)
    first, last = (None, None) if term.range is None else term.range[1:]
    mirrored = term.kind == "dio" and argument.scale < 0
    return _Identity(term.kind, argument.id, mirrored, factor, first, last), argument.scale


def _final_names(
    kept: list[SetValuedTerm],
    same: list[tuple[SetValuedTerm, SetValuedTerm, float]],
    inline: set[str],
) -> dict[str, str]:
    """Return the names of inline terms: numbered by kind, in the order of the text."""
    renamed: dict[str, str] = {}
    count = {"dio": 0, "sgn": 0}
    merged = {term.name: element for term, element, ratio in same if ratio == 1.0}
    for term in sorted([*kept, *(term for term, _, _ in same)], key=lambda term: term.span):
        if term.name not in inline:
            continue
        if term.name in merged:
            element = merged[term.name]
            target = renamed.get(element.name, element.multiplier[0].partition(".x")[0])
            renamed |= _components(term, target)
            continue
        count[term.kind] += 1
        renamed |= _components(term, f"{term.kind}{count[term.kind]}")
    return renamed


def _components(term: SetValuedTerm, target: str) -> dict[str, str]:
    names = {term.name: target}
    for multiplier in term.multiplier:
        names[multiplier] = target + multiplier[len(term.name) :]
    return names


def _alias(
    term: SetValuedTerm, element: SetValuedTerm, ratio: float, inline: set[str]
) -> list[Binding]:
    at = None if element.range is None else Index(element.range.variable)
    named = term.name not in inline and f"{term.name}.lambda" not in term.multiplier[0]
    role: Role = "force" if named else "part"
    return [
        Binding(mine, _multiple(Name(theirs, at), ratio), element.range, role, span=term.span)
        for mine, theirs in zip(term.multiplier, element.multiplier, strict=True)
    ]


def _multiple(name: Name, ratio: float) -> Expr:
    if ratio == 1.0:
        return name
    return negate(name) if ratio == -1.0 else multiply(Number(ratio), name)


def _two_factors(
    kept: list[SetValuedTerm], numbering: Numbering, renamed: Mapping[str, str]
) -> list[Diagnostic]:
    seen: dict[tuple[object, ...], SetValuedTerm] = {}
    notes: list[Diagnostic] = []
    for term in kept:
        identity, _ = _identity(term, numbering)
        if term.kind != "sgn":
            continue
        first = seen.setdefault(identity._replace(factor=None), term)
        if first is not term:
            a, b = (renamed.get(one.name, one.name) for one in (first, term))
            notes.append(
                Diagnostic(
                    "NS403",
                    f"`{a}` and `{b}` have one argument and two factors: two auxiliary states",
                    (Label(term.span, "the second factor"), Label(first.span, "the first")),
                    help="add the factors in one term if it is one surface",
                    severity="note",
                )
            )
    return notes


def rename(expr: Expr, names: Mapping[str, str]) -> Expr:
    """Return an expression with names replaced."""
    match expr:
        case Name(id) if id in names:
            return replace(expr, id=names[id])
    return rebuild(expr, lambda part: rename(part, names))


def rename_binding(binding: Binding, names: Mapping[str, str]) -> Binding:
    """Return a binding with names replaced, its own included."""
    name = names.get(binding.name, binding.name)
    return replace(binding, name=name, value=rename(binding.value, names))


def rename_definition(item: Definition, names: Mapping[str, str]) -> Definition:
    """Return a definition with names replaced."""
    match item:
        case Binding():
            return rename_binding(item, names)
        case SetValuedTerm():
            return _renamed_term(item, names)
        case LinearSolve():
            return replace(
                item,
                matrix=tuple(tuple(rename(e, names) for e in row) for row in item.matrix),
                right=tuple(rename(e, names) for e in item.right),
            )


def _renamed_term(term: SetValuedTerm, names: Mapping[str, str]) -> SetValuedTerm:
    return replace(
        term,
        name=names.get(term.name, term.name),
        multiplier=tuple(names.get(name, name) for name in term.multiplier),
        argument=tuple(rename(part, names) for part in term.argument),
        factor=None if term.factor is None else rename(term.factor, names),
    )
