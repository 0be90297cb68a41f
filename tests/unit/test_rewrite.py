"""Stage 3 is Section 4.4: dio, then sgn with its factor, then the auxiliary states."""

from __future__ import annotations

import math

import pytest

from nsode.expr import Name
from nsode.ode import Binding, element_names
from support.reading import compiled, rates, refused, states, text

HEAD = (
    "parameter mu = 0.5",
    "parameter M = 2",
    "state p = 0.1",
    "state v[2] = [1, 0]",
    "der(p) = v.x",
)
SCENE = (
    *HEAD,
    "force F = mu*N*sgn(v)",
    "force N = dio(p)",
    "M*der(v) = [N - F.x, -F.y]",
)
LAWS = (
    "approximate N: K = 1e3, alpha = 2e-3, beta = 4e-3",
    "approximate F: K = 5e2, beta = 3e-3",
)


def value(model: object, name: str) -> str:
    found = next(b for b in model.ode.bindings if isinstance(b, Binding) and b.name == name)
    return text(found.value)


def test_auxiliary_states_stand_last_first_those_of_dio() -> None:
    assert states(compiled(*SCENE, *LAWS)) == ["p", "v.x", "v.y", "N.e", "F.a.x", "F.a.y"]


def test_constants_are_parameters_behind_the_model_s_own() -> None:
    model = compiled(*SCENE, *LAWS)
    names = element_names(model.ode.parameters)
    assert names == ["mu", "M", "N.K", "N.alpha", "N.beta", "F.K", "F.beta"]
    assert model.p0.tolist() == [0.5, 2, 1e3, 2e-3, 4e-3, 5e2, 3e-3]


def test_dio_becomes_24_and_25() -> None:
    model = compiled(*SCENE, *LAWS)
    assert value(model, "N.psi") == "p"
    assert value(model, "N") == "(N.K * max(0, (N.e + -((N.beta * (N.psi + N.e)) / N.alpha))))"
    [state] = [a for a in model.ode.auxiliary if a.name == "N.e"]
    assert text(state.rate) == "max((-N.e / N.beta), (-(N.psi + N.e) / N.alpha))"
    assert (state.term, state.replaces) == ("N", "dio(p)")


def test_sgn_becomes_18_with_the_force_of_dio_in_its_factor() -> None:
    model = compiled(*SCENE, *LAWS)
    assert value(model, "F.Z") == "((mu * N) / F.K)"
    assert value(model, "F.z.y") == "(F.a.y + (F.beta * v.y))"
    assert value(model, "F.shrink") == "shrink(F.Z, norm(F.z.x, F.z.y))"
    assert value(model, "F.x") == "(F.K * F.s.x)"
    [state] = [a for a in model.ode.auxiliary if a.name == "F.a.y"]
    assert text(state.rate) == "((F.s.y + -F.a.y) / F.beta)"
    assert state.replaces == "mu*N*sgn(v)"


def test_each_binding_reads_only_what_stands_before_it() -> None:
    model = compiled(*SCENE, *LAWS)
    known = {item.name for item in (*model.ode.states, *model.ode.parameters)}
    for item in model.ode.bindings:
        stack = [item.value]
        while stack:
            node = stack.pop()
            assert not isinstance(node, Name) or node.id in known
            stack.extend(getattr(node, "args", ()))
        known.add(item.name)


@pytest.mark.parametrize(("p", "e", "v"), [(-1e-3, 2e-4, 0.3), (1e-3, 5e-4, -0.2), (0.1, 0, 0)])
def test_the_numbers_are_those_of_the_paper(p: float, e: float, v: float) -> None:
    K, alpha, beta, Kf, bf = 1e3, 2e-3, 4e-3, 5e2, 3e-3
    a = 1e-4
    found = rates(compiled(*SCENE, *LAWS), {"p": p, "v.x": v, "N.e": e, "F.a.x": a})
    N = K * max(0.0, e - beta * (p + e) / alpha)
    Z, z = 0.5 * N / Kf, a + bf * v
    s = z if abs(z) <= Z else math.copysign(Z, z)
    assert found["v.x"] == pytest.approx((N - Kf * s) / 2, rel=1e-13)
    assert found["N.e"] == pytest.approx(max(-e / beta, -(p + e) / alpha), rel=1e-13)
    assert found["F.a.x"] == pytest.approx((s - a) / bf, rel=1e-13)


def test_every_force_is_an_output_behind_the_declared_ones() -> None:
    model = compiled(*SCENE, *LAWS, "output depth = max(0, -p)")
    assert element_names(model.ode.outputs) == ["depth", "F.x", "F.y", "N"]


def test_a_start_at_equilibrium_holds_the_load() -> None:
    laws = ("approximate N: K = 1e3, alpha = 2e-3, beta = 4e-3, at equilibrium", LAWS[1])
    pressed = [line.replace("p = 0.1", "p = -0.01") for line in SCENE]
    assert compiled(*pressed, *laws).x0.tolist() == [-0.01, 1, 0, 0.01, 0, 0]
    assert compiled(*SCENE, *laws).x0.tolist()[3] == 0
    assert compiled(*pressed, *LAWS).x0.tolist()[3] == 0


def test_lists_and_defaults_give_constants_and_what_is_said_of_one_wins() -> None:
    dio, sgn = "alpha = 1, beta = 2", "beta = 3"
    model = compiled(
        "state x = 1",
        "force A = dio(x)",
        "force B = dio(x - 1)",
        "force C = dio(x - 2)",
        "force F = sgn(x)",
        "der(x) = A + B + C - F",
        f"approximate A, B: K = 10, {dio}",
        f"approximate default dio: K = 20, {dio}",
        f"approximate default sgn: K = 30, {sgn}",
    )
    values = dict(zip(element_names(model.ode.parameters), model.p0, strict=True))
    assert [values[f"{name}.K"] for name in "ABCF"] == [10, 10, 20, 30]


def test_constants_are_expressions_of_parameters_and_of_each_other() -> None:
    lines = (
        *SCENE,
        "let stiffness = 100*M",
        "approximate N: beta = 2*0.8/sqrt(N.K/M), K = stiffness, alpha = N.beta/2",
        "approximate F: K = N.K, beta = (if mu > 0.4 then 1 else 2)*N.beta",
    )
    model = compiled(*lines)
    values = dict(zip(element_names(model.ode.parameters), model.p0, strict=True))
    assert values["N.K"] == values["F.K"] == 200
    assert values["N.beta"] == values["F.beta"] == pytest.approx(0.16)
    assert values["N.alpha"] == pytest.approx(0.08)
    heavier = model.with_parameters({"M": 8})
    moved = dict(zip(element_names(heavier.ode.parameters), heavier.p0, strict=True))
    assert moved["F.K"] == 800
    assert moved["N.beta"] == pytest.approx(0.16)


def test_initial_values_may_read_parameters_lets_of_these_and_constants() -> None:
    model = compiled(
        "parameter R = 2",
        "let top = 3*R",
        "state p = top + 9.8/N.K",
        "force N = dio(p)",
        "der(p) = N",
        "approximate N: K = 98, alpha = 1, beta = 1",
    )
    assert model.x0.tolist() == [6.1, 0]


def test_without_constants_a_model_compiles_and_p0_holds_nan() -> None:
    model = compiled(*SCENE, "approximate N: K = 1e3")
    assert math.isnan(model.p0[-1])
    assert math.isnan(model.p0[3])
    assert model.p0[2] == 1e3


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("approximate N: K = 0, alpha = 1, beta = 1", "NS301"),
        ("approximate N: K = 1, alpha = 0, beta = 1", "NS301"),
        ("approximate N: K = 1, alpha = -1, beta = 1", "NS301"),
        ("approximate N: K = 1, alpha = 2, beta = 1", "NS302"),
        ("approximate N: K = 1, alpha = 1, beta = -1 + mu", "NS301"),
        ("approximate N: K = 1, gamma = 1", "NS303"),
        ("approximate F: alpha = 1", "NS303"),
        ("approximate G: K = 1", "NS304"),
        ("approximate p: K = 1", "NS304"),
        ("approximate N, N: K = 1", "NS305"),
        ("approximate N with lugree: K = 1", "NS306"),
        ("approximate N with lugre: K = 1", "NS306"),
        ("approximate N: K = p", "NS111"),
        ("approximate N: K = t", "NS111"),
        ("approximate N: K = F.x", "NS111"),
        ("approximate N: K = N.K", "NS106"),
        ("approximate N: K = 1/0", "NS116"),
        ("approximate N: K = sqrt(-mu)", "NS116"),
        ("approximate N: K = [1, 2]", "NS105"),
        ("approximate N: K = 1 > 2", "NS117"),
        ("approximate N: K = 1, K = 2", "NS102"),
        ("approximate N: K = stiffness", "NS101"),
    ],
)
def test_constants_that_no_law_can_use_are_refused(line: str, code: str) -> None:
    assert code in refused(*SCENE, line)


def test_alpha_equal_to_beta_is_perfectly_elastic_and_accepted() -> None:
    assert refused(*SCENE, "approximate N: K = 1, alpha = 2, beta = 2") == []


def test_what_the_constants_must_satisfy_is_checked_when_they_are_overridden() -> None:
    conditions = {text(c.condition) for c in compiled(*SCENE, *LAWS).ode.checks}
    assert {"(N.K > 0)", "(N.alpha > 0)", "(N.alpha <= N.beta)", "(F.beta > 0)"} <= conditions


def test_one_set_of_constants_for_a_family() -> None:
    model = compiled(
        "state x[i in 1..3] = 0",
        "force F[i in 1..3] = i*sgn(x[i])",
        "for i in 1..3: der(x[i]) = -F[i]",
        "approximate F: K = 100, beta = 0.1",
    )
    assert element_names(model.ode.parameters) == ["F.K", "F.beta"]
    assert states(model)[3:] == ["F[1].a", "F[2].a", "F[3].a"]
    found = rates(model, {"x[1]": 5, "x[3]": 5})
    assert [found[f"x[{i}]"] for i in (1, 2, 3)] == [-1, 0, -3]


ROW = (
    "constant n = 3",
    "parameter k[i in 1..n] = 100*i^2",
    "let b[i in 1..n] = (if i > 1 then 1/k[i-1] else mu)/i",
    "parameter mu = 0.5",
    "state x[i in 1..n] = 0",
    "force F[i in 1..n] = sgn(x[i])",
    "for i in 1..n: der(x[i]) = -F[i]",
)


def test_constants_may_read_elements_of_families() -> None:
    model = compiled(*ROW, "approximate F: K = k[2] + k[n], beta = b[n] + b[1]")
    values = dict(zip(element_names(model.ode.parameters), model.p0, strict=True))
    assert values["F.K"] == 400 + 900
    assert values["F.beta"] == pytest.approx(1 / 400 / 3 + 0.5)
    moved = model.with_parameters({"k[2]": 1600, "mu": 1})
    values = dict(zip(element_names(moved.ode.parameters), moved.p0, strict=True))
    assert values["F.K"] == 1600 + 900
    assert values["F.beta"] == pytest.approx(1 / 1600 / 3 + 1)


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("approximate F: K = k[i]", "NS111"),
        ("approximate F: K = k", "NS105"),
        ("approximate F: K = k[4]", "NS109"),
        ("approximate F: K = b[0]", "NS109"),
        ("approximate F: K = x[1]", "NS111"),
        ("approximate F: K = j", "NS101"),
    ],
)
def test_a_family_has_one_set_of_constants(line: str, code: str) -> None:
    assert refused(*ROW, line) == [code]


def test_every_setting_that_is_wrong_is_told() -> None:
    lines = ["approximate F: k = 1, bta = 2, alpha = 3, K = 4", "simulate 0 step -1 every 0"]
    assert refused(*ROW, lines[0]) == ["NS303"] * 3
    assert refused(*ROW, lines[1]) == ["NS501"] * 3
    assert refused(*ROW, "approximate F, G, H: K = 1, K = 2") == ["NS102"]
    assert refused(*ROW, "approximate F, G, H: K = 1") == ["NS304"] * 2
