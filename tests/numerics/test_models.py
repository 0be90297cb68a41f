"""Each shipped model does what its physics says, by closed forms that nsode does not know."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import nsode
from nsode.simulate import Mode
from support import MODELS

BY_NAME = {path.stem: path for path in MODELS}


def model(name):
    return nsode.load(BY_NAME[name])


def first(condition):
    return int(np.flatnonzero(condition)[0])


@pytest.mark.parametrize("name", BY_NAME)
def test_a_shipped_model_runs_as_it_stands_without_a_warning(name):
    run = model(name).simulate(strict=True)
    assert np.isfinite(run.x).all()


def test_a_dropped_mass_touches_down_after_the_time_of_free_fall():
    run = model("bouncing_mass").simulate()
    touched = run.t[first(run.mode("f") == Mode.CONTACT)]
    assert abs(touched - math.sqrt(2 * 1 / 9.8)) <= 1e-3  # a step


def test_friction_takes_mu_times_the_impulse_of_the_contact():
    run = model("frictional_contact").simulate()
    before, after = run["v"][0], run["v"][-1]
    lost = np.hypot(*before[:2]) - np.hypot(*after[:2])
    assert lost == pytest.approx(0.3 * (after[2] - before[2]), rel=5e-3)
    assert after[1] / after[0] == pytest.approx(0.5, rel=1e-9)


def test_the_load_of_the_belt_breaks_away_when_the_belt_pulls_as_much_as_it_holds():
    run = model("belt_drive").simulate(2)
    J1, k, c, kp, ref, Ts = 2e-3, 4, 8e-3, 2, 0.8, 0.6
    rates = np.roots([J1, kp + c, k])  # the motor against the belt of a load at rest
    shares = np.linalg.solve([[1, 1], rates], [-kp * ref / k, 0])
    t = np.linspace(0, 1, 100_001)
    modes = np.exp(np.outer(t, rates))
    angle, speed = kp * ref / k + modes @ shares, modes @ (shares * rates)
    expected = t[first(k * angle + c * speed >= Ts)]
    assert run.t[first(run.mode("T") == Mode.SLIP)] == pytest.approx(expected, rel=5e-3)


def test_one_block_under_constant_friction_waits_and_then_moves_in_waves():
    text = BY_NAME["burridge_knopoff"].read_text().replace("n = 32", "n = 1")
    run = nsode.loads(text).simulate(parameters={"vc": 1e9})
    V, omega, level, start = 0.01, math.sqrt(10), 2 + 0.5 * math.sin(5), 0.02 * math.sin(3)
    breakaway = (level / 10 + start) / V
    tau = np.maximum(0, run.t - breakaway)
    expected = start + V * (tau - np.sin(omega * tau) / omega)
    assert np.abs(run["x[1]"] - expected).max() < level / 1e4  # the presliding


def test_the_fault_slips_in_events_of_every_size_and_keeps_up_with_the_plate():
    run = model("burridge_knopoff").simulate()
    moving = run["v"] > 1e-3
    assert moving.mean() < 0.2
    edges = np.flatnonzero(np.diff(moving.any(axis=1)))
    sizes = [int(rows.any(axis=0).sum()) for rows in np.split(moving, edges + 1)]
    assert {1, 2, 32} < set(sizes)
    assert len({size for size in sizes if 2 < size < 32}) >= 3
    gap = 0.01 * run.t - run["x"].mean(axis=1)
    assert np.abs(gap).max() < 2 * 2.5 / 10  # a level is held, and overshot at most as much


def test_a_pendulum_loses_by_dry_friction_the_work_of_its_way():
    text = BY_NAME["cart_pole"].read_text()
    held = nsode.loads(text).with_parameters({"Fc": 1e3, "F.K": 1e6, "mc": 1e3})
    run = held.simulate(8, step=1e-4, x0={"phi": 0.6})
    phi, w = run["phi"], run["w"]
    turns = np.concatenate([[0.6], np.abs(phi[np.flatnonzero(w[1:-1] * w[2:] < 0) + 1])])
    assert len(turns) > 8
    height = 0.2 * 9.81 * 0.4 * (1 - np.cos(turns))
    work = 4e-3 * (turns[:-1] + turns[1:])
    np.testing.assert_allclose(-np.diff(height), work, rtol=5e-3)


def test_a_pendulum_under_a_free_cart_swings_at_the_frequency_of_the_pair():
    smooth = model("cart_pole").with_parameters({"Fc": 0, "T0": 0})
    run = smooth.simulate(10, x0={"phi": 1e-3})
    crossings = run.t[1:][np.diff(np.sign(run["phi"])) != 0]
    period = 2 * np.diff(crossings).mean()
    assert period == pytest.approx(2 * math.pi / math.sqrt(9.81 * 1.2 / (0.4 * 1)), rel=1e-4)


def rectified(L=0.05, C=2e-3, Rs=0.5, R=40, U=20, omega=314.159265, end=0.3):
    """Return the current and voltage of an ideal rectifier, switched by events."""

    def source(t):
        return U * math.sin(omega * t)

    def conducting(t, y):
        return [(source(t) - y[1] - Rs * y[0]) / L, (y[0] - y[1] / R) / C]

    def blocking(t, y):
        return [0.0, -y[1] / R / C]

    def opens(t, y):
        return y[0]

    def closes(t, y):
        return source(t) - y[1]

    opens.terminal, opens.direction = True, -1
    closes.terminal, closes.direction = True, 1
    pieces, t, y, rates, event = [], 0.0, [0.0, 0.0], conducting, opens
    while t < end:
        piece = solve_ivp(
            rates, (t, end), y, events=event, dense_output=True, rtol=1e-10, atol=1e-12
        )
        pieces.append((t, piece.sol))
        t, y = piece.t[-1], piece.y[:, -1]
        if event is opens:
            rates, event, y = blocking, closes, [0.0, y[1]]
        else:
            rates, event = conducting, opens
    return pieces


def test_the_rectifier_agrees_with_one_whose_diode_is_switched_by_events():
    run = model("diode_circuit").simulate()
    pieces = rectified()
    assert len(pieces) > 20
    begins = [t for t, _ in pieces]
    expected = np.array([pieces[np.searchsorted(begins, t, "right") - 1][1](t) for t in run.t])
    gap = 30 / 2000  # what blocks 30 V lets through, a reverse current, at K = 2 kOhm
    assert np.abs(run["i"] - expected[:, 0]).max() < 2 * gap
    assert np.abs(run["vc"] - expected[:, 1]).max() < 0.02 * expected[:, 1].max()


def test_a_column_at_rest_carries_in_each_contact_what_stands_above_it():
    run = model("granular_column").simulate(3)
    above = 0.01 * 9.81 * np.arange(10, 0, -1)
    np.testing.assert_allclose(run["N"][-1], above, rtol=1e-6)
    pressed = np.cumsum(above / 2e4)
    np.testing.assert_allclose(run["z"][-1], 0.02 * (np.arange(10) + 0.5) - pressed, atol=1e-9)


def test_the_column_falls_freely_until_its_lowest_ball_touches():
    run = model("granular_column").simulate(0.1)
    touched = run.t[first((run["N"] > 0).any(axis=1))]
    assert touched == pytest.approx(math.sqrt(2 * 0.004 / 9.81), abs=5e-5)


@pytest.mark.parametrize(("share", "holds"), [(1.03, True), (0.97, False)])
def test_the_grip_holds_from_half_the_weight_and_shake_over_mu_on(share, holds):
    least = 0.5 * (9.81 + 0.02 * 12**2) / (2 * 0.5)
    run = model("gripper").with_parameters({"G": share * least}).simulate(2.1)
    hand = 0.02 * (1 - np.cos(12 * run.t))
    offset = run["p.y"] - hand
    period = round(2 * math.pi / 12 / 1e-4)
    lost = offset[-1 - 2 * period] - offset[-1]
    assert abs(lost) < 1e-9 if holds else lost > 1e-4


def test_the_handle_follows_the_hand_to_the_edge_of_the_cone_of_friction():
    t = np.array([0.0, 1.0, 21.0, 30.0])
    run = model("haptic_wall").simulate(
        25, every=1000, inputs={"hand.x": -0.01, "hand.y": (t, [0, 0, 0.02, 0.02])}
    )
    assert run["p.y"][-1] == pytest.approx(0.02 - 0.4 * 0.01, abs=6.8 * 1e-3 / 250)
    assert run["N"][-1] == pytest.approx(250 * 0.01, rel=0.01)


def test_the_leg_stands_on_its_spring_when_nothing_pumps():
    run = model("hopping_leg").with_parameters({"A": 0}).simulate(30, every=100)
    assert run["y"][-1] - run["yf"][-1] == pytest.approx(0.5 - 2 * 9.81 / 1200, abs=1e-6)
    assert run["N"][-1] == pytest.approx(2.3 * 9.81, rel=1e-5)


def test_in_flight_the_leg_falls_as_a_whole_whatever_moves_inside():
    run = model("hopping_leg").simulate()
    momentum = 2 * run["v"] + 0.3 * run["vf"]
    flying = run["N"] == 0
    inside = flying[:-2] & flying[1:-1] & flying[2:]
    assert 0.3 < inside.mean() < 0.9
    assert run.mode("S").max() == Mode.CONTACT
    rate = np.diff(momentum)[1:][inside] / 2e-4
    assert np.abs(rate + 2.3 * 9.81).max() < 1e-6
