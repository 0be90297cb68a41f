"""Models whose units fit, and models whose units do not."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import nsode
from nsode.diagnostics import Diagnostic, ModelError
from nsode.evaluate import evaluate
from nsode.inclusion.build import build
from nsode.ode import Binding, DifferentialInclusion
from nsode.source import Source
from nsode.syntax import parse
from support import MODELS

HEAD = """\
model m
parameter M  = 2   {kg}
parameter k  = 100 {N/m}
parameter g  = 9.8 {m/s^2}
parameter mu = 0.3
state x = 1  {m}
state v = 0  {m/s}
der(x) = v
"""
REST = "M*der(v) = -k*x\n"


def inclusion(text: str) -> DifferentialInclusion:
    return build(parse(Source("model.di", text)))[0]


def misfits(text: str) -> list[Diagnostic]:
    """Return the errors of a model, which are all about units."""
    try:
        inclusion(text)
    except ModelError as error:
        errors = [d for d in error.diagnostics if d.severity == "error"]
        assert {d.code for d in errors} <= {"NS114", "NS115"}
        return errors
    return []


def marked(text: str) -> list[tuple[str, list[str]]]:
    """Return each message with the pieces of text that it points at."""
    return [
        (d.message, [text[label.span.start : label.span.end] for label in d.labels])
        for d in misfits(text)
    ]


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_the_shipped_models_fit(path: Path) -> None:
    assert misfits(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_each_unit_of_a_shipped_model_is_checked(path: Path) -> None:
    """Every unit is spoiled in turn: none is merely accepted."""
    text = path.read_text(encoding="utf-8")
    for unit in re.finditer(r"\{([^{}\n]*)\}", text):
        spoiled = f"{text[: unit.start()]}{{({unit[1]})*A^3}}{text[unit.end() :]}"
        assert misfits(spoiled), f"nothing reads {text[: unit.end()].splitlines()[-1]!r}"


def test_without_units_nothing_is_checked_and_pint_stays_away() -> None:
    bare = re.sub(r"\{[^}]*\}", "", HEAD + "M*der(v) = k - x*g\n")
    code = f"import sys, nsode; nsode.loads({bare!r}); sys.exit('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    ("line", "message", "places"),
    [
        (
            "let a = x + k",
            "`m` and `N/m` cannot be added",
            ["k", "x", "{N/m}", "{m}"],
        ),
        (
            "let f = k*x {J}",
            "`f` is declared in `J`, but its value is in `N`",
            ["k*x", "{J}"],
        ),
        (
            "output f = k*x {N/m}",
            "`f` is declared in `N/m`, but its value is in `N`",
            ["k*x", "{N/m}"],
        ),
        (
            "let s = sin(x)",
            "the argument of `sin` must be dimensionless, not in `m`",
            ["x", "{m}"],
        ),
        (
            "assume M >= g",
            "`kg` and `m/s^2` cannot be compared",
            ["g", "M", "{m/s^2}", "{kg}"],
        ),
        (
            "force F = M*g*sgn(v) {J}",
            "`F` is declared in `J`, but its value is in `N`",
            ["M*g", "{J}"],
        ),
        (
            "simulate 4 {m} step 1e-3 {s}",
            "the duration of a run is in `s`, not in `m`",
            ["{m}"],
        ),
        (
            "let d = x + 3 {mm}",
            "`mm` converts a value made of numbers alone, and this one is a formula",
            ["3", "{mm}"],
        ),
    ],
)
def test_a_misfit_points_at_both_sides(line: str, message: str, places: list[str]) -> None:
    assert marked(f"{HEAD}{REST}{line}\n") == [(message, places)]


def test_the_sides_of_an_equation_agree() -> None:
    assert marked(HEAD + "M*der(v) = k*x/M\n") == [
        (
            "the units of this equation do not fit: `der(v)` is in `m/s^2`, not in `m/(kg*s^2)`",
            ["M*der(v) = k*x/M", "{m/s}"],
        )
    ]


def test_an_initial_value_has_the_unit_of_its_state() -> None:
    text = HEAD + REST + "state y = 2*g {m}\nder(y) = v\n"
    assert marked(text) == [("`y` is declared in `m`, but its value is in `m/s^2`", ["2*g", "{m}"])]


APPROXIMATE = """\
force N = dio(x)       {N}
force F = mu*N*sgn(v)  {N}
M*der(v) = N - F
"""


@pytest.mark.parametrize(
    ("setting", "message", "places"),
    [
        ("N: K = 1 {N}", "`K` of `N` is in `N/m`, not in `N`", ["{N}", "dio(x)"]),
        ("F: K = 1 {N*s/m}", "`K` of `F` is in `N/m`, not in `N*s/m`", ["{N*s/m}", "mu*N*sgn(v)"]),
        ("N: K = 2*M", "`K` of `N` is in `N/m`, not in `kg`", ["2*M", "dio(x)"]),
        ("N: alpha = 1 {m}", "`alpha` of `N` is in `s`, not in `m`", ["{m}"]),
        ("F: beta = 1 {Hz}", "`beta` of `F` is in `s`, not in `Hz`", ["{Hz}"]),
        ("default sgn: beta = 1 {m}", "`beta` of `F` is in `s`, not in `m`", ["{m}"]),
    ],
)
def test_a_constant_fits_its_element(setting: str, message: str, places: list[str]) -> None:
    assert marked(f"{HEAD}{APPROXIMATE}approximate {setting}\n") == [(message, places)]


@pytest.mark.parametrize(
    ("law", "constants"),
    [
        ("N with kelvin_voigt", {"K": "N/m", "B": "N*s/m"}),
        ("N with clipped_kelvin_voigt", {"K": "N/m", "B": "N*s/m"}),
        ("N with hunt_crossley", {"c": "s/m", "n": "1"}),
        ("F with lugre", {"K": "N/m", "B": "N*s/m", "D": "N*s/m", "F0": "N"}),
        ("F with smoothing", {"epsilon": "m/s"}),
    ],
)
def test_constants_of_other_laws_fit_too(law: str, constants: dict[str, str]) -> None:
    """The units of the laws as published, for a force in N, a gap in m and a speed in m/s."""
    for name, unit in constants.items():
        text = f"{HEAD}{APPROXIMATE}approximate {law}: {name} = 1 "
        assert misfits(f"{text}{{{unit}}}\n") == []
        assert len(misfits(f"{text}{{{unit}*A}}\n")) == 1


@pytest.mark.parametrize(
    "settings",
    [
        "N: restitution = 0.5, impact_speed = 3 {m/s}, penetration = 1 {mm}, effective_mass = M",
        "F: presliding = 1e-5 {m}, damping_ratio = 0.8 {1}, effective_mass = 2 {kg}",
        "N: K = 1 {kg/s^2}, alpha = 1 {ms}, beta = 2 {ms}",
        "N: K = 2*k {kN/m}",
        "F: K = N.K {N/m}, beta = N.beta",
        "default dio: K = 10 {N/mm}",
    ],
)
def test_constants_that_fit_are_accepted(settings: str) -> None:
    assert misfits(f"{HEAD}{APPROXIMATE}approximate {settings}\n") == []


def test_a_rotational_element_has_a_rotational_stiffness() -> None:
    text = """\
model joint
parameter J = 1 {kg*m^2}
parameter T = 2 {N*m}
state w = 1 {rad/s}
force F = T*sgn(w) {N*m}
J*der(w) = -F
approximate F: K = 1e3 {N*m/rad}, beta = 1e-3 {s}
"""
    assert misfits(text) == []
    assert marked(text.replace("1e3 {N*m/rad}", "1e3 {N/m}")) == [
        ("`K` of `F` is in `N*m`, not in `N/m`", ["{N/m}", "T*sgn(w)"])
    ]


def test_the_stiffness_tells_the_unit_of_a_term_without_one() -> None:
    text = HEAD + "M*der(v) = dio(x) - M*g\napproximate default dio: K = 1 {N/m}\n"
    assert misfits(text) == []
    [(message, _)] = marked(text.replace("1 {N/m}", "1 {N}"))
    assert message == "`N*m` and `N` cannot be added"


def test_an_undeclared_unit_stops_no_model() -> None:
    assert misfits(HEAD + "state q = 0\nder(q) = x*v\nM*der(v) = q - k*x\n") == []
    assert misfits(HEAD + "M*der(v) = -0.5*sgn(v)\n") == []
    assert misfits(HEAD + "let a = 100\nM*der(v) = a*x - k*x\n") == []


def test_units_are_inferred_through_lets() -> None:
    text = HEAD + "let spring = -k*x\nlet twice = 2*spring\nM*der(v) = twice + g\n"
    assert [message for message, _ in marked(text)] == ["`N` and `m/s^2` cannot be added"]


def test_several_misfits_are_told_in_one_run_each_place_once() -> None:
    text = """\
model vectors
parameter M = 1 {kg}
state p[3] = [0, 0, 1] {m}
state v[3] = [0, 0, 0] {m/s}
let s = p + v
der(p) = M*v
M*der(v) = -M*p
"""
    assert [places[0] for _, places in marked(text)] == ["v", "der(p) = M*v", "M*der(v) = -M*p"]


FAMILY = """\
model row
constant n = 4
parameter m = 1 {kg}
parameter k = 100 {N/m}
parameter d = 2 {mm}
state x[i in 1..n] = 3*i {mm}
state v[i in 1..n] = 0 {m/s}
force N[i in 0..n] = dio((if i < n then x[i+1] else 1) - (if i > 0 then x[i] else 0) - d) {N}
for i in 1..n: der(x[i]) = v[i]
for i in 1..n: m*der(v[i]) = N[i-1] - N[i] - k*(x[i] - sum(j in 1..n: x[j])/n)
approximate N: K = 1e4 {N/m}, alpha = 1 {ms}, beta = 2 {ms}
"""


def test_families_are_checked_and_converted() -> None:
    assert misfits(FAMILY) == []
    assert [p.values for p in inclusion(FAMILY).parameters if p.name == "d"] == [(0.002,)]
    [(message, _)] = marked(FAMILY.replace("k*(x[i]", "(x[i]"))
    assert message == "`N` and `mm` cannot be added"


@pytest.mark.parametrize(
    ("declaration", "values"),
    [("3*i {mm}", [0.003, 0.006]), ("[5, 7] {mm}", [0.005, 0.007]), ("2 {mm}", [0.002, 0.002])],
)
def test_values_of_families_are_converted(declaration: str, values: list[float]) -> None:
    text = f"""\
model row
parameter a[i in 1..2] = {declaration}
state x[i in 1..2] = {declaration}
let y[i in 1..2] = {declaration}
for i in 1..2: der(x[i]) = (y[i] - a[i])/t
"""
    found = inclusion(text)
    [state], [parameter], [binding] = found.states, found.parameters, found.bindings
    assert isinstance(binding, Binding)
    for expr in (state.initial, binding.value):
        assert [evaluate(expr, no_names, {"i": i}) for i in (1, 2)] == values
    assert list(parameter.values * (2 // len(parameter.values))) == values


def no_names(name: str, at: int | None) -> float:
    raise AssertionError(name)


def test_coupled_equations_are_checked_row_by_row() -> None:
    text = """\
model cart_pole
parameter M = 1 {kg}
parameter L = 1 {m}
parameter g = 9.8 {m/s^2}
state a = 0.1 {rad}
state v = 0 {m/s}
state w = 0 {rad/s}
der(a) = w
M*der(v) + M*L*cos(a)*der(w) = M*L*w^2*sin(a)
M*L*cos(a)*der(v) + M*L^2*der(w) = M*g*L*sin(a)
"""
    assert misfits(text) == []
    [(message, places)] = marked(text.replace("M*L^2*der(w)", "M*L*der(w)"))
    assert message == "`N*m` and `N` cannot be terms of one equation"
    assert places == ["M*L", "M*L*cos(a)"]


def test_derivatives_of_functions_of_time_are_per_second() -> None:
    text = """\
model shaken
parameter A = 1 {m}
parameter w = 2 {rad/s}
state x = 0 {m}
let s = A*sin(w*t) {m}
der(x) = der(s)
"""
    assert misfits(text) == []
    assert misfits(text.replace("w*t", "2*t").replace("parameter w = 2 {rad/s}\n", "")) == []
    [(message, _)] = marked(text.replace("= der(s)", "= s"))
    assert "`der(x)` is in `m/s`, not in `m`" in message


def test_the_unit_of_a_derivative_follows_from_what_it_derives() -> None:
    text = """\
model tracking
state v = 0 {m/s}
let r = 0.1*t {m}
let s = v - der(r)
let a = der(der(r + 2*t^3)) {m/s^2}
der(v) = a - sgn(s)
"""
    assert misfits(text) == []
    [(message, places)] = marked(text.replace("v - der(r)", "v - r"))
    assert (message, places[:2]) == ("`m/s` and `m` cannot be added", ["r", "v"])
    [(message, places)] = marked(text.replace("der(r)", "der(der(r*r))"))
    assert (message, places[0]) == ("`m/s` and `m^2/s^2` cannot be added", "der(der(r*r))")


def test_values_are_labeled_in_the_units_in_which_they_stand() -> None:
    text = HEAD + REST + "parameter d = 3 {mm}\nlet y = x + d {mm}\noutput e = y {mm}\n"
    found = inclusion(text + "force N = dio(x) {kN}\napproximate N: K = 1 {kN/m}\n")
    units = {item.name: item.unit for item in (*found.parameters, *found.outputs, *found.states)}
    assert units["d"] == units["e"] == "m"
    assert (units["N"], units["k"], units["v"], units["mu"]) == ("N", "N/m", "m/s", None)
    assert [b.unit for b in found.bindings if isinstance(b, Binding)] == ["m"]


def test_an_unknown_unit_of_a_force_is_refused() -> None:
    [problem] = misfits(HEAD + "force N = dio(x) {newtons_}\nM*der(v) = N\n")
    assert (problem.code, problem.message) == ("NS114", "unknown unit `newtons_`")


def test_the_help_names_the_factor_that_is_missing() -> None:
    [problem] = misfits(HEAD + "M*der(v) = k*x - g\n")
    assert problem.help == (
        "they differ by a factor in `kg`: one is missing, or a declared unit is wrong"
    )


def test_an_output_without_a_unit_has_that_of_its_value():
    model = nsode.loads(
        "model ball\n"
        "parameter M = 1 {kg}\nparameter g = 9.8 {m/s^2}\n"
        "state p = 1 {m}\nstate v = 0 {m/s}\n"
        "force N = dio(p)\n"
        "der(p) = v\nM*der(v) = N - M*g\n"
        "output energy = 1/2*M*v^2 + M*g*p\noutput share = v/(abs(v) + v)*2\noutput two = 2\n"
        "approximate N: K = 1e5 {N/m}, beta = 1e-2 {s}, alpha = 5e-3 {s}\n"
    )
    units = {output.name: output.unit for output in model.ode.outputs}
    assert units == {"energy": "N*m", "share": None, "two": None, "N": "N"}
