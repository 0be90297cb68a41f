"""Each limit has a message of its own, whose flag raises it; nothing breaks where it leads."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pytest

import nsode
from nsode.cli import run
from nsode.diagnostics import ModelError
from nsode.limits import DEEPEST, MOST, Limits
from nsode.ode import Run
from nsode.simulate.settings import Wish, settle
from support.native import build

DECAY = "model m\nstate x = 1\nder(x) = -x\n"
SLIDER = "model m\nstate v = 1\nforce F = 0.5*sgn(v)\nder(v) = -F\n"
ONES = ", ".join("1" * 16)


def decay(rate: str) -> str:
    return f"model m\nparameter a = 1.5\nstate x = 0.7\nder(x) = {rate}\n"


def compiling(text: str) -> Callable[[Limits], object]:
    return lambda limits: nsode.loads(text, limits=limits)


def settling(wish: Wish) -> Callable[[Limits], object]:
    return lambda limits: settle(wish, Run(), 10, limits)


#: The usual limits, but for one that only a large model breaks.
USUAL = Limits(analysis=1)
#: By the name of a limit: its code, and what breaks it.
BROKEN: dict[str, tuple[str, Callable[[Limits], object]]] = {
    "size": ("NS012", compiling(DECAY + "#" * USUAL.size)),
    "name": ("NS010", compiling(DECAY.replace("x", "x" * 65))),
    "depth": ("NS011", compiling(decay("*".join("x" * 80)))),
    "operations": (
        "NS011",
        compiling(f"model m\nstate x[16] = [{ONES}]\nder(x) = x*norm(x{' + x' * 300})\n"),
    ),
    "exponent": ("NS013", compiling(decay("-x^99"))),
    "elements": ("NS014", compiling(decay("-sum(i in 1..1001: sum(k in 1..1001: x))"))),
    "sums": (
        "NS011",
        compiling(decay("-sum(i in 1..2: sum(j in 1..2: sum(k in 1..2: sum(l in 1..2: x))))")),
    ),
    "vector": ("NS014", compiling(f"model m\nstate x[17] = [{ONES}, 1]\nder(x) = -x\n")),
    "analysis": ("NS014", lambda limits: nsode.loads(SLIDER, limits=limits).analyze()),
    "steps": ("NS502", settling(Wish(2e9, 1.0, every=10**6))),
    "memory": ("NS502", settling(Wish(1e8, 1.0))),
    "errors": ("NS101", compiling(DECAY + "".join(f"let a{k} = b\n" for k in range(30)))),
}


def refusal(act: Callable[[Limits], object], limits: Limits) -> ModelError:
    with pytest.raises(ModelError) as caught:
        act(limits)
    return caught.value


def flags(error: ModelError) -> dict[str, int]:
    """Return the limits that a message offers to raise."""
    told = " ".join([*(str(d.help) for d in error.diagnostics), *error.diagnostics[-1].notes])
    return {name: int(value) for name, value in re.findall(r"`--limit (\w+)=(\d+)`", told)}


def test_every_limit_is_tried_here():
    assert list(BROKEN) == [field.name for field in fields(Limits)]


@pytest.mark.parametrize("name", BROKEN)
def test_the_message_of_a_limit_names_the_flag_that_raises_it(name):
    code, act = BROKEN[name]
    error = refusal(act, USUAL)
    assert {d.code for d in error.diagnostics} == {code}
    assert list(flags(error)) == [name]


@pytest.mark.parametrize("name", BROKEN.keys() - {"errors"})
def test_the_flag_that_is_offered_lets_the_model_pass(name):
    _, act = BROKEN[name]
    act(Limits.of(flags(refusal(act, USUAL))))


@pytest.mark.parametrize("line", ["let = 1\n", "output a = b\n"], ids=["syntax", "names"])
def test_a_flood_of_errors_is_cut_and_none_is_lost(line):
    act = compiling(DECAY + line * 50)
    shown = refusal(act, USUAL)
    assert len(shown.diagnostics) == 20
    (note,) = shown.diagnostics[-1].notes
    total = flags(shown)["errors"]
    assert note.startswith(f"{total - 20} further errors are not shown")
    assert len(refusal(act, Limits.of(flags(shown))).diagnostics) == total


# depth, which cannot be raised for ever


def test_at_the_greatest_depth_no_flag_is_offered():
    error = refusal(compiling(decay("(" * 120 + "x" + ")" * 120)), Limits(depth=DEEPEST))
    assert flags(error) == {}
    assert "nested 120 levels deep, and 100 are the limit" in str(error)
    assert str(error).endswith("name an intermediate result with `let`")


#: Two limits broken at once.
TWICE = f"model m\nparameter {'k' * 70} = 1\nstate x = 0.5\nder(x) = -{'*'.join('x' * 70)}\n"


def below(frames: int, act: Callable[[], None]) -> None:
    """Act with so many frames on the stack, as in a notebook or a web server."""
    if frames:
        below(frames - 1, act)
    else:
        act()


@pytest.mark.parametrize(
    "nest", ["max({}, x)", "abs({})", "max(min({}, a), x)", "atan2({}, a)"], ids=lambda n: n[:6]
)
def test_every_stage_manages_the_greatest_depth(nest, tmp_path):
    inner = "x"
    for _ in range((DEEPEST - 3) // nest.count("(")):
        inner = nest.format(inner)
    text = decay(f"-({inner})")

    def work() -> None:
        model = nsode.loads(text, limits=Limits(depth=DEEPEST))
        code = build(model.ode, tmp_path)
        expected = code.rhs(0.0, model.x0)
        assert np.isfinite(expected).all()
        scope: dict = {}
        exec(*model.emit("numpy").values(), scope)
        assert scope["rhs"](0.0, model.x0) == pytest.approx(expected, rel=1e-14)
        assert float(model.casadi().rhs(0.0, model.x0, [], model.p0)) == pytest.approx(*expected)
        model.sympy()
        model.analyze()
        model.explain().markdown()
        model.baked({"a": 2.0}).emit("c")

    below(200, work)


# how limits are given


@pytest.mark.parametrize(
    "values",
    [{"depth": 0}, {"depth": DEEPEST + 1}, {"elements": MOST + 1}, {"name": -1}, {"nme": 1}],
)
def test_a_limit_that_there_is_not_is_refused(values):
    with pytest.raises(ValueError, match="limit"):
        Limits.of(values)


@pytest.mark.parametrize("command", ["check", "compile", "simulate", "analyze", "explain"])
def test_each_command_that_reads_a_model_takes_limits(command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "m.di"
    path.write_text(TWICE + "simulate 1 step 0.1\n")
    assert run([command, str(path)]) == 1
    told = capsys.readouterr().err
    offered = re.findall(r"--limit \w+=\d+", told)
    assert len(offered) == 2
    assert run([command, str(path), *" ".join(offered).split()]) == 0


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("depth=101", "at most 100"),
        ("depth=0", "at least 1"),
        ("dept=70", "no limit `dept`: choose from size, name, depth"),
        ("depth", "`depth` is not NAME=NUMBER"),
        ("depth=inf", "`depth=inf` is not NAME=NUMBER"),
    ],
)
def test_a_limit_that_makes_no_sense_is_told(given, told, capsys):
    assert run(["check", "-", "--limit", given]) == 2
    assert told in capsys.readouterr().err
