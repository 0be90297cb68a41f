"""Verlet's splitting: orders, stable steps, errors beside a fine run, and the laws' bounds."""

from __future__ import annotations

import numpy as np
import pytest

import nsode
from nsode.analysis import sets
from nsode.analysis.amplification import Split
from nsode.analysis.mass import component_names
from nsode.analysis.scene import Scene
from nsode.analysis.steps import reachable
from nsode.backends import c
from nsode.backends.casadi import functions
from nsode.diagnostics import ModelError
from nsode.integrators.splittings import SPLITTINGS
from nsode.integrators.verlet import VERLET, carries, velocities
from nsode.ode import element_names
from nsode.simulate import Mode, RunWarning, scene
from support.models import MODELS

EPS = np.finfo(float).eps

SPRING = """model spring
state p = 1
state v = 0
der(p) = v
der(v) = -p + sin(2*t)
"""
# Held down by a hundred times its weight: it presses all the time.
PRESSED = """model pressed
parameter M = 1
parameter fe = -1e3
state p = -1e-2
state v = 0
force N = dio(p)
der(p) = v
M*der(v) = fe + N
approximate N: K = 1e5, alpha = 1.6e-3, beta = 3.74e-3
"""
# Far below its level, friction never slips.
STUCK = """model stuck
parameter M = 1
state v = 0
force F = 1e9*sgn(v)
M*der(v) = 500*sin(30*t) - F
approximate F: K = 1e5, beta = 4.3e-3
"""
# Slides across its load, which turns and swells.
SLIDING = """model sliding
state v[2] = [3, 0]
force F = abs(2 + sin(3*t))*sgn(v)
der(v) = [0, 2] - F
approximate F: K = 1e3, beta = 0.1
"""
BALL = """model ball
parameter M = 1
parameter fe = -9.8
state p = 1
state v = 0
force N = dio(p)
der(p) = v
M*der(v) = fe + N
approximate N: K = 1e5, alpha = 1.6e-3, beta = 3.74e-3
"""
BELT = """model belt
parameter M = 1
parameter k = 1
parameter u = 1
state p = 0
state v = 0
force F = 1*sgn(v - u)
der(p) = v
M*der(v) = -k*p - F
approximate F: K = 1e5, beta = 4.3e-3
"""


def error(text, duration, step, **kwargs):
    """Return the error of all states at the end, against RK4 at a small step."""
    model = nsode.loads(text)
    fine = model.simulate(duration, duration / 200_000, every=200_000, **kwargs)
    found = model.simulate(duration, step, method="verlet", **kwargs)
    return np.abs(found.x[-1] - fine.x[-1]).max()


# (text, duration, start, numbers of steps, order)
ORDERS = {
    "a driven spring": (SPRING, 5.0, {}, (100, 200, 400), 2),
    "contact": (PRESSED, 0.05, {"p": -0.011, "N.e": 0.01}, (200, 400, 800), 2),
    "stick": (STUCK, 0.05, {}, (3200, 6400, 12_800), 1),
    "slip": (SLIDING, 0.5, {"F.a.x": 5e-3}, (100, 200, 400), 1),
}


@pytest.mark.parametrize("stretch", ORDERS)
def test_the_order_is_two_and_one_where_a_force_reads_velocities(stretch):
    text, duration, start, counts, order = ORDERS[stretch]
    errors = [error(text, duration, duration / steps, x0=start) for steps in counts]
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx(order, abs=0.15)


# NUMERICS of this method, measured elsewhere: K = 1e5 N/m and M = 1 kg


def growth(text, step, start, rest):
    """Return by how much a small deviation grows in forty steps."""
    found = nsode.loads(text).simulate(80 * step, step, method="verlet", x0=start)
    away = np.abs(found.x - rest)
    return away[60:].max() / away[20:41].max()


PRESSED_AT_REST = np.array([-1e-2, 0.0, 1e-2])
STUCK_AT_REST = np.zeros(2)


@pytest.mark.filterwarnings("ignore:a step of .* does not resolve the impacts")
@pytest.mark.parametrize(
    ("text", "start", "rest", "limit"),
    [
        (PRESSED, {"p": -1e-2 - 1e-6, "N.e": 1e-2}, PRESSED_AT_REST, 4.0e-3),
        (STUCK.replace("500*sin(30*t)", "0"), {"v": 1e-6}, STUCK_AT_REST, 8.9e-3),
    ],
    ids=["contact", "stick"],
)
def test_deviations_grow_from_the_step_on_that_was_measured(text, start, rest, limit):
    assert growth(text, 0.95 * limit, start, rest) < 1
    with pytest.warns(RunWarning, match="beyond what verlet can take"):
        assert growth(text, 1.06 * limit, start, rest) > 1


# the predicted limit, against what the compiled step does to small deviations

PLANAR = """model planar
state z = 0
state w = 0
state v[2] = [0.3, 0.4]
force N = dio(z)
force F = 0.3*N*sgn(v - [1, 0])
der(z) = w
der(w) = N - 50 - 4*w
2*der(v) = [0.2*N, 0] - F
approximate N: K = 2e4, alpha = 1e-3, beta = 3e-3
approximate F: K = 5e4, beta = 2e-3
"""
RESTING = {
    "pressed": PRESSED,
    "stuck": STUCK.replace("500*sin(30*t)", "0"),
    "stuck in the plane, across its load": PLANAR,
    "a gripper that holds": (MODELS / "gripper.di").read_text().replace("A  = 0.02", "A  = 0"),
    "ten balls": (MODELS / "granular_column.di").read_text(),
    "two blocks": (MODELS / "two_blocks_conveyor.di").read_text(),
}
OFF = 1e-8


def amplification(model, rest, h):
    """Return what a step makes of each small deviation from a state of rest."""
    names = element_names(model.ode.states)
    ends = [
        [
            model.simulate(h, h, method="verlet", guard=False, x0=dict(zip(names, x, strict=True)))
            for x in (rest + OFF * away, rest - OFF * away)
        ]
        for away in np.eye(len(rest))
    ]
    return np.array([plus.x[-1] - minus.x[-1] for plus, minus in ends]).T / (2 * OFF)


def active(scene, run):
    """Return what each element does at the end of a run, as the analysis has it."""
    found = []
    for element in scene.elements:
        kind = Mode(run.modes[-1, run.mode_names.index(element.name)]).name.lower()
        if kind == "slip":
            rows = ("",) if len(element.rows) == 1 else (".x", ".y")
            force = np.array([run[f"{element.name}{row}"][-1] for row in rows])
            found.append(sets.Mode("slip", tuple(force / np.linalg.norm(force))))
        else:
            idle = "open" if element.is_contact else "free"
            found.append(sets.Mode(idle if kind == "free" else kind))
    known = (sets.OPEN, sets.CONTACT, sets.STICK, sets.FREE)
    return tuple(next((k for k in known if k == mode), mode) for mode in found)


@pytest.mark.filterwarnings("ignore::nsode.simulate.RunWarning")
@pytest.mark.parametrize("name", RESTING)
def test_a_step_amplifies_deviations_as_is_predicted(name):
    model = nsode.loads(RESTING[name])
    settled = model.simulate(30, 2e-5, every=100_000, guard=False)
    scene = Scene(model.inclusion)
    local = scene.at(scene.point(settled.x[-1]), settled_forces(scene, settled))
    here = active(scene, settled)
    place = reachable(scene, local)
    limit = place.worst(VERLET, place.modes([here]))
    for h in (0.3 * limit.step, 0.99 * limit.step, 1.01 * limit.step):
        predicted = Split.of(scene, local, scene.constants, [here]).step(h)[0]
        measured = amplification(model, settled.x[-1], h)
        np.testing.assert_allclose(measured, predicted, rtol=1e-5, atol=1e-5)
        moving = np.abs(np.linalg.eigvals(measured) - 1) > 1e-3
        largest = np.abs(np.linalg.eigvals(measured)[moving]).max()
        assert (largest > 1) == (h > limit.step)


def settled_forces(scene, run):
    names = component_names(scene.elements)
    return np.array([run[name][-1] for name in names])


@pytest.mark.parametrize("path", sorted(MODELS.glob("*.di")), ids=lambda path: path.stem)
def test_velocities_are_the_same_before_and_after_the_rewrite(path):
    model = nsode.load(path)
    assert velocities(model.inclusion) == velocities(model.ode)


@pytest.mark.parametrize(
    ("text", "duration", "measured"),
    [(BALL, 1.0, 1.8e-2), (BELT, 5.0, 2.0e-7)],
    ids=["ball", "belt"],
)
def test_the_error_at_a_step_of_a_millisecond_is_the_one_measured(text, duration, measured):
    model = nsode.loads(text)
    fine = model.simulate(duration, 1e-5, every=100)
    found = model.simulate(duration, 1e-3, method="verlet")
    assert 0.5 * measured < np.abs(found["p"] - fine["p"]).max() < 2 * measured


# the flows, against their closed forms, over steps as long as several time constants

HELD = """model held
parameter gap = -1e-3
parameter slip = 2
state p = gap
state s = slip
state v = 0
state w = 0
force N = dio(p)
force F = 3*sgn(s)
der(p) = 0
der(s) = 0
der(v) = N
der(w) = -F
approximate N: K = 1e5, alpha = 2e-3, beta = 5e-3
approximate F: K = 1e3, beta = 4e-3
"""


@pytest.mark.parametrize("h", [1e-5, 1e-3, 1e-2])
@pytest.mark.parametrize(
    ("gap", "start", "flow"),
    [
        (-1e-3, 2e-4, lambda h: 1e-3 + (2e-4 - 1e-3) * np.exp(-h / 2e-3)),
        (1e-3, 2e-4, lambda h: 2e-4 * np.exp(-h / 5e-3)),
        (1e-3, 0.0, lambda h: 0.0 * h),
    ],
    ids=["pressed", "open", "at rest"],
)
def test_e_follows_its_exact_flow_under_a_gap_that_holds(gap, start, flow, h):
    given = {"gap": gap}
    found = nsode.loads(HELD).simulate(
        h, h, method="verlet", parameters=given, x0={"p": gap, "N.e": start}
    )
    assert found["N.e"][-1] == pytest.approx(flow(h), rel=1e-12, abs=1e-18)


@pytest.mark.parametrize("h", [1e-5, 1e-3, 1e-2])
@pytest.mark.parametrize(
    ("slip", "start", "flow"),
    [
        (1e-3, 1e-4, lambda h: 1e-4 + 1e-3 * h),
        (2.0, 1e-4, lambda h: 3e-3 + (1e-4 - 3e-3) * np.exp(-h / 4e-3)),
        (-2.0, 1e-4, lambda h: -3e-3 + (1e-4 + 3e-3) * np.exp(-h / 4e-3)),
    ],
    ids=["stick", "slip", "slip back"],
)
def test_a_follows_its_exact_flow_under_a_velocity_that_holds(slip, start, flow, h):
    given, x0 = {"gap": 1e-3}, {"s": slip, "F.a": start}
    found = nsode.loads(HELD).simulate(h, h, method="verlet", parameters=given, x0=x0)
    assert found["F.a"][-1] == pytest.approx(flow(h), rel=1e-11)


# the bounds of the laws, in whole scenes


@pytest.mark.parametrize("step", [1e-5, 1e-3])
def test_contacts_push_and_friction_stays_within_its_level(step):
    found = nsode.load(MODELS / "rolling_sphere.di").simulate(1.5, step, method="verlet")
    assert np.isfinite(found.x).all()
    assert (found["N"] >= 0).all()
    assert (found["N.e"] >= 0).all()
    assert (np.hypot(found["F.x"], found["F.y"]) <= 0.1 * found["N"] * (1 + 4 * EPS)).all()


def test_the_sphere_rolls_at_five_sevenths_by_verlet_too():
    found = nsode.load(MODELS / "rolling_sphere.di").simulate(4, 5e-4, method="verlet")
    assert found["v.x"][-1] == pytest.approx(5.5 * 5 / 7, rel=1e-6)


def test_a_ball_comes_to_rest_and_stays_there():
    found = nsode.loads(BALL).simulate(10, 1e-3, method="verlet")
    assert found["p"][-1] == pytest.approx(-9.8 / 1e5, rel=1e-9)
    assert abs(found["v"][-1]) < 1e-12


@pytest.mark.parametrize("name", ["granular_column", "burridge_knopoff", "two_blocks_conveyor"])
def test_scenes_with_many_elements_tend_to_the_same_run_as_by_runge_kutta(name):
    model = nsode.load(MODELS / f"{name}.di")
    fine = model.simulate(0.3, 5e-6, every=20).x
    errors = [
        np.abs(model.simulate(0.3, h, method="verlet", every=round(1e-4 / h)).x - fine).max()
        for h in (1e-4, 2.5e-5)
    ]
    assert errors[1] < errors[0] / 3


@pytest.mark.parametrize(
    ("name", "law", "constants"),
    [
        ("dry_friction", {"friction": "lugre"}, {}),
        ("dry_friction", {"friction": "smoothing"}, {"F.epsilon": 1e-3}),
        ("bouncing_mass", {"contact": "kelvin_voigt"}, {}),
        ("bouncing_mass", {"contact": "hunt_crossley"}, {"f.c": 0.1}),
    ],
)
def test_another_law_is_refused_at_its_term(name, law, constants):
    model = nsode.load(MODELS / f"{name}.di").with_law(**law)
    with pytest.raises(ModelError, match="paper's law alone") as refusal:
        model.simulate(0.1, 1e-4, method="verlet", parameters=constants)
    (told,) = refusal.value.diagnostics
    assert told.code == "NS501"
    assert "this term" in str(refusal.value)


def test_casadi_refuses_a_step_of_it_by_name():
    pytest.importorskip("casadi")
    with pytest.raises(ValueError, match="no explicit Runge-Kutta method"):
        functions(nsode.loads(BALL).ode, "verlet")


def test_code_that_is_handed_on_is_the_same_with_and_without_splittings():
    ode = nsode.loads(BALL).ode
    plain, split = c.emit(ode), c.emit(ode, splittings=SPLITTINGS.values())
    assert "step_verlet" not in "".join(plain.values())
    assert "ball_step_verlet" in split["ball.h"]
    for name, text in plain.items():
        kept = set(split[name].splitlines())
        assert kept.issuperset(text.splitlines())


@pytest.mark.parametrize("every", [1, 7])
def test_forces_that_are_carried_change_no_number(every):
    plain = nsode.loads(BALL)
    reading = nsode.loads(BALL.replace("parameter fe = -9.8", "input fe = -9.8"))
    assert carries(plain.ode)
    assert not carries(reading.ode)  # an input may change from step to step
    runs = [model.simulate(3, 1e-3, every=every, method="verlet") for model in (plain, reading)]
    assert np.array_equal(runs[0].x, runs[1].x)
    assert np.array_equal(runs[0].y, runs[1].y)


def test_a_force_that_reads_a_velocity_or_the_time_is_not_carried():
    assert carries(nsode.load(MODELS / "granular_column.di").ode)
    assert not carries(nsode.loads(SPRING).ode)
    assert not carries(nsode.loads(BELT).ode)


def test_without_a_compiler_it_is_refused(monkeypatch):
    monkeypatch.setattr(scene, "compiler", lambda: None)
    with pytest.raises(ModelError, match="no C compiler"):
        nsode.loads(SPRING).simulate(1, 0.1, method="verlet")
