"""Families: what an index may do, and that a family is its elements written out."""

from __future__ import annotations

import os
import random

import numpy as np
import pytest

import nsode
from nsode.ode import IndexRange, element_names
from support.modules import load_module
from support.reading import binding, compiled, parameters, rates, refused, states
from support.running import Tracer
from support.twins import Twins

SEEDS = int(os.environ.get("NSODE_SEEDS", "40"))


@pytest.mark.parametrize("seed", range(SEEDS))
def test_a_family_is_its_elements_written_out(seed: int) -> None:
    twins = Twins(seed)
    family, elements = (nsode.loads(text).ode for text in twins.texts)
    names = [twins.name(name) for name in element_names(family.states)]
    assert sorted(names) == sorted(element_names(elements.states))
    place = {name: k for k, name in enumerate(element_names(elements.states))}
    pick = random.Random(seed)
    for _ in range(4):
        x = [pick.uniform(-0.05, 0.05) for _ in names]
        other = [0.0] * len(x)
        for name, value in zip(names, x, strict=True):
            other[place[name]] = value
        t = pick.uniform(0, 2)
        found, scale = Tracer(family, t, x, [], parameters(family, {})).rhs()
        wanted, _ = Tracer(elements, t, other, [], parameters(elements, {})).rhs()
        wanted = wanted[[place[name] for name in names]]
        assert np.all(np.abs(found - wanted) <= 1e-15 * scale)


@pytest.mark.parametrize("seed", range(8))
def test_the_numpy_module_of_a_family_computes_its_elements(seed: int) -> None:
    twins = Twins(1000 + seed)
    family, elements = (nsode.loads(text).ode for text in twins.texts)
    names = [twins.name(name) for name in element_names(family.states)]
    place = {name: k for k, name in enumerate(element_names(elements.states))}
    code = load_module(family)
    x = np.random.default_rng(seed).uniform(-0.05, 0.05, len(names))
    other = np.zeros(len(names))
    other[[place[name] for name in names]] = x
    found = code.rhs(0.5, x, code.u0, code.p0)
    tracer = Tracer(elements, 0.5, other, [], parameters(elements, {}))
    wanted, scale = (part[[place[name] for name in names]] for part in tracer.rhs())
    assert np.all(np.abs(found - wanted) <= 4 * np.finfo(float).eps * scale)


CHAIN = ("constant n = 3", "state x[i in 1..n] = 0.1*i", "state v = 0", "der(v) = 0")
EACH = "for i in 1..n: der(x[i]) = "


@pytest.mark.parametrize(
    ("lines", "x2"),
    [
        (["parameter k[i in 1..n] = 2*i", EACH + "k[i]"], 4),
        (["parameter k[i in 1..n] = [5, 6, 7]", EACH + "k[i]"], 6),
        (["let k[i in 1..n] = [5, 6, 7]", EACH + "k[i]"], 6),
        (["let side[i in 1..2] = [-1, 1]", EACH + "side[2]*i"], 2),
        (["let k[i in 1..n] = i^2", EACH + "k[i]"], 4),
        (["input u[i in 1..n] = 7", EACH + "u[i]"], 7),
        ([EACH + "sum(j in 1..n: j*i)"], 12),
        ([EACH + "sum(j in 1..0: 1)"], 0),
        ([EACH + "(if i < n then x[i+1] else 9) - (if i > 1 then x[i-1] else 9)"], 0.3 - 0.1),
        ([EACH + "if i == 2 then 5 else x[i]"], 5),
        ([EACH + "x[n-1] + x[1]"], 0.3),
        (["for i in 0..n-1: der(x[i+1]) = i"], 1),
        (["der(x[1]) = 1", "der(x[2]) = 2", "der(x[n]) = 3"], 2),
        (["der(x[1]) = 0", "for k in 2..n-1: der(x[k]) = k", "der(x[n]) = 0"], 2),
        (["let w[i in 1..n] = sum(j in 1..n: x[j]*x[i])", EACH + "w[i]"], 0.6 * 0.2),
    ],
)
def test_an_element_has_the_value_of_its_formula(lines: list[str], x2: float) -> None:
    model = compiled(*CHAIN, *lines)
    start = {"x[1]": 0.1, "x[2]": 0.2, "x[3]": 0.3}
    assert rates(model, start)["x[2]"] == pytest.approx(x2, rel=1e-15)


def test_vector_families_have_components_and_lists_of_vectors() -> None:
    model = compiled(
        "constant n = 2",
        "state p[i in 1..n][2] = [[1, 2], [3, 4]]",
        "let q[i in 1..n] = [p[i].y, 2*p[i].x]",
        "for i in 1..n: der(p[i]) = q[i] + (if i > 1 then p[i-1] else [0, 0])",
    )
    assert states(model) == ["p[1].x", "p[2].x", "p[1].y", "p[2].y"]
    assert model.x0.tolist() == [1, 3, 2, 4]
    found = rates(model, dict(zip(states(model), model.x0, strict=True)))
    assert found == {"p[1].x": 2, "p[2].x": 4 + 1, "p[1].y": 2, "p[2].y": 6 + 2}


def test_an_element_of_a_family_has_its_index_before_its_component() -> None:
    model = compiled(
        "state q[i in 1..2][4] = [1, 0, 0, 10*i]",
        "state R[i in 1..2][2][2] = [[1, 2*i], [3, 4]]",
        "for i in 1..2: der(q[i]) = q[i]",
        "for i in 1..2: der(R[i]) = R[i]",
    )
    start = dict(zip(states(model), model.x0, strict=True))
    assert (start["q[1][4]"], start["q[2][4]"], start["q[2][1]"]) == (10, 20, 1)
    assert (start["R[2][1][2]"], start["R[1][1][2]"], start["R[2][2][1]"]) == (4, 2, 3)


def test_a_formula_that_reads_the_index_is_no_list() -> None:
    lines = (
        "state p[i in 1..3][3] = [i, 0, 0]",
        "let d[i in 1..3] = p[i] - [0, 0, 1]",
        "for i in 1..3: der(p[i]) = d[i]",
    )
    model = compiled(*lines)
    assert binding(model, "d.z") == "(p.z[i] + -1)"


def test_an_output_takes_a_list_or_a_formula() -> None:
    model = compiled(*CHAIN, EACH + "1", "output y[i in 1..2] = [v, 3*v]", "output z[2] = [v, 2]")
    assert element_names(model.ode.outputs)[:4] == ["y[1]", "y[2]", "z.x", "z.y"]
    assert refused(*CHAIN, EACH + "1", "output z[3] = [v, 2]") == ["NS105"]


def test_an_empty_range_is_empty() -> None:
    model = compiled(
        "constant n = 0",
        "state x[i in 1..n] = 0",
        "state v = 1",
        "force N[i in 1..n] = dio(x[i])",
        "for i in 1..n: der(x[i]) = N[i]",
        "der(v) = 2 + sum(i in 1..n: N[i])",
    )
    assert states(model) == ["v"]
    assert rates(model, {"v": 1})["v"] == 2


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        ([], "NS107"),
        (["for i in 1..n-1: der(x[i]) = 1"], "NS107"),
        (["for i in 2..n: der(x[i]) = 1"], "NS107"),
        (["der(x[1]) = 1", "der(x[3]) = 1"], "NS107"),
        ([EACH + "1", "der(x[2]) = 1"], "NS108"),
        ([EACH + "1", EACH + "2"], "NS108"),
        ([EACH + "1", "for i in 1..n: der(v) = 1"], "NS108"),
        (["for i in 1..n: der(x[1]) = i"], "NS108"),
        (["for i in 1..n+1: der(x[i]) = 1"], "NS109"),
        (["for i in 0..n: der(x[i]) = 1"], "NS109"),
        ([EACH + "1", "der(x[4]) = 1"], "NS109"),
        ([EACH + "x[i+1]"], "NS109"),
        ([EACH + "x[i-1]"], "NS109"),
        ([EACH + "if i > 1 then x[i-2] else 0"], "NS109"),
        ([EACH + "x[0]"], "NS109"),
        ([EACH + "x[2*i]"], "NS109"),
        ([EACH + "x[n-i]"], "NS109"),
        ([EACH + "x[1.5]"], "NS109"),
        ([EACH + "x[v]"], "NS109"),
        ([EACH + "v[i]"], "NS109"),
        ([EACH + "1", "output y = x[4]"], "NS109"),
        ([EACH + "1", "assume x[4] > 0"], "NS109"),
        ([EACH + "1", "for i in 1..n: assume x[i+1] > 0"], "NS109"),
        ([EACH + "sum(j in 1..n: x[j+1])"], "NS109"),
        ([EACH + "x"], "NS105"),
        ([EACH + "sum(j in 1..i: x[j])"], "NS111"),
        ([EACH + "x[k]"], "NS101"),
        (["for v in 1..n: der(x[v]) = 1"], "NS102"),
        ([EACH + "sum(i in 1..n: x[i])"], "NS102"),
        (["parameter k[i in 1..n] = [1, 2]", EACH + "k[i]"], "NS105"),
        (["parameter k[i in 0..n] = 1/i", EACH + "k[i]"], "NS116"),
        (["input k[i in 1..n] = i", EACH + "k[i]"], "NS111"),
        (["constant m = 3/2", EACH + "x[m]"], "NS111"),
        ([EACH + "1", "state big[i in 1..1e15] = 0"], "NS014"),
        ([EACH + "1", "state big[i in 1..1e300] = 0"], "NS111"),
    ],
)
def test_what_an_index_may_not_do_is_refused(lines: list[str], code: str) -> None:
    drop = [line for line in CHAIN if not (line == "der(v) = 0" and "der(v)" in "".join(lines))]
    assert refused(*drop, *lines) == [code]


def test_constants_may_come_in_any_order() -> None:
    lines = ("constant n = 2*m", "constant m = k - 1", "constant k = 3")
    model = compiled(*lines, "state x[i in 1..n] = 0", EACH + "1")
    assert len(states(model)) == 4


def test_the_range_survives_to_the_ode() -> None:
    model = compiled(*CHAIN, "force N[i in 1..n] = dio(x[i] - 0.1*i)", EACH + "N[i]")
    ranges = {item.name: item.range for item in model.ode.states}
    assert ranges["x"] == ranges["N.e"] == IndexRange("i", 1, 3)


def test_a_large_family_is_no_more_work_than_a_small_one() -> None:
    def items(n: int) -> int:
        model = compiled(
            f"constant n = {n}",
            "state x[i in 1..n] = 0.02*i",
            "state v[i in 1..n] = 0",
            "force N[i in 0..n] = dio((if i < n then x[i+1] else 0.02*(n+1))"
            " - (if i > 0 then x[i] else 0) - 0.01)",
            "for i in 1..n: der(x[i]) = v[i]",
            "for i in 1..n: der(v[i]) = N[i-1] - N[i]",
        )
        return len(model.ode.bindings) + len(model.ode.rates) + len(model.ode.checks)

    assert items(10_000) == items(10)
