"""Parameters that will never change become numbers, and what they decide is decided."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace

from nsode.diagnostics import Diagnostic, ModelError, suggest
from nsode.evaluate import apply
from nsode.expr import FUNCTIONS, Call, Expr, If, Name, Number, rebuild
from nsode.ode import AugmentedODE, Check, Parameter
from nsode.passes.expressions import map_expressions


def bake(ode: AugmentedODE, names: Collection[str]) -> AugmentedODE:
    """Return the ODE with some parameters as numbers, at the values that they have.

    What then consists of numbers is computed, each operation on its own: nothing is
    reordered, so the results stay equal to the last bit.

    Raises
    ------
    ModelError
        NS101 for a name that is no scalar parameter.
    """
    known = {item.name: item.values[0] for item in ode.parameters if item.range is None}
    for name in names:
        if name not in known:
            message = f"`{name}` is no scalar parameter: only these can be baked"
            hint = suggest(name, known)
            raise ModelError([Diagnostic("NS101", message, help=hint)], ode.source)
    values = {name: known[name] for name in names}
    baked = map_expressions(ode, lambda expr: fold(expr, values))
    parameters = tuple(_settled(p) for p in baked.parameters if p.name not in values)
    checks = tuple(check for check in baked.checks if not _holds(check))
    return replace(baked, parameters=parameters, checks=checks)


def fold(expr: Expr, values: Mapping[str, float]) -> Expr:
    """Return an expression with some names as numbers, and numbers computed."""
    if isinstance(expr, Name) and expr.id in values:
        return Number(values[expr.id], span=expr.span)
    found = rebuild(expr, lambda part: fold(part, values))
    match found:
        case If(condition, then, otherwise) if (truth := decided(condition)) is not None:
            return then if truth else otherwise
        case Call("*", (Number(1.0), other)) | Call("*" | "/", (other, Number(1.0))):
            return other
        case Call(function, args) if not FUNCTIONS[function].boolean:
            numbers = [arg.value for arg in args if isinstance(arg, Number)]
            if len(numbers) == len(args) and math.isfinite(value := apply(function, *numbers)):
                return Number(value, span=expr.span)
    return found


def decided(condition: Expr) -> bool | None:
    """Return whether a condition made of numbers holds; None if it is not made of them."""
    match condition:
        case Call("not", (inner,)):
            truth = decided(inner)
            return None if truth is None else not truth
        case Call("and" | "or" as function, args):
            truths = [decided(arg) for arg in args]
            if (function == "or") in truths:
                return function == "or"
            return None if None in truths else function == "and"
        case Call(function, (Number(a), Number(b))):
            return bool(apply(function, a, b))
    return None


def _settled(parameter: Parameter) -> Parameter:
    """Drop a formula that has become a number."""
    match parameter.formula:
        case Number(value):
            return replace(parameter, values=(value,), formula=None)
    return parameter


def _holds(check: Check) -> bool:
    return decided(check.condition) is True
