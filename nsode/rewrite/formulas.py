"""Constants that are formulas of parameters and of each other, and their values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.evaluate import evaluate
from nsode.expr import Expr, names
from nsode.inclusion.known import places
from nsode.inclusion.order import loop, order
from nsode.inclusion.review import in_words
from nsode.ode import Parameter
from nsode.rewrite.fixed import Fixed

#: What each constant is, None where nobody says.
Formulas = Mapping[str, Expr | None]


def in_parameters(formulas: Formulas, fixed: Fixed) -> Formulas:
    """Return formulas that read parameters and other constants, seen through lets.

    Raises
    ------
    ModelError
        NS111 for one that changes in a run.
    """
    known = replace(fixed, parameters=fixed.parameters | formulas.keys())
    found: dict[str, Expr | None] = {}
    for name, formula in formulas.items():
        found[name] = known.formula(formula)
        if formula is not None and found[name] is None:
            moving = (read for read in names(formula) if known.formula(read) is None)
            raise refuse(
                "NS111",
                f"the constant `{name}` must rest on parameters alone",
                next(moving, formula).span,
                "this is not made of parameters",
                help="use numbers, parameters, other constants, and short `let` of these",
            )
    return found


def values(formulas: Formulas, parameters: Sequence[Parameter]) -> Mapping[str, float]:
    """Return the value of each constant, NaN where the model gives none.

    Raises
    ------
    ModelError
        NS106 for constants that need each other, NS116 for values that are not finite.
    """
    given = {name: formula for name, formula in formulas.items() if formula is not None}
    reads = {name: [n.id for n in names(formula)] for name, formula in given.items()}
    ordered = order(list(given), reads)
    if len(ordered) < len(given):
        raise _circle(loop(list(given), reads), given)
    own = {place: v for p in parameters for place, v in zip(places(p), p.values, strict=True)}
    found = dict.fromkeys(formulas, math.nan)

    def value(name: str, at: int | None) -> float:
        return found[name] if name in found else own[name, at]

    for name in ordered:
        found[name] = evaluate(given[name], value)
        missing = any(math.isnan(found.get(read, 0.0)) for read in reads[name])
        if math.isinf(found[name]) or (math.isnan(found[name]) and not missing):
            raise refuse(
                "NS116",
                f"the constant `{name}` is {in_words(found[name])}",
                given[name].span,
                help="check the numbers that go into it",
            )
    return found


def _circle(constants: Sequence[str], formulas: Mapping[str, Expr]) -> ModelError:
    path = " -> ".join(f"`{name}`" for name in [*constants[:5], constants[0]])
    labels = tuple(Label(formulas[name].span, f"gives `{name}`") for name in constants[:5])
    message = f"these constants are defined by each other: {path}"
    return ModelError([Diagnostic("NS106", message, labels, help="give one of them a number")])
