"""The ledger of stored and dissipated energy against the energy of the bodies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import nsode
from nsode.analysis import ledger
from nsode.ode import element_names
from tests.support import MODELS
from tests.support.growth import code_of

BY_NAME = {path.stem: path for path in MODELS}


@dataclass
class Books:
    """What flows through a run: kinetic and potential energy, stored, dissipated, given."""

    body: NDArray
    stored: NDArray
    lost: NDArray
    given: NDArray


def energy_of_the_bodies(name: str, state: dict[str, NDArray], p: dict[str, float]) -> NDArray:
    """Return kinetic and potential energy, written by hand."""
    match name:
        case "bouncing_mass":
            return 0.5 * p["M"] * state["v"] ** 2 - p["fe"] * state["p"]
        case "rolling_sphere":
            speed = sum(state[f"v.{c}"] ** 2 for c in "xyz")
            spin = sum(state[f"w.{c}"] ** 2 for c in "xyz")
            turning = 0.2 * p["M"] * p["R"] ** 2 * spin
            return 0.5 * p["M"] * speed + turning + p["M"] * p["g"] * state["p.z"]
        case "two_blocks_conveyor":
            one = sum(state[f"v1.{c}"] ** 2 for c in "xy")
            two = sum(state[f"v2.{c}"] ** 2 for c in "xy")
            springs = 0.5 * p["Ks"] * state["p1.y"] ** 2
            return (
                0.5 * p["M1"] * one
                + 0.5 * p["M2"] * two
                + springs
                + p["M2"] * p["g"] * state["p2.y"]
            )
        case _:
            raise AssertionError(name)


def keep(name: str, duration: float, step: float | None) -> tuple[NDArray, Books, NDArray]:
    """Run a model with its ledger; ``step`` None takes an adaptive method at 1e-12."""
    model = nsode.load(BY_NAME[name])
    code = code_of(model, ledger(model.ode, model.inclusion))
    outputs, states = code["y_names"], element_names(model.ode.states)
    flows = [k for k, y in enumerate(outputs) if y.endswith((".dissipated", ".given"))]

    def both(t: float, z: NDArray) -> NDArray:
        x = z[: len(states)]
        return np.concatenate([code["rhs"](t, x), code["out"](t, x)[flows]])

    begin = np.concatenate([code["init"](), np.zeros(len(flows))])
    if step is None:
        found = solve_ivp(
            both, (0, duration), begin, method="DOP853", rtol=1e-12, atol=1e-13, max_step=2e-3
        )
        times, path = found.t, found.y.T
    else:
        times, path = _fixed(both, begin, duration, step)
    values = np.array([code["out"](t, z[: len(states)]) for t, z in zip(times, path, strict=True)])
    sums = {outputs[k]: path[:, len(states) + n] for n, k in enumerate(flows)}
    state = {s: path[:, k] for k, s in enumerate(states)}
    p = dict(zip(code["p_names"], code["p0"], strict=True))
    books = Books(
        energy_of_the_bodies(name, state, p),
        sum(values[:, k] for k, y in enumerate(outputs) if y.endswith(".stored")),
        sum(v for y, v in sums.items() if y.endswith(".dissipated")),
        sum(v for y, v in sums.items() if y.endswith(".given")),
    )
    return times, books, np.array([values[:, k] for k in flows])


def _fixed(rhs, z: NDArray, duration: float, h: float) -> tuple[NDArray, NDArray]:
    """The classical Runge-Kutta method, written by hand."""
    count = round(duration / h)
    path = [z]
    for n in range(count):
        t = n * h
        k1 = rhs(t, z)
        k2 = rhs(t + h / 2, z + h / 2 * k1)
        k3 = rhs(t + h / 2, z + h / 2 * k2)
        k4 = rhs(t + h, z + h * k3)
        z = z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        path.append(z)
    return h * np.arange(count + 1), np.array(path)


@pytest.mark.parametrize(("name", "duration"), [("bouncing_mass", 0.6), ("rolling_sphere", 0.5)])
def test_the_ledger_closes_to_1e_9_of_the_energy_moved(name, duration):
    _, books, _ = keep(name, duration, None)
    moved = np.abs(np.diff(books.body)).sum()
    total = books.body + books.stored + books.lost
    assert books.lost[-1] > 1e-3 * moved
    assert np.ptp(total) < 1e-9 * moved


def test_what_an_element_is_given_is_what_it_stores_and_dissipates():
    _, books, _ = keep("two_blocks_conveyor", 0.35, None)
    moved = books.lost[-1] + np.abs(books.given).max()
    assert books.lost[-1] > 0.05
    assert np.ptp(books.given - books.stored - books.lost) < 1e-9 * moved


@pytest.mark.parametrize("name", ["bouncing_mass", "rolling_sphere", "two_blocks_conveyor"])
def test_no_element_stores_or_dissipates_less_than_nothing(name):
    _, books, flows = keep(name, 0.5, 5e-4)
    outputs = [y for y in _names(name) if y.endswith((".dissipated", ".given"))]
    scale = np.abs(flows).max()
    for word, flow in zip(outputs, flows, strict=True):
        if word.endswith(".dissipated"):
            assert flow.min() >= -1e-12 * scale
    assert books.stored.min() >= 0


def _names(name: str) -> list[str]:
    model = nsode.load(BY_NAME[name])
    return element_names(ledger(model.ode, model.inclusion).outputs)


def test_the_residual_falls_with_an_order_of_at_least_one_and_a_half_across_kinks():
    steps = np.array([2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5])
    residuals = []
    for h in steps:
        _, books, _ = keep("bouncing_mass", 0.56, float(h))
        residuals.append(np.ptp(books.body + books.stored + books.lost))
    order = np.polyfit(np.log(steps), np.log(residuals), 1)[0]
    assert order >= 1.5


def test_a_model_in_which_force_and_gap_do_not_agree_shows_in_the_ledger():
    # The floor pushes with half of its force: the bodies get less than the elements give.
    text = BY_NAME["bouncing_mass"].read_text().replace("fe + f", "fe + 0.5*f")
    model = nsode.loads(text)
    code = code_of(model, ledger(model.ode, model.inclusion))
    x = np.array([-1e-3, 0.3, 0.0])
    out = dict(zip(code["y_names"], code["out"](0.0, x), strict=True))
    power_of_the_body = model.p0[0] * x[1] * code["rhs"](0.0, x)[1] + 9.8 * x[1]
    assert -out["f.given"] == pytest.approx(2 * power_of_the_body, rel=1e-12)
