"""Steps under laws other than the paper's: closed forms, and runs on both sides of the limit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import nsode
from nsode.analysis.quick import foresee
from nsode.ode import Run, element_names
from nsode.simulate import Manner, RunWarning, Wish, simulate
from support.models import MODELS

REAL = 2.785293563405282  # the end of RK4's region on the real axis
PRESSED = """model pressed
state p = -4e-3
state v = 0
force N = dio(p)
der(p) = v
2*der(v) = N - 80
approximate N {law}
"""
STUCK = """model stuck
state v = 0
force F = 3*sgn(v)
2*der(v) = -F
approximate F {law}
"""
SLIDING = STUCK.replace("v = 0", "v = 5")


def roots(*coefficients):
    return np.roots(coefficients)


def least(values):
    """Return the step at which RK4 leaves its region along some modes, by its polynomial."""
    steps = []
    for value in values:
        inner, outer = 0.0, 10 / abs(value)
        for _ in range(60):
            z = (inner + outer) / 2 * value
            grows = abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) > 1
            inner, outer = (inner, (inner + outer) / 2) if grows else ((inner + outer) / 2, outer)
        steps.append(inner)
    return min(steps)


# (text, law, the modes by hand)
CASES = {
    "kelvin_voigt": (PRESSED, "kelvin_voigt: K = 2e4, B = 150", roots(2, 150, 2e4)),
    "clipped": (PRESSED, "clipped_kelvin_voigt: K = 2e4, B = 600", roots(2, 600, 2e4)),
    "hunt_crossley": (
        PRESSED,  # pressed 4 mm by 80 N: damped by 3/2 c K d
        "hunt_crossley: K = 2e4, c = 2",
        roots(2, 1.5 * 2 * 80, 2e4),
    ),
    "hertz": (
        PRESSED.replace("-4e-3", "-1e-3"),  # pressed by 80 N to d, with K d^(3/2) = 80
        "hunt_crossley: K = 2e6, c = 2, n = 1.5",
        roots(2, 1.5 * 2 * 80, 1.5 * 2e6 * (80 / 2e6) ** (1 / 3)),
    ),
    "smoothing": (STUCK, "smoothing: epsilon = 1e-3", np.array([-3 / (2 * 1e-3)])),
    "lugre that sticks": (STUCK, "lugre: K = 1e4, B = 50, D = 4", roots(2, 54, 1e4)),
    "lugre that slides": (SLIDING, "lugre: K = 1e4, B = 0, D = 0", np.array([-1e4 * 5 / 3])),
}


def model_of(case):
    text, law, _ = CASES[case]
    return nsode.loads(text.replace("{law}", f"with {law}"))


def limit(model, step=1.0):
    """Return the limit that is announced to a run of too large a step."""
    inclusion = replace(model.inclusion, run=Run(step=step, method="rk4"))
    [said] = foresee(inclusion).diagnostics
    assert said.code == "NS407"
    return float(said.message.rpartition(": ")[2].removesuffix(" s"))


@pytest.mark.parametrize("case", CASES)
def test_the_limit_is_that_of_the_modes_by_hand(case):
    assert limit(model_of(case)) == pytest.approx(least(CASES[case][2]), rel=6e-3)  # three digits


def test_lugre_that_slides_at_a_speed_takes_the_step_that_its_law_says():
    assert limit(model_of("lugre that slides")) == pytest.approx(REAL * 3 / (1e4 * 5), rel=6e-3)


DROPPED = """model dropped
state p = 1
state v = 0
force N = dio(p)
der(p) = v
2*der(v) = N - 20
approximate N {law}
simulate 1 step 1e-3
"""


@pytest.mark.parametrize("K", [1e61, 1e150, 1e300])
@pytest.mark.parametrize(
    ("law", "stiffer"), [(": beta = 9e-3, alpha = 1e-3", 9), ("with kelvin_voigt: B = 1", 1)]
)
def test_a_step_beyond_any_that_a_huge_stiffness_leaves_is_told_of(K, law, stiffer):
    found = nsode.loads(DROPPED.replace("{law}", f"{law}, K = {K}"))
    [warning] = [d for d in found.diagnostics if d.code == "NS407"]
    told = float(warning.message.split()[-2])
    # the Zener solid is K*beta/alpha when fast; RK4 holds an undamped mode up to 2 sqrt(2)
    assert told == pytest.approx(2 * np.sqrt(2) / np.sqrt(K * stiffer / 2), rel=1e-2)


@pytest.mark.parametrize("method", ["heun", "euler", "verlet"])
def test_so_it_is_where_the_method_itself_tells_nothing_of_it(method):
    law = f": beta = 9e-3, alpha = 1e-3, K = 1e150\nsimulate 1 step 1e-3 method {method}"
    text = DROPPED.replace("simulate 1 step 1e-3\n", "").replace("{law}", law)
    [warning] = [d for d in nsode.loads(text).diagnostics if d.code == "NS407"]
    assert "the step 0.001 s is beyond what rk4 can take" in warning.message


# At rest on its contact, or stuck: a deviation small enough to stay there
SMALL = {
    "kelvin_voigt": {"p": -4e-3 - 1e-9},
    "clipped": {"p": -4e-3 - 1e-9},
    "hunt_crossley": {"p": -4e-3 - 1e-9},
    "hertz": {"p": -((80 / 2e6) ** (2 / 3)) - 1e-9},
    "smoothing": {"v": 1e-12},
    "lugre that sticks": {"v": 1e-12},
}


@pytest.mark.parametrize("case", SMALL)
def test_runs_diverge_beyond_the_limit_and_not_below_it(case):
    model = model_of(case)
    exact = least(CASES[case][2])

    def growth(step):
        found = model.simulate(80 * step, step, method="rk4", x0=SMALL[case])
        rest = np.array([rest_of(case)[name] for name in element_names(model.ode.states)])
        away = np.abs(found.x - rest).max(axis=1)
        return away[60:].max() / away[20:41].max()

    assert growth(0.98 * exact) < 1
    with pytest.warns(RunWarning, match="beyond what rk4 can take"):
        assert growth(1.02 * exact) > 1


def rest_of(case):
    gap = -((80 / 2e6) ** (2 / 3)) if case == "hertz" else -4e-3
    return {"p": gap, "v": 0.0, "F.a": 0.0}


def test_contact_and_friction_of_two_laws_are_looked_at_together():
    text = (MODELS / "rolling_sphere.di").read_text()
    model = nsode.loads(text.replace("F: K = 1e5 {N/m}, beta = 4e-3 {s}", LUGRE))
    # it arrives sliding at 5.5 m/s, which wears the bristles at K |theta|/F0
    assert limit(model) == pytest.approx(REAL / (1e5 * 5.5), rel=2e-2)


LUGRE = "F with lugre: K = 1e5 {N/m}, B = 0 {N*s/m}, F0 = 1 {N}"


def test_a_step_within_what_was_found_is_a_note_that_tells_how_little_that_is():
    model, said = model_of("smoothing"), []
    simulate(model.inclusion, model.ode, Wish(0.1, 1e-4), manner=Manner(tell=said.append))
    assert [d.code for d in said] == ["NS410"]
    assert "a few states were looked at" in said[0].notes[0]


def test_a_strict_run_beyond_the_limit_of_another_law_is_refused():
    with pytest.raises(nsode.diagnostics.ModelError, match="beyond what rk4 can take"):
        model_of("smoothing").simulate(1, 1e-2, strict=True)
