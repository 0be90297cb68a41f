"""The rewrite as it is shown: faithful to the ODE, and to Section 5 of the paper."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from click.testing import CliRunner

import nsode
from nsode.backends.latex.names import unit
from nsode.cli.explain import command
from nsode.evaluate import Lookup, evaluate
from nsode.explain import Explanation, explain
from nsode.explain.plain import number, plain
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Sum
from nsode.ode import LinearSolve, element_names
from support.golden import assert_recorded
from support.models import MODELS, PATHS
from support.odes import call
from support.running import Tracer

A, B = Name("a"), Name("b")


def explained(model: str) -> Explanation:
    loaded = nsode.load(MODELS / f"{model}.di")
    return explain(loaded.inclusion, loaded.ode)


def of(text: str) -> Explanation:
    loaded = nsode.loads(text)
    return explain(loaded.inclusion, loaded.ode)


def test_example_ii_reads_like_section_5_2():
    text = explained("two_blocks_conveyor").text()
    in_order = [
        "N1 in dio(p1.x)",
        "F2 in mu2*N2*sgn(v1.y - v2.y)",
        "First, each dio(psi) is replaced",
        "dio(p2.x - p1.x)",
        "N2 = N2.K*max(0, N2.e - N2.beta*(p2.x - p1.x + N2.e)/N2.alpha)",  # (40)
        "Next, each chi*sgn(theta) is replaced",
        "F2 = F2.K*sat(mu2*N2/F2.K, F2.a + F2.beta*(v1.y - v2.y))",  # (43)
        "Finally, the states e and a are appended",
        "der(N2.e) = max(-N2.e/N2.beta, -(p2.x - p1.x + N2.e)/N2.alpha)",
        "der(F2.a) = (F2/F2.K - F2.a)/F2.beta",
        "The augmented ODE, as in (32): 8 states and 6 appended",
        "der(v2.y) = (F2 + N3 - M2*g)/M2",
    ]
    place = 0
    for part in in_order:
        place = text.index(part, place)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_each_replacement_names_its_line_and_what_stands_there(path):
    loaded = nsode.load(path)
    lines = path.read_text(encoding="utf-8").splitlines()
    found = explain(loaded.inclusion, loaded.ode).steps
    assert len(found) == len(loaded.inclusion.terms)
    for step in found:
        assert step.written in " ".join(lines[step.line - 1].split())
        assert re.search(rf"\b{step.term.kind}\(", step.written)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_what_is_shown_has_the_value_that_is_computed(path):
    loaded = nsode.load(path)
    x = np.random.default_rng(1).normal(size=len(element_names(loaded.ode.states)))
    u = np.ones(len(element_names(loaded.ode.inputs)))
    p = np.concatenate([parameter.values for parameter in loaded.ode.parameters])
    traced = Tracer(loaded.ode, 0.3, x, u, p)

    def known(name: str, at: int | None) -> float:
        return traced.known[name, at].value

    for step in explain(loaded.inclusion, loaded.ode).steps:
        over = step.term.range
        for k in [None] if over is None else range(over.first, over.last + 1):
            indices = {} if over is None or k is None else {over.variable: k}
            for names, value in step.values:
                expected = [known(name, k) for name in names]
                found = vector(value, len(names), known, indices)
                np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-9)


def vector(value: Expr, r: int, known: Lookup, indices: dict[str, int]) -> np.ndarray:
    """Return the value of what a step shows, ``K*sat(Z, [z...])`` by the paper's (2)."""
    match value:
        case Call("*", (stiffness, Call("sat", (level, *parts)))) if r > 1:
            z = np.array([evaluate(part, known, indices) for part in parts])
            bound, length = evaluate(level, known, indices), np.linalg.norm(z)
            s = z if length <= bound else bound * z / length
            return evaluate(stiffness, known, indices) * s
        case _:
            return np.array([evaluate(value, known, indices)])


def test_a_comment_inside_a_term_is_not_shown():
    found = of(
        "model m\nstate p = 1\nstate v = 0\nforce N = dio(p  # the \\floor {here}\n  - 0.5)\n"
        "der(p) = v\nder(v) = N\napproximate N: K = 1e5, beta = 4e-3, alpha = 1e-3\n"
    )
    assert [step.written for step in found.steps] == ["dio(p - 0.5)"]
    assert "floor" not in found.text() + found.latex() + found.markdown()


def test_a_model_without_terms_is_explained_too():
    found = of("model m\nstate x = 1\nder(x) = -x\n")
    assert found.text() == (
        "m: no set-valued term, so nothing is replaced\n\nThe ODE\n  der(x) = -x\n"
    )
    assert found.markdown().startswith("# m\n\n## The ODE\n\n$$\n")
    assert "replace" not in found.markdown()


def test_constants_that_nobody_gave_are_named_as_such():
    found = of("model m\nstate p = 1\nstate v = 0\nforce N = dio(p)\nder(p) = v\nder(v) = N\n")
    assert "N: K not given, alpha not given, beta not given" in found.text()
    assert r"N &: \quad K \text{ not given}, \; \alpha \text{ not given}" in found.latex()


@pytest.mark.parametrize(
    ("shown", "tex"),
    [
        ("N/m", r"\mathrm{N/m}"),
        ("kg*m^2/s^-2", r"\mathrm{kg \, m^{2}/s^{-2}}"),
        ("m_%", r"\mathrm{m\_\%}"),
    ],
)
def test_units_are_set_upright(shown, tex):
    assert unit(shown) == tex


OTHER_LAWS = """model box
state p[3] = [0, 0, 1]
state v[3] = [1, 0, 0]
force N = dio(p.z)
force F = 0.5*N*sgn([v.x, v.y])
der(p) = v
der(v) = [-F.x, -F.y, N]
approximate N with clipped_kelvin_voigt: K = 1e5, B = 100
approximate F with smoothing: epsilon = 1e-3
"""


def test_another_law_is_shown_as_what_it_is():
    found = of(OTHER_LAWS)
    text = found.text()
    assert "First, each dio(psi) is replaced by its law" in text
    assert "max(0, -N.K*p.z - N.B*v.z)" in text
    assert "(16)" in text
    assert "appended" not in text.replace("6 states and 0 appended", "")
    assert r"\tag{50}" in found.markdown()
    assert "(18a)" not in found.markdown()


def test_a_constant_without_unit_stands_alone():
    law = "approximate N with hunt_crossley: K = 1e5, c = 0.2\n"
    text = of(
        OTHER_LAWS.replace("approximate N with clipped_kelvin_voigt: K = 1e5, B = 100\n", law)
    )
    assert re.search(r"N: .*n = 1(,|$)", text.text(), re.MULTILINE)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_a_notebook_gets_text_and_markdown(path):
    loaded = nsode.load(path)
    bundle = explain(loaded.inclusion, loaded.ode)._repr_mimebundle_()
    assert set(bundle) == {"text/plain", "text/markdown"}
    assert bundle["text/markdown"].count("$$") % 2 == 0
    json.dumps(bundle)


def test_bold_headings_stand_on_terminals_only():
    found = explained("bouncing_mass")
    assert "\033[1m" in found.text(color=True)
    assert re.sub(r"\033\[\d*m", "", found.text(color=True)) == found.text() == str(found)


@pytest.mark.parametrize("style", ["text", "markdown", "latex"])
@pytest.mark.parametrize(
    "model", ["two_blocks_conveyor", "rolling_sphere", "granular_column", "cart_pole"]
)
def test_explains_as_recorded(model, style):
    found = explained(model)
    shown = {"text": found.text, "markdown": found.markdown, "latex": found.latex}[style]()
    suffix = {"text": "txt", "markdown": "md", "latex": "tex"}[style]
    assert_recorded(f"explain/{model}.{suffix}", shown)


def test_the_command_writes_to_a_file_or_to_standard_output(tmp_path):
    model, target = str(MODELS / "bouncing_mass.di"), tmp_path / "out" / "bounce.md"
    runner = CliRunner()
    written = runner.invoke(command, [model, "--format", "markdown", "-o", str(target)])
    shown = runner.invoke(command, [model, "--format", "markdown"])
    assert (written.exit_code, shown.exit_code) == (0, 0)
    assert written.output == ""
    assert target.read_text(encoding="utf-8") == shown.stdout


@pytest.mark.parametrize(
    ("expr", "text"),
    [
        (call("+", A, call("neg", B), -2), "a - b - 2"),
        (call("+", A, call("neg", call("+", B, 2))), "a - (b + 2)"),
        (call("/", call("neg", call("+", A, B)), 2), "-(a + b)/2"),
        (call("/", A, call("*", B, 2)), "a/(b*2)"),
        (call("*", A, call("/", B, 2)), "a*(b/2)"),
        (call("/", call("*", A, B), 2), "a*b/2"),
        (call("*", A, call("neg", B)), "a*(-b)"),
        (call("neg", call("^", A, 2)), "-a^2"),
        (call("^", call("neg", A), 2), "(-a)^2"),
        (call("^", A, call("^", B, 2)), "a^b^2"),
        (call("^", call("^", A, B), 2), "(a^b)^2"),
        (call("^", A, -2), "a^(-2)"),
        (call("or", call("and", call("<", A, B), call(">", A, 0)), call("not", call("==", A, B))),
         "a < b and a > 0 or not a == b"),
        (call("+", 1, If(call("<", A, B), A, B)), "1 + (if a < b then a else b)"),
        (Name("p.x", Index("i", 1)), "p[i+1].x"),
        (Sum(IndexRange("i", 1, 3), Name("x", Index("i"))), "sum(i in 1..3: x[i])"),
        (call("norm", A, B), "norm([a, b])"),
    ],
)  # fmt: skip
def test_plain_text_has_the_brackets_it_needs(expr, text):
    assert plain(expr) == text


@pytest.mark.parametrize("value", [0.1, 1e5, 123456789.0, 1 / 3, 5e-324, 1e300, -2.0])
def test_numbers_keep_their_value(value):
    assert float(number(value)) == value


def test_the_rates_shown_are_those_of_the_ode():
    found = explained("gripper")
    shown = {rate.state for step in found.steps for rate in step.rates}
    assert shown == {item.name for item in found.ode.auxiliary}


def test_an_expression_that_nobody_knows_is_loud():
    with pytest.raises(NotImplementedError, match="no text for Expr"):
        plain(Expr())


def test_coupled_rates_stay_a_matrix():
    found = explained("cart_pole")
    assert any(isinstance(item, LinearSolve) for item in found.inclusion.bindings)
    assert "]]*[der(v), der(w)] = [" in found.text()
    assert r"\dot{v} \\" in found.latex()
    assert "rate" not in found.text() + found.latex()


def test_the_first_row_of_a_family_of_systems_reads_its_own_element():
    found = nsode.loads(
        """model pairs
state x[i in 1..3] = 0
state y[i in 1..3] = 0
for i in 1..3: 2*der(x[i]) + x[i]*der(y[i]) = (if i > 1 then x[i-1] else 0)
for i in 1..3: x[i]*der(x[i]) + 3*der(y[i]) = 1
"""
    ).explain()
    assert "[[2, x[1]], [x[1], 3]]*[der(x[1]), der(y[1])] = [0, 1]" in found.text()
    assert "= [x[i-1], 1]  for i in 2..3" in found.text()
