"""Expressions as short text, and rates of a model by name: what tests of stages 2 and 3 read."""

from __future__ import annotations

from collections.abc import Mapping

import nsode
from nsode.diagnostics import ModelError
from nsode.expr import Call, Expr, If, Index, Name, Number, Sum
from nsode.inclusion.build import build
from nsode.ode import AugmentedODE, LinearSolve, SetValuedTerm, element_names, size
from nsode.rewrite import rewrite
from nsode.rewrite.start import at_start
from nsode.source import Source
from nsode.syntax import parse
from support.running import Tracer


def text(expr: Expr) -> str:
    """Return an expression with every operation in parentheses."""
    match expr:
        case Number(value):
            return f"{value:g}"
        case Index(variable, offset):
            if variable is None:
                return str(offset)
            return f"{variable}{offset:+d}" if offset else variable
        case Name(id, at):
            return id if at is None else f"{id}[{text(at)}]"
        case Call("neg", (inner,)):
            return f"-{text(inner)}"
        case Call(function, args) if not function.isalpha():
            return "(" + f" {function} ".join(map(text, args)) + ")"
        case Call(function, args):
            return f"{function}({', '.join(map(text, args))})"
        case If(condition, then, otherwise):
            return f"(if {text(condition)} then {text(then)} else {text(otherwise)})"
        case Sum(over, body):
            return f"sum({over.variable} in {over.first}..{over.last}: {text(body)})"
    raise NotImplementedError(type(expr).__name__)


def compiled(*lines: str) -> nsode.Model:
    """Return the model of some lines."""
    return nsode.loads("model test\n" + "\n".join(lines) + "\n")


def built(*lines: str) -> AugmentedODE:
    """Return the ODE of some lines without the remarks of the analysis."""
    source = Source("test", "model test\n" + "\n".join(lines) + "\n")
    ode = rewrite(build(parse(source))[0])
    at_start(ode)
    return ode


def refused(*lines: str) -> list[str]:
    """Return the codes of the errors that some lines get, in the order of the text."""
    try:
        built(*lines)
    except ModelError as error:
        return [d.code for d in error.diagnostics if d.severity == "error"]
    return []


def remarks(*lines: str) -> list[str]:
    """Return the codes of the warnings and notes that some lines get."""
    return [d.code for d in compiled(*lines).diagnostics]


def term(model: nsode.Model, name: str) -> SetValuedTerm:
    return next(term for term in model.inclusion.terms if term.name == name)


def binding(model: nsode.Model, name: str) -> str:
    """Return the value of a binding of the inclusion as text."""
    return next(
        text(item.value)
        for item in model.inclusion.bindings
        if not isinstance(item, SetValuedTerm | LinearSolve) and item.name == name
    )


def rate(model: nsode.Model, state: str) -> str:
    """Return the rate of a state of the inclusion as text."""
    return next(text(rate.value) for rate in model.inclusion.rates if rate.state == state)


def states(model: nsode.Model) -> list[str]:
    return element_names(model.ode.states)


def rates(
    model: nsode.Model | AugmentedODE,
    at: Mapping[str, float],
    p: Mapping[str, float] | None = None,
    t: float = 0.0,
) -> dict[str, float]:
    """Return the rate of every state, where states are 0 unless given."""
    ode = model.ode if isinstance(model, nsode.Model) else model
    names = element_names(ode.states)
    given = {**dict.fromkeys(names, 0.0), **at}
    unknown = set(given) - set(names)
    assert not unknown, unknown
    inputs = [i.default for i in ode.inputs for _ in range(size(i))]
    x = [given[name] for name in names]
    found, _ = Tracer(ode, t, x, inputs, parameters(ode, p or {})).rhs()
    return dict(zip(names, found.tolist(), strict=True))


def parameters(ode: AugmentedODE, given: Mapping[str, float]) -> list[float]:
    """Return p0 with some values given."""
    values = dict(
        zip(
            element_names(ode.parameters),
            (v for p in ode.parameters for v in p.values),
            strict=True,
        )
    )
    assert not set(given) - set(values)
    return list({**values, **given}.values())
