"""A run that starts inside a contact is told of it, by its own start, once."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

import nsode
from nsode.cli.simulate import command
from nsode.diagnostics import Diagnostic, ModelError
from nsode.simulate import Manner, Wish, simulate

BALL = """model ball
parameter floor = 0
input lift = 0
state p = {start}
state v = 0
force N = dio(p - floor - lift)
der(p) = v
der(v) = N - 10
approximate N: K = 1e5, beta = 4e-3, alpha = 2e-3{held}
simulate 0.01 step 1e-4
"""
OUTSIDE = nsode.loads(BALL.format(start=1, held=""))
INSIDE = nsode.loads(BALL.format(start=-0.5, held=""))
STILL = BALL.replace("input lift = 0", "constant lift = 0")
VOIGT = nsode.loads(STILL.format(start=1, held="")).with_law(contact="kelvin_voigt")
HELD = nsode.loads(BALL.format(start=-1e-4, held=", at equilibrium"))


def said(model: nsode.Model, **how: object) -> list[str]:
    told: list[Diagnostic] = []
    simulate(model.inclusion, model.ode, Wish(), manner=Manner(tell=told.append), **how)
    return [d.message.rpartition(" is ")[2] for d in told if d.code == "NS411"]


@pytest.mark.parametrize(
    ("how", "gap"),
    [
        ({"start": {"p": -0.3}}, "-0.3"),
        ({"overrides": {"floor": 1.25}}, "-0.25"),
        ({"signals": {"lift": 3.0}}, "-2"),
        ({"signals": {"lift": lambda t: 2 - t}}, "-1"),
    ],
)
def test_the_gap_is_that_of_the_run(how: dict[str, object], gap: str) -> None:
    assert said(OUTSIDE, **how) == [gap]


@pytest.mark.parametrize(
    ("model", "how"),
    [
        (OUTSIDE, {}),
        (INSIDE, {"start": {"p": 0.0}}),
        (HELD, {}),
        (OUTSIDE, {"start": {"p": -1e-4, "N.e": 1e-4}}),
        (VOIGT, {"start": {"p": -1e-4}}),
        (INSIDE, {"overrides": {"floor": -1.0}}),
    ],
    ids=["free", "moved out", "at equilibrium", "rest", "rest by a law without e", "lowered"],
)
def test_nothing_is_said_where_nothing_is_thrown_out(
    model: nsode.Model, how: dict[str, object]
) -> None:
    assert said(model, **how) == []


def test_strict_refuses_such_a_run() -> None:
    with pytest.raises(ModelError, match="NS411"):
        OUTSIDE.simulate(x0={"p": -0.3}, strict=True)


def test_the_command_line_says_it_once() -> None:
    text = BALL.format(start=-0.5, held="")
    found = CliRunner().invoke(command, ["-"], input=text, standalone_mode=False)
    assert found.output.count("NS411") == 1
