"""What the paper's systems do, by their own compiled run."""

from __future__ import annotations

import math

import numpy as np
import pytest

import nsode
from nsode.simulate import Mode
from support.models import MODELS
from support.paper import EQUATIONS

EPS = np.finfo(float).eps


def run(name, *args, **kwargs):
    return nsode.load(MODELS / f"{name}.di").simulate(*args, **kwargs)


def by_hand(name, names, x, p, step, steps):
    """Return the state after some steps of RK4 on the equations that the paper prints."""

    def rates(t, x):
        found = EQUATIONS[name](t, dict(zip(names, x, strict=True)), p)
        return np.array([float(found[state]) for state in names])

    for i in range(steps):
        t = i * step
        k1 = rates(t, x)
        k2 = rates(t + step / 2, x + step / 2 * k1)
        k3 = rates(t + step / 2, x + step / 2 * k2)
        k4 = rates(t + step, x + step * k3)
        x = x + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return x


@pytest.mark.parametrize("name", EQUATIONS)
def test_half_a_second_agrees_with_the_printed_equations_coded_by_hand(name):
    found = run(name, 0.5)
    step = found.meta["run"]["step"]
    steps = round(0.5 / step)
    p = found.meta["parameters"]
    expected = by_hand(name, found.x_names, found.x[0], p, step, steps)
    assert len(found) == steps + 1
    np.testing.assert_allclose(found.x[-1], expected, rtol=1e-8, atol=1e-8)


def test_the_sphere_ends_up_rolling_at_five_sevenths_of_its_speed():
    run_of_it = run("rolling_sphere")
    assert run_of_it["v.x"][-1] == pytest.approx(5.5 * 5 / 7, rel=1e-6)
    assert run_of_it["w.y"][-1] * 0.5 == pytest.approx(run_of_it["v.x"][-1], rel=1e-9)
    assert run_of_it.mode("F")[-1] == Mode.STICK
    assert np.linalg.norm(run_of_it["q"], axis=1) == pytest.approx(1.0, abs=1e-6)


def test_stuck_friction_does_not_creep_in_ten_million_steps():
    # 40 pi rad/s at 1 ms are 50 steps a period, so rows lie at equal phase.
    found = run("dry_friction", 1e4, 1e-3, every=50, parameters={"omega": 40 * math.pi})
    settled = found["p"][found.t >= 10]
    assert len(settled) == 199_801
    assert np.ptp(settled) < 1e-12
    assert settled[0] > 0.02  # it had moved before


def speed_at_zero(gap, velocity, row):
    share = gap[row] / (gap[row] - gap[row + 1])
    return abs(velocity[row] + share * (velocity[row + 1] - velocity[row]))


@pytest.mark.parametrize(
    ("alpha", "restitution"), [(1e-2, 1.0), (7e-3, 0.8790), (5e-3, 0.7677), (1e-3, 0.2829)]
)
def test_the_first_bounce_of_figure_5_returns_the_measured_share(alpha, restitution):
    found = run("bouncing_mass", 1.0, 1e-4, parameters={"f.alpha": alpha})
    gap, velocity = found["p"], found["v"]
    into, out_of = np.flatnonzero(np.diff(gap > 0))[:2]
    ratio = speed_at_zero(gap, velocity, out_of) / speed_at_zero(gap, velocity, into)
    assert ratio == pytest.approx(restitution, abs=0.002)


def test_friction_stays_within_its_level_and_contact_never_pulls():
    sphere = run("rolling_sphere")
    assert np.all(np.hypot(sphere["F.x"], sphere["F.y"]) <= 0.1 * sphere["N"] * (1 + 4 * EPS))
    assert np.all(sphere["N"] >= 0)
    blocks = run("two_blocks_conveyor", 5.0)
    for i in "123":
        assert np.all(np.abs(blocks[f"F{i}"]) <= 0.5 * blocks[f"N{i}"] * (1 + 4 * EPS))
        assert np.all(blocks[f"N{i}"] >= 0)


def test_the_blocks_come_to_rest_at_a_stable_step_and_never_at_the_papers():
    stable = run("two_blocks_conveyor", 10.0)
    assert np.abs(stable["v1"][-1]).max() < 1e-12
    with pytest.warns(nsode.simulate.RunWarning) as told:
        unstable = run("two_blocks_conveyor", 10.0, 1e-3)
    assert "beyond what rk4 can take" in str(told[0].message)
    tail = unstable["v1"][unstable.t > 8]
    assert 1e-5 < np.abs(tail).max() < 1


def test_the_belt_at_walking_speed_does_not_test_stick_and_a_slow_one_does():
    fast = run("belt_oscillator", 50.0, every=20)
    slow = run("belt_oscillator", 50.0, every=20, parameters={"u": 0.1})
    assert np.mean(fast.mode("Fc") == Mode.STICK) < 1e-3
    assert np.mean(slow.mode("Fc") == Mode.STICK) > 0.05


def test_time_is_a_product_and_not_a_sum():
    found = run("dry_friction", 100.0, 1e-3, every=10)
    assert np.array_equal(found.t, np.arange(0, 100_001, 10) * 1e-3)
