"""``der()`` of a function of time, wherever an expression stands: against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy

import nsode
from nsode.ode import element_names
from support.reading import compiled, rates, refused

SMOOTH = [
    "sin(w*t)*exp(-t)",
    "t^3 - w*t",
    "sqrt(1 + t^2)/(2 + cos(t))",
    "log(1 + w*t)*atan(t)",
    "tanh(t)^3 + w^t",
    "cosh(sin(w*t))/cosh(t)",
]


def values(model: nsode.Model, t: float) -> dict[str, float]:
    """Return the outputs of a model at some time."""
    run = model.simulate(2 * t, step=t)
    names = element_names(model.ode.outputs)
    return {name: float(run[name][1]) for name in names}


def test_der_takes_a_function_of_time() -> None:
    model = compiled(
        "parameter w = 3",
        "constant n = 2",
        "let phase = w*t",
        "let r[i in 1..n] = sin(i*phase)",
        "let p = [cos(phase), t^2]",
        "state a = 0",
        "state b[2] = [0, 0]",
        "der(a) = der(r[2]) + der(exp(2*t)) + der(w)",
        "der(b) = der(p)",
    )
    found = rates(model, {}, t=0.5)
    assert found["a"] == pytest.approx(6 * math.cos(3) + 2 * math.e, rel=1e-14)
    assert found["b.x"] == pytest.approx(-3 * math.sin(1.5), rel=1e-14)
    assert found["b.y"] == 1.0


@pytest.mark.parametrize("of", ["u", "q", "x", "N", "2*x", "dio(x)", "sgn(x)"])
def test_der_takes_nothing_that_is_not_known_in_time(of: str) -> None:
    head = ("input u = 0", "state x = 0", "state y = 0", "let q = x^2", "force N = dio(x)")
    found = refused(*head, "der(x) = N", f"der(y) = {of.join(('der(', ')'))}")
    assert found == ([] if of == "x" else ["NS112"])


@pytest.mark.parametrize("of", SMOOTH)
def test_derivatives_of_a_let_are_those_of_calculus(of: str) -> None:
    model = compiled(
        "parameter w = 1.7",
        f"let r = {of}",
        "let rate = der(r)",
        "state x = 0",
        "der(x) = rate",
        "output o1 = der(r)",
        "output o2 = der(der(r))",
        "output o3 = 2*der(rate - r)",
    )
    t, w = sympy.symbols("t w")
    r = sympy.sympify(of.replace("^", "**"), {"t": t, "w": w})
    wanted = [r.diff(t), r.diff(t, 2), 2 * (r.diff(t, 2) - r.diff(t))]
    found = values(model, 0.8)
    exact = [float(item.subs({t: 0.8, w: sympy.Float(1.7, 30)}).evalf(30)) for item in wanted]
    assert list(found.values()) == pytest.approx(exact, rel=1e-13)


def test_a_run_of_a_derivative_is_the_central_difference_of_its_function() -> None:
    model = compiled(
        "let r = if t < 0.5 then t^2 else max(0, 1 - abs(t - 1))*sin(4*t)",
        "state x = 0",
        "der(x) = 0",
        "output o1 = r",
        "output o2 = der(r)",
    )
    run = model.simulate(1.6, step=1e-4)
    rate = np.gradient(run["o1"], run.t)
    kinks = np.array([0.5, 1.0])
    away = np.min(np.abs(run.t[:, None] - kinks), axis=1) > 2e-4
    inside = away & (run.t > 0) & (run.t < 1.6)
    assert run["o2"][inside] == pytest.approx(rate[inside], abs=1e-6)


def test_a_family_has_a_family_of_derivatives() -> None:
    model = compiled(
        "constant n = 3",
        "parameter k[i in 1..n] = 0.5*i",
        "let r[i in 1..n] = sin(k[i]*t)",
        "let s[i in 1..n] = der(r[i]) - (if i < n then der(r[i+1]) else 0)",
        "let q[i in 1..n][2] = der([r[i], t*r[i]])",
        "state x[i in 1..n] = 0",
        "for i in 1..n: der(x[i]) = s[i]",
        "output o[i in 1..n] = s[i]",
        "output osum = sum(j in 1..n: der(j*r[j]))",
        "output oq = q[2].y",
    )
    t, k = 0.6, [0.5, 1.0, 1.5]
    slopes = [a * math.cos(a * t) for a in k]
    wanted = [slopes[0] - slopes[1], slopes[1] - slopes[2], slopes[2]]
    weighted = sum(j * slope for j, slope in enumerate(slopes, start=1))
    expected = [*wanted, weighted, math.sin(t) + t * slopes[1]]
    assert list(values(model, t).values()) == pytest.approx(expected, rel=1e-14)


def test_a_let_may_have_the_name_that_code_gives_a_derivative() -> None:
    model = compiled(
        *("let r = sin(t)", "let r_dot = 5", "let r_dot_dot = 7"),
        *("state x = 0", "der(x) = der(der(r)) + r_dot + r_dot_dot*der(r)"),
        "output o = r_dot*der(r) + r_dot_dot",
    )
    assert values(model, 0.3)["o"] == 5 * math.cos(0.3) + 7


def test_a_constant_slope_may_be_an_initial_value() -> None:
    head = ("parameter w = 3", "let r = 2*w*t", "let s = t^2")
    run = compiled(*head, "state x = der(r)", "der(x) = 0").simulate(1, step=1)
    assert run["x"][0] == 6
    assert refused(*head, "state x = der(s)", "der(x) = 0") == ["NS111"]


def test_two_terms_on_one_derivative_are_one_element() -> None:
    model = compiled(
        *("let r = sin(t)", "state v = 0", "let s = v - der(r)"),
        "der(v) = -2*sgn(s) - 2*sgn(v - der(r))",
    )
    assert len(model.ode.auxiliary) == 1


def test_a_law_that_reads_the_velocity_shares_the_derivative_that_the_model_reads() -> None:
    def scene(slope: str) -> nsode.Model:
        return compiled(
            *("state p = 0.5", "state v = 0", "let floor = 0.1*sin(3*t)"),
            *("force N = dio(p - floor)", "der(p) = v", f"der(v) = N - 9.8 - {slope}"),
            "approximate N with hunt_crossley: K = 1e4, c = 0.2",
        )

    at = {"p": -0.01, "v": -1.0}
    by_hand = rates(scene("0.1*(cos(3*t)*3)"), at, t=0.4)
    assert rates(scene("der(floor)"), at, t=0.4) == by_hand
    depth, speed = 0.1 * math.sin(1.2) + 0.01, 1.0 + 0.3 * math.cos(1.2)
    force = 1e4 * depth * (1 + 1.5 * 0.2 * speed)
    assert by_hand["v"] == pytest.approx(force - 9.8 - 0.3 * math.cos(1.2), rel=1e-13)


def test_a_long_chain_of_functions_derives_without_recursion() -> None:
    links = [f"let a{k} = a{k - 1} + t^2" for k in range(1, 1500)]
    model = compiled("let a0 = t", *links, "state x = 0", "der(x) = der(a1499)")
    assert rates(model, {}, t=0.5)["x"] == 1500.0


@pytest.mark.parametrize("of", ["u", "q", "x", "v", "N", "2*x", "dio(x)", "if x > 0 then t else 0"])
def test_outside_an_equation_der_takes_functions_of_time_alone(of: str) -> None:
    head = ("input u = 0", "state x = 0", "state v = 0", "let q = x^2", "force N = dio(x)")
    rest = ("der(x) = N", "der(v) = u + q", "output o = y")
    assert refused(*head, f"let y = der({of})", *rest) == ["NS112"]
    assert refused(*head, "let y = v", f"output z = der({of})", *rest) == ["NS112"]


def test_sliding_holds_from_the_time_that_the_reaching_law_tells() -> None:
    """With s = v - der(r), ``der(s) = -eta*sgn(s)``: s = 0 after abs(s(0))/eta."""
    amplitude, frequency, eta = 0.5, 2.0, 3.0
    model = compiled(
        *("parameter A = 0.5 {m}", "parameter w = 2 {rad/s}", "parameter eta = 3 {m/s^2}"),
        *("state p = 0 {m}", "state v = 0 {m/s}", "let r = A*sin(w*t) {m}"),
        "force F = eta*sgn(v - der(r))",
        *("der(p) = v", "der(v) = der(der(r)) - F"),
        "approximate F: K = 1e6, beta = 2e-3",
    )
    run = model.simulate(2, step=1e-4)
    error = run["v"] - amplitude * frequency * np.cos(frequency * run.t)
    reached = amplitude * frequency / eta
    before, after = run.t < reached - 1e-3, run.t > reached + 2e-2
    assert error[before] == pytest.approx(eta * (run.t[before] - reached), abs=1e-9)
    assert abs(error[after]).max() < 1e-6
    ahead = run["p"] - amplitude * np.sin(frequency * run.t)
    lost = amplitude * frequency * reached / 2  # the area under the error
    assert ahead[after] == pytest.approx(np.full(after.sum(), -lost), abs=1e-4)
