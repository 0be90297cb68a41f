"""Differential inclusions of the paper, put together by hand: an oracle for stage 2's use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from nsode.expr import Call, Expr, Name, Number, add, divide, multiply, negate
from nsode.ode import (
    Approximation,
    Binding,
    DifferentialInclusion,
    Parameter,
    Rate,
    SetValuedTerm,
    State,
)
from nsode.source import Source

Text = Expr | str | float


def of(value: Text) -> Expr:
    """Return a name, a number, or the expression itself."""
    match value:
        case str():
            return Name(value)
        case Expr():
            return value
        case _:
            return Number(float(value))


def plus(*terms: Text) -> Expr:
    return add(*map(of, terms))


def minus(left: Text, right: Text) -> Expr:
    return plus(left, negate(of(right)))


def times(*factors: Text) -> Expr:
    first, *others = map(of, factors)
    for factor in others:
        first = multiply(first, factor)
    return first


def over(left: Text, right: Text) -> Expr:
    return divide(of(left), of(right))


def dio(name: str, gap: Text, **constants: float) -> SetValuedTerm:
    return SetValuedTerm(name, "dio", (of(gap),), None, (name,), approximation=law(constants))


def sgn(name: str, factor: Text, *velocity: Text, **constants: float) -> SetValuedTerm:
    multiplier = (name,) if len(velocity) == 1 else (f"{name}.x", f"{name}.y")
    argument = tuple(map(of, velocity))
    chosen = law(constants)
    return SetValuedTerm(name, "sgn", argument, of(factor), multiplier, approximation=chosen)


def law(constants: Mapping[str, float]) -> Approximation:
    return Approximation(constants=tuple((k, Number(v)) for k, v in constants.items()))


def inclusion(
    name: str,
    parameters: Mapping[str, float],
    states: Mapping[str, float],
    bindings: Sequence[Binding | SetValuedTerm],
    rates: Mapping[str, Text],
) -> DifferentialInclusion:
    return DifferentialInclusion(
        name,
        Source(f"{name}.di", ""),
        tuple(State(state, Number(value)) for state, value in states.items()),
        (),
        tuple(Parameter(parameter, (value,)) for parameter, value in parameters.items()),
        tuple(bindings),
        tuple(Rate(state, of(rate)) for state, rate in rates.items()),
        (),
    )


def bouncing_mass(alpha: float = 5e-3, stiffness: float = 1e5, beta: float = 1e-2):
    """(13), (14): a mass that falls on a floor; the constants of Figure 5."""
    return inclusion(
        "bouncing_mass",
        {"M": 1.0, "g": 9.8},
        {"p": 1.0, "v": 0.0},
        [dio("f", "p", K=stiffness, alpha=alpha, beta=beta)],
        {"p": "v", "v": minus(over("f", "M"), "g")},
    )


def sliding_mass(stiffness: float = 5e3, beta: float = 2e-3):
    """(10), (11): a mass under dry friction; the constants of Figure 3."""
    return inclusion(
        "dry_friction",
        {"M": 1.0, "F0": 0.5, "fe": 0.24},
        {"p": 0.0, "v": 0.0},
        [sgn("F", "F0", "v", K=stiffness, beta=beta)],
        {"p": "v", "v": over(minus("fe", "F"), "M")},
    )


def rolling_sphere():
    """(33) without the attitude: contact, planar slip of the lowest point, spin."""
    spin = times(over(2, 5), "M", times("R", "R"))
    constants = {"K": 1e5, "beta": 4e-3}
    return inclusion(
        "rolling_sphere",
        {"M": 1.0, "R": 0.5, "mu": 0.1, "g": 9.8},
        {
            "p.x": 0,
            "p.y": 0,
            "p.z": 1,
            "v.x": 5.5,
            "v.y": 0,
            "v.z": 0,
            "w.x": 0,
            "w.y": 0,
            "w.z": 0,
        },
        [
            Binding("slip.x", minus("v.x", times("R", "w.y"))),
            Binding("slip.y", plus("v.y", times("R", "w.x"))),
            dio("N", minus("p.z", "R"), alpha=2.8e-3, **constants),
            sgn("F", times("mu", "N"), "slip.x", "slip.y", **constants),
        ],
        {
            "p.x": "v.x",
            "p.y": "v.y",
            "p.z": "v.z",
            "v.x": over(negate(of("F.x")), "M"),
            "v.y": over(negate(of("F.y")), "M"),
            "v.z": minus(over("N", "M"), "g"),
            # [0, 0, -R] x [-F.x, -F.y, N]
            "w.x": over(negate(times("R", "F.y")), spin),
            "w.y": over(times("R", "F.x"), spin),
            "w.z": 0.0,
        },
    )


def two_blocks():
    """(38): two blocks, a wall and a conveyor, with the paper's constants."""
    contact = {"K": 5e5, "beta": 2e-3, "alpha": 1.6e-3}
    friction = {"K": 5e5, "beta": 2e-3}
    states = {"x1": 0, "y1": 0.25, "x2": 0.05, "y2": 0, "vx1": 0, "vy1": 0, "vx2": 0, "vy2": 0}
    parameters = {"M1": 0.5, "M2": 1, "Ks": 100, "mu": 0.5, "u": 1, "g": 9.8}
    weight = negate(times("Ks", "y1"))
    return inclusion(
        "two_blocks_conveyor",
        parameters,
        states,
        [
            dio("N1", "x1", **contact),
            dio("N2", minus("x2", "x1"), **contact),
            dio("N3", "y2", **contact),
            sgn("F1", times("mu", "N1"), "vy1", **friction),
            sgn("F2", times("mu", "N2"), minus("vy1", "vy2"), **friction),
            sgn("F3", times("mu", "N3"), plus("vx2", "u"), **friction),
        ],
        {
            "x1": "vx1",
            "y1": "vy1",
            "x2": "vx2",
            "y2": "vy2",
            "vx1": over(minus("N1", "N2"), "M1"),
            "vy1": over(plus(negate(of("F1")), negate(of("F2")), weight), "M1"),
            "vx2": over(minus("N2", "F3"), "M2"),
            "vy2": minus(over(plus("F2", "N3"), "M2"), "g"),
        },
    )


def belt_oscillator():
    """(48): Example III, whose friction falls with the sliding speed."""
    return inclusion(
        "belt_oscillator",
        {"M": 1, "k1": 1, "k2": 1, "F0": 0.2, "V": 1, "u": 1},
        {"p": 1.19149, "w": 0},
        [sgn("F", over("F0", plus("V", Call("abs", (of("w"),)))), "w", K=1e5, beta=0.5)],
        {
            "p": minus("u", "w"),
            "w": over(
                plus(
                    times("k2", Call("^", (of("p"), Number(3.0)))),
                    negate(times("k1", "p")),
                    negate(of("F")),
                ),
                "M",
            ),
        },
    )
