"""The further published laws against their printed equations, coded by hand."""

from __future__ import annotations

import math
from importlib.util import find_spec

import numpy as np
import pytest

import nsode
from support.models import MODELS
from support.modules import load_module
from support.paper import Term, magnitude, maximum, sat, term

EPS = np.finfo(float).eps


def shipped(name, **laws):
    return nsode.load(MODELS / f"{name}.di").with_law(**laws)


def numbers(model, **more):
    """Return the parameters by name, with values for those that the model lacks."""
    return {p.name: p.values[0] for p in model.ode.parameters} | more


def near(module, model, p, x, expected, t=0.0):
    """Assert the rates at some states, each within a few eps of its running term scale."""
    rates = module.rhs(t, x, p=[p[q.name] for q in model.ode.parameters])
    for name, rate in zip((s.name for s in model.ode.states), rates, strict=True):
        if name in expected:
            wanted = term(expected[name])
            assert abs(rate - wanted.value) <= 8 * EPS * wanted.scale, name


def points(model, scale, count=200, seed=1):
    random = np.random.default_rng(seed)
    for _ in range(count):
        yield random.normal(size=len(model.x0)) * scale * 10.0 ** random.uniform(-3, 1)


def known(names, values):
    return {name: Term(np.asarray(v), np.abs(v)) for name, v in zip(names, values, strict=True)}


@pytest.mark.parametrize("D", [0.0, 0.3])
@pytest.mark.parametrize("B", [0.0, 10.0])
def test_lugre_is_equation_12_where_the_factor_is_constant(B, D):
    model = shipped("dry_friction", friction="lugre")
    module = load_module(model.ode)
    p = numbers(model) | {"F.B": B, "F.D": D}
    F, K = p["F0"], p["F.K"]
    assert p["F.F0"] == F
    for x in points(model, [1, 1, F / K]):
        s = known(["p", "v", "a"], x)
        moved = s["v"] - K * magnitude(s["v"]) * s["a"] / F  # (12a)
        f = K * s["a"] + B * moved + D * s["v"]  # (12b)
        near(module, model, p, x, {"F.a": moved, "v": -f / p["M"]})


def test_planar_lugre_scales_the_bristles_of_a_reference_force_to_the_factor():
    model = shipped("frictional_contact", friction="lugre", contact="clipped_kelvin_voigt")
    module = load_module(model.ode)
    p = numbers(model) | {"F.D": 0.2, "F.F0": 3.0}
    K, B = p["F.K"], p["F.B"]
    names = [s.name for s in model.ode.states]
    for x in points(model, [1, 1, 1e-3, 1, 1, 1, 1e-5, 1e-5]):
        s = known(names, x)
        push = p["N.K"] * s["p.z"] + p["N.B"] * s["v.z"]
        N = maximum(0, -push) if x[2] <= 0 else Term(np.float64(0), np.float64(0))
        speed = Term(np.hypot(x[3], x[4]), 4 * np.hypot(x[3], x[4]))
        expected = {}
        for c in "xy":
            moved = s[f"v.{c}"] - K * speed / 3.0 * s[f"F.a.{c}"]
            f = p["mu"] * N / 3.0 * (K * s[f"F.a.{c}"] + B * moved) + 0.2 * s[f"v.{c}"]
            expected |= {f"F.a.{c}": moved, f"v.{c}": -f / p["M"]}
        near(module, model, p, x, expected)


@pytest.mark.parametrize("law", ["kelvin_voigt", "clipped_kelvin_voigt"])
def test_kelvin_voigt_is_equation_15_and_clipped_equation_16(law):
    model = shipped("bouncing_mass", contact=law)
    module = load_module(model.ode)
    p = numbers(model)
    assert p["f.B"] == p["f.K"] * 1e-2
    for x in points(model, [1e-2, 1]):
        s = known(["p", "v"], x)
        f = -(p["f.K"] * s["p"]) - p["f.B"] * s["v"]
        if law == "clipped_kelvin_voigt":
            f = maximum(0, f)
        expected = (f if x[0] <= 0 else 0.0) + term(p["fe"])
        near(module, model, p, x, {"v": expected / p["M"]})


def test_each_contact_of_a_family_reads_its_own_closing_speed():
    model = shipped("granular_column", contact="kelvin_voigt")
    module = load_module(model.ode)
    p = numbers(model)
    n, d, m = 10, p["d"], p["m"]
    for x in points(model, [d] * n + [1] * n, 50):
        z, v = x[:n], x[n:]
        psi = np.diff(z, prepend=-d / 2) - d
        f = np.where(psi <= 0, -p["N.K"] * psi - p["N.B"] * np.diff(v, prepend=0), 0)
        expected = (f - np.append(f[1:], 0)) / m - p["g"]
        np.testing.assert_allclose(module.rhs(0.0, x)[n:], expected, rtol=1e-10, atol=1e-7)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0])
def test_hunt_crossley_is_its_formula_and_never_pulls(n):
    model = shipped("bouncing_mass", contact="hunt_crossley")
    module = load_module(model.ode)
    p = numbers(model) | {"f.c": 0.4, "f.n": n, "fe": 0.0}
    for x in points(model, [1e-2, 3]):
        depth = max(0.0, -x[0])
        f = p["f.K"] * depth**n * max(0.0, 1 - 1.5 * 0.4 * x[1])
        scale = p["f.K"] * depth**n * (1 + 1.5 * 0.4 * abs(x[1]))
        near(module, model, p, x, {"v": Term(np.float64(f), np.float64(scale))})


def test_smoothing_is_equation_50_with_its_factor():
    model = shipped("belt_oscillator", friction="smoothing")
    module = load_module(model.ode)
    p = numbers(model) | {"Fc.epsilon": 1e-2}
    for x in points(model, [1, 1e-2]):
        s = known(["p", "w"], x)
        (smooth,) = sat(term(1e-2), [s["w"]])
        f = p["F"] * smooth / ((p["V"] + maximum(magnitude(s["w"]), 1e-2)) * 1e-2)
        force = p["k2"] * s["p"] ** 3 - p["k1"] * s["p"] - f
        near(module, model, p, x, {"w": force / p["M"]})


def test_lugre_and_dahl_drift_under_a_load_below_friction_and_the_papers_law_does_not():
    # 40 pi rad/s at 1 ms are 50 steps a period, so rows lie at equal phase.
    def drift(law, **constants):
        model = shipped("dry_friction", friction=law)
        found = model.simulate(100, 1e-3, every=50, parameters={"omega": 40 * math.pi, **constants})
        return np.diff(found["p"][found.t >= 10])

    assert np.abs(drift("xiong2013")).max() < 1e-12
    for creeping in (drift("lugre"), drift("lugre", **{"F.B": 0.0})):
        assert creeping.min() > 0  # forward in every period, without end
        assert creeping.sum() > 0.05


def test_smoothed_friction_creeps_at_the_speed_that_its_load_asks_for():
    model = shipped("dry_friction", friction="smoothing")
    p = {"F.epsilon": 1e-3, "swing": 0.0}
    found = model.simulate(10, parameters=p)
    assert found["v"][-1] == pytest.approx(1e-3 * 0.336 / 0.5, rel=1e-9)


def test_example_iii_smoothed_comes_close_to_the_papers_law_as_epsilon_falls():
    exact = shipped("belt_oscillator").simulate(50.0, 5e-5, every=200)

    def apart(epsilon):
        model = shipped("belt_oscillator", friction="smoothing")
        found = model.simulate(50.0, 5e-5, every=200, parameters={"Fc.epsilon": epsilon})
        return np.abs(found["p"] - exact["p"]).max()

    assert apart(1e-3) > 1e-3
    assert apart(1e-5) < 5e-5  # the curves of Figure 11


def dropped(law, **constants):
    """Return one impact at 1 m/s without gravity: the run, and the speed it leaves with."""
    model = nsode.loads(
        "model impact\nstate p = 0\nstate v = -1\nforce N = dio(p)\nder(p) = v\n"
        f"2*der(v) = N\napproximate N with {law}: "
        + ", ".join(f"{name} = {value}" for name, value in constants.items())
    )
    found = model.simulate(0.2, 1e-6, every=10)
    return found, found["v"][-1]


def test_kelvin_voigt_leaves_with_the_speed_of_a_damped_oscillation_and_pulls():
    found, speed = dropped("kelvin_voigt", K=1e5, B=100)
    damping = 100 / (2 * math.sqrt(2 * 1e5))
    # psi returns to 0 after half a damped period
    assert speed == pytest.approx(math.exp(-math.pi * damping / math.sqrt(1 - damping**2)), 1e-4)
    assert found["N"].min() < -10


def test_clipped_kelvin_voigt_leaves_when_its_force_has_vanished_and_never_pulls():
    found, speed = dropped("clipped_kelvin_voigt", K=1e5, B=100)
    rate = 100 / (2 * 2)
    omega = math.sqrt(1e5 / 2 - rate**2)
    # Schwager and Poeschel, Granular Matter 9 (2007): 2 rate omega/(omega^2 - rate^2)
    turned = math.pi - math.atan(2 * rate * omega / (omega**2 - rate**2))
    assert speed == pytest.approx(math.exp(-rate / omega * turned), 1e-4)
    assert found["N"].min() == 0


@pytest.mark.parametrize("n", [1, 1.5, 2.5])
def test_hunt_crossley_loses_what_its_first_integral_says_for_any_exponent(n):
    c = 0.3
    _, speed = dropped("hunt_crossley", K=1e6, c=c, n=n)
    a = 1.5 * c

    def integral(v):  # of v/(1 - a v) over v, equal at the touch and at the end
        return -v / a - math.log(1 - a * v) / a**2

    assert integral(speed) == pytest.approx(integral(-1.0), rel=1e-4)
    assert speed == pytest.approx(1 - c, abs=0.1)
    assert 0 < speed < 1 / a


def test_hunt_crossley_without_damping_keeps_its_energy():
    found, speed = dropped("hunt_crossley", K=1e6, c=0, n=1.5)
    depth = np.maximum(0, -found["p"])
    energy = found["v"] ** 2 + 1e6 * depth**2.5 / 2.5
    assert np.ptp(energy) < 1e-9
    assert speed == pytest.approx(1, abs=1e-9)


SCENES = [
    ("frictional_contact", {"friction": friction, "contact": contact})
    for friction in ("lugre", "smoothing")
    for contact in ("clipped_kelvin_voigt", "hunt_crossley")
] + [("bouncing_mass", {"contact": "kelvin_voigt"}), ("dry_friction", {"friction": "lugre"})]
CHOSEN = {"N.c": 0.1, "F.F0": 1.0, "F.epsilon": 1e-3, "N.n": 1.5}


@pytest.mark.skipif(find_spec("casadi") is None, reason="casadi is not installed")
@pytest.mark.parametrize(("name", "laws"), SCENES, ids=str)
def test_values_and_jacobians_are_finite_at_rest_at_the_touch_and_in_free_flight(name, laws):
    model = shipped(name, **laws)
    p = [CHOSEN.get(q.name, q.values[0]) for q in model.ode.parameters]
    functions = model.casadi()
    jacobian = functions.rhs.jacobian()
    zero = np.zeros(len(model.x0))
    random = np.random.default_rng(3).normal(size=(20, len(zero)))
    for x in (zero, model.x0, -model.x0, *random, *(random * 1e-9)):
        assert np.isfinite(np.array(functions.rhs(0.0, x, [], p))).all()
        assert np.isfinite(np.array(jacobian(0.0, x, [], p, 0)[1])).all()


@pytest.mark.parametrize(("name", "laws"), SCENES, ids=str)
def test_the_c_and_the_numpy_module_agree_under_every_law(name, laws, compile_c):
    model = shipped(name, **laws)
    p = [CHOSEN.get(q.name, q.values[0]) for q in model.ode.parameters]
    native, module = compile_c(model.ode), load_module(model.ode)
    for x in points(model, 1.0, 50):
        rates = native.rhs(0.0, x, p=p)
        np.testing.assert_allclose(rates, module.rhs(0.0, x, p=p), rtol=1e-12, atol=1e-9)
