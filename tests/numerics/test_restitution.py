"""The cubic of one contact against stiff integration and against runs of the emitted code."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

import nsode
from nsode.analysis import analyze, impact, mapped_restitution
from nsode.analysis.restitution import exponential
from tests.support import MODELS
from tests.support.growth import code_of

BOUNCING = next(path for path in MODELS if path.stem == "bouncing_mass").read_text()


def bounce(ratio: float, kappa: float, weight: float) -> tuple[float, float, float]:
    """Return speed at release, speed at zero gap and depth, by an implicit method."""

    def rates(_: float, z: np.ndarray) -> list[float]:
        gap, speed, e = z
        return [speed, e - ratio * (gap + e) - weight, -(gap + e) / kappa]

    def released(t: float, z: np.ndarray) -> float:
        return z[2] - ratio * (z[0] + z[2]) if t > 1e-6 * kappa else 1.0

    released.terminal, released.direction = True, -1
    found = solve_ivp(
        rates, (0, 1e3), [0.0, -1.0, 0.0], method="Radau", rtol=1e-10, atol=1e-13,
        events=released, dense_output=True,
    )  # fmt: skip
    gap, speed, _ = found.y_events[0][0]
    fine = found.sol(np.linspace(0, found.t[-1], 20001))[0]
    return speed, np.sqrt(max(0.0, speed**2 + 2 * weight * gap)), -fine.min()


@pytest.mark.parametrize("kappa", [0.1, 0.5, 1.58, 5.0])
@pytest.mark.parametrize("ratio", [1.0, 1.5, 4.0, 20.0])
@pytest.mark.parametrize("weight", [0.0, 0.005])
def test_an_impact_is_that_of_a_stiff_integration(ratio, kappa, weight):
    released, measured, depth = bounce(ratio, kappa, weight)
    found = impact(ratio, kappa, weight)
    assert found.released == pytest.approx(released, abs=2e-8)
    assert found.restitution == pytest.approx(measured, abs=2e-8)
    assert found.penetration == pytest.approx(depth, abs=1e-7)


def test_the_map_has_the_value_that_was_derived_independently():
    assert mapped_restitution(2.0, np.sqrt(10) / 2) == pytest.approx(0.770793, abs=5e-7)


@pytest.mark.parametrize(
    ("ratio", "least"),
    [(1.25, 0.887), (2, 0.676), (3, 0.525), (5, 0.373), (10, 0.225), (20, 0.130), (100, 0.032)],
)
def test_the_least_restitution_at_a_ratio_is_the_one_in_the_table(ratio, least):
    found = minimize_scalar(
        lambda kappa: mapped_restitution(ratio, kappa), bounds=(0.01, 2.0), method="bounded"
    )
    # The table was read off a grid of kappa, which can only miss the minimum from above.
    assert least - 1e-3 < found.fun < least + 5e-4
    assert found.fun == pytest.approx(bounce(ratio, found.x, 0.0)[0], abs=2e-8)


def test_the_map_tends_to_an_elastic_impact_on_both_sides():
    assert mapped_restitution(2.0, 1e-5) == pytest.approx(1.0, abs=1e-4)
    assert mapped_restitution(2.0, 1e5) == pytest.approx(1.0, abs=1e-4)
    assert mapped_restitution(1.0, 0.7) == pytest.approx(1.0, abs=1e-12)


def test_the_exponential_is_that_of_scipy():
    from scipy.linalg import expm

    stack = (
        np.random.default_rng(3).normal(size=(20, 4, 4)) * np.geomspace(1e-3, 30, 20)[:, None, None]
    )
    for found, matrix in zip(exponential(stack), stack, strict=True):
        np.testing.assert_allclose(found, expm(matrix), rtol=1e-9, atol=1e-9 * np.abs(found).max())


def figure_5(alpha: float) -> nsode.Model:
    return nsode.loads(BOUNCING.replace("alpha = 5e-3", f"alpha = {alpha}"))


@pytest.mark.parametrize(
    ("alpha", "measured"), [(0.01, 1.0), (0.007, 0.8790), (0.005, 0.7677), (0.001, 0.2829)]
)
def test_the_restitution_of_figure_5_is_the_measured_one(alpha, measured):
    model = figure_5(alpha)
    (contact,) = analyze(model.inclusion, model.ode).contacts
    assert contact.restitution == pytest.approx(measured, abs=2e-3)
    code = code_of(model, model.ode)
    x, h = code["init"](), 1e-4
    while not x[1] > 0:
        before, x = x, code["step_rk4"](0.0, h, x)
    speed_in = np.sqrt(2 * 9.8)
    while x[0] < 0:
        before, x = x, code["step_rk4"](0.0, h, x)
    at_zero = before[1] + (x[1] - before[1]) * before[0] / (before[0] - x[0])
    assert contact.restitution == pytest.approx(at_zero / speed_in, abs=2e-3)


def test_the_three_restitutions_differ_as_they_should():
    model = figure_5(0.001)
    (contact,) = analyze(model.inclusion, model.ode).contacts
    frequency = np.sqrt(1e5)
    seen = impact(10.0, 0.001 * frequency, 9.8 / (np.sqrt(2 * 9.8) * frequency))
    found = [contact.mapped_restitution, seen.released, contact.restitution]
    assert found == pytest.approx([0.2924, 0.2903, 0.2829], abs=5e-5)


def test_penetration_at_an_impact_and_at_rest_are_those_of_a_run():
    model = figure_5(0.005)
    (contact,) = analyze(model.inclusion, model.ode).contacts
    code = code_of(model, model.ode)
    x, deepest = code["init"](), 0.0
    for _ in range(int(0.7 / 1e-4)):
        x = code["step_rk4"](0.0, 1e-4, x)
        deepest = max(deepest, -x[0])
    assert contact.penetration == pytest.approx(deepest, rel=1e-4)
    assert contact.static_penetration == pytest.approx(9.8 / 1e5, rel=1e-12)
    rest = np.array([-9.8e-5, 0.0, 9.8e-5])
    np.testing.assert_allclose(code["rhs"](0.0, rest), 0.0, atol=1e-9)


def test_a_given_impact_speed_is_taken():
    model = figure_5(0.005)
    (contact,) = analyze(model.inclusion, model.ode, impact_speed=30.0).contacts
    assert contact.impact_speed == 30.0
    assert contact.restitution == pytest.approx(contact.mapped_restitution, abs=5e-4)
