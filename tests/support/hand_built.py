"""Augmented ODEs put together by hand, so that a backend is tested without the front end."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import AugmentedODE, Binding, Check, Output, Parameter, Rate, State
from nsode.source import Source


def num(value: float) -> Number:
    return Number(float(value))


def call(function: str, *args: Expr | float) -> Call:
    return Call(function, tuple(num(a) if isinstance(a, int | float) else a for a in args))


def plus(*terms: Expr | float) -> Call:
    return call("+", *terms)


def minus(a: Expr | float, b: Expr | float) -> Call:
    return call("+", a, call("neg", b))


def ode(name: str = "scene", **parts: Iterable) -> AugmentedODE:
    """An ODE from some of its parts; the rest is empty."""
    empty = dict.fromkeys(
        ("states", "inputs", "parameters", "bindings", "rates", "outputs", "checks"), ()
    )
    made = {key: tuple(value) for key, value in (empty | parts).items()}
    return AugmentedODE(name=name, source=Source(name, ""), **made)


def parameters(**values: float) -> tuple[Parameter, ...]:
    return tuple(Parameter(name, (float(value),)) for name, value in values.items())


def evaluating(values: Mapping[str, Expr], name: str = "scene", **parts: Iterable) -> AugmentedODE:
    """An ODE whose outputs are some expressions."""
    return ode(name, outputs=[Output(key, value) for key, value in values.items()], **parts)


def contact(term: str, over: IndexRange | None = None) -> tuple[Expr, Expr]:
    """The value (25) of a dio term and the rate (24) of its state."""
    at = None if over is None else Index(over.variable)
    e, psi = Name(f"{term}.e", at), Name(f"{term}.psi", at)
    big, alpha, beta = (Name(f"{term}.{constant}") for constant in ("K", "alpha", "beta"))
    pressed = minus(e, call("/", call("*", beta, plus(psi, e)), alpha))
    relax = call("/", call("neg", e), beta)
    follow = call("/", call("neg", plus(psi, e)), alpha)
    return call("*", big, call("max", 0, pressed)), call("max", relax, follow)


def column(n: int) -> AugmentedODE:
    """``n`` balls between floor and ceiling: walls, a family of contacts, sums, a check."""
    i, balls, gaps = Index("i"), IndexRange("i", 1, n), IndexRange("i", 0, n)
    above = If(call("<", i, n), Name("x", Index("i", 1)), Name("L"))
    below = If(call(">", i, 0), Name("x", i), num(0))
    force, rate = contact("N", gaps)
    ordered = call(">=", Name("x", i), Name("x", Index("i", -1)))
    push = minus(Name("N", Index("i", -1)), Name("N", i))
    j = Index("j")
    return ode(
        "column",
        states=[
            State("x", call("*", 0.021, i), balls),
            State("v", num(0), balls),
            State("N.e", call("max", 0, call("neg", Name("N.psi", i))), gaps),
        ],
        parameters=[
            *parameters(L=0.02 * (n + 1), d=0.02, m=0.1, g=9.8),
            Parameter("N.K", (1e5,)), Parameter("N.alpha", (2.8e-3,)), Parameter("N.beta", (4e-3,)),
        ],
        bindings=[
            Binding("N.psi", plus(above, call("neg", below), call("neg", Name("d"))), gaps, "part"),
            Binding("N", force, gaps, "term"),
            Binding("total", Sum(IndexRange("j", 0, n), call("*", Name("N", j), j))),
        ],
        rates=[
            Rate("x", Name("v", i), balls),
            Rate("v", minus(call("/", push, Name("m")), Name("g")), balls),
            Rate("N.e", rate, gaps),
        ],
        outputs=[Output("N", Name("N", i), gaps), Output("total", Name("total"))],
        checks=[Check("assume", call("or", call("==", i, 1), ordered), balls)],
    )  # fmt: skip
