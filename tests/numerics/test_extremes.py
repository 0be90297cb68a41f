"""Every approximation has an edge: what happens there, and what is said before it."""

from __future__ import annotations

import re
import warnings
from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np
import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.simulate import RunError, RunWarning
from nsode.simulate.trajectory import Trajectory
from support.growth import inside
from support.models import MODELS
from support.native import build

# A contact that returns .770793 of the speed, whatever K, M and the speed (NUMERICS 4).
RATIO, KAPPA, RESTITUTION = 2.0, np.sqrt(10) / 2, 0.770793


@cache
def shipped(name: str) -> nsode.Model:
    return nsode.load(MODELS / f"{name}.di")


def ball(K: float = 1e5, M: float = 1.0) -> tuple[nsode.Model, float]:
    """Return a ball without weight whose bounce is known, and the frequency of its contact."""
    w = np.sqrt(K / M)
    constants = {"f.K": K, "f.alpha": KAPPA / w, "f.beta": RATIO * KAPPA / w, "M": M, "fe": 0.0}
    return shipped("bouncing_mass").with_parameters(constants), w


def limit(model: nsode.Model, method: str = "rk4") -> float:
    return model.analyze().stable_step[method]


class Outcome(NamedTuple):
    """What came of a run, and the codes of what was said before it and by it."""

    found: Trajectory
    said: set[str]


def run(model: nsode.Model, duration: float, step: float, **options: object) -> Outcome:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RunWarning)
        try:
            found, ended = model.simulate(duration, step, **options), set()
        except RunError as error:
            found, ended = error.trajectory, {d.code for d in error.diagnostics}
    told = " ".join(str(one.message) for one in caught)
    return Outcome(found, ended | set(re.findall(r"NS\d{3}", told)))


def checked(model: nsode.Model, step: float, method: str = "rk4", **constants: float) -> set[str]:
    """Return the codes that ``nsode check`` gives when these numbers stand in the text."""
    text = re.sub(r"step .*", f"step {float(step)!r} method {method}", model.source.text)
    for name, value in constants.items():
        text = re.sub(rf"\b{name} = [\d.e+-]+", f"{name} = {float(value)!r}", text)
    return {d.code for d in nsode.loads(text).diagnostics}


# stiffness, damping, masses


@pytest.mark.parametrize("K", 10.0 ** np.arange(2, 15, 3))
@pytest.mark.parametrize("M", [1e-6, 1.0, 1e6])
def test_a_bounce_knows_neither_stiffness_nor_mass(K, M):
    model, w = ball(K, M)
    step = limit(model) / 100
    found, said = run(model, round(12 / w / step) * step, step, x0={"p": 0.0, "v": -1.0})
    assert not said
    assert np.isfinite(found.x).all()
    assert (found["f"] >= 0).all()
    assert found["v"][-1] == pytest.approx(RESTITUTION, abs=2e-5)
    assert np.abs(found["v"]).max() <= 1  # no more energy than it came with


def rk4_limit(K: float, alpha: float, beta: float, M: float) -> float:
    """Return the first step at which RK4 amplifies a mode of the cubic, or of the free e."""
    w2 = K / M
    modes = [*np.roots([alpha, 1.0, beta * w2, w2]), -1 / beta]

    def grows(step: float, mode: complex) -> bool:
        z = step * mode
        return abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) > 1 + 1e-12

    edges = []
    for mode in modes:
        steps = np.linspace(0.01, 4, 400) / abs(mode)
        first = next(k for k, step in enumerate(steps) if grows(step, mode))
        low, high = steps[first - 1], steps[first]
        for _ in range(40):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if grows(middle, mode) else (middle, high)
        edges.append(low)
    return float(min(edges))


@pytest.mark.parametrize(
    ("K", "beta", "share", "M"),
    [*product([1e2, 1e14], [1e-7, 1.0], [1e-6, 1.0], [1e-6, 1e6]), (1e5, 1e-3, 0.5, 1.0)],
)
def test_the_stable_step_is_that_of_the_cubic_at_every_corner(K, beta, share, M):
    constants = {"f.K": K, "f.beta": beta, "f.alpha": share * beta, "M": M, "fe": 0.0}
    model = shipped("bouncing_mass").with_parameters(constants)
    predicted = limit(model)
    assert predicted == pytest.approx(rk4_limit(K, share * beta, beta, M), rel=1e-3)
    found, said = run(model, 1000 * predicted / 2, predicted / 2, x0={"p": 0.0, "v": -1.0})
    assert "NS407" not in said
    assert np.isfinite(found.x).all()
    assert (found["f"] >= 0).all()
    assert np.abs(found["v"]).max() <= 1 + 1e-9


@pytest.mark.parametrize(
    "constants",
    [{"f.alpha": 2e-2}, {"f.alpha": 0.0}, {"f.beta": 0.0}, {"f.K": -1.0},
     {"f.K": np.inf}, {"f.beta": np.nan}],
)  # fmt: skip
def test_constants_beyond_the_edge_are_refused(constants):
    with pytest.raises(ModelError):
        shipped("bouncing_mass").with_parameters(constants)


def test_a_mass_of_zero_is_said_before_a_run_and_stops_it_in_its_first_step():
    model = shipped("bouncing_mass").with_parameters({"M": 0.0})
    with pytest.raises(ModelError, match="not finite at the start"):
        model.analyze()
    found, said = run(model, 1, 1e-3)
    assert said == {"NS504"}
    assert len(found.t) == 1


CORNERS = [
    *(("two_blocks_conveyor", {"M1": ratio}) for ratio in (1e-6, 1e-3, 1e3, 1e6)),
    ("bouncing_mass", {"f.K": 1e2, "f.alpha": 0.1, "f.beta": 0.2}),
    ("bouncing_mass", {"f.K": 1e14, "f.alpha": 1e-7, "f.beta": 2e-7}),
    ("dry_friction", {"F.K": 1e2, "F.beta": 0.1}),
    ("dry_friction", {"F.K": 1e14, "F.beta": 1e-7}),
    *(("dry_friction", {"F.beta": beta}) for beta in (1e-7, 1.0)),
    *(("dry_friction", {"M": mass}) for mass in (1e-6, 1e6)),
]  # fmt: skip


@pytest.mark.parametrize(("name", "constants"), CORNERS)
def test_two_runs_come_together_below_the_limit_and_part_beyond_it(name, constants):
    model = shipped(name).with_parameters(constants)
    (found,) = (step for step in model.analyze().steps if step.method == "rk4")
    place = inside(model, found.modes)
    assert place.growth("rk4", 0.99 * found.step, found.eigenvalue) < 0
    assert place.growth("rk4", 1.01 * found.step, found.eigenvalue) > 0


# friction: levels, speeds, precision

SPEEDS = [0.0, 5e-324, 1e-300, 1e-30, 1.0, 1e3]


@pytest.mark.parametrize("real", ["double", "float"])
def test_friction_stays_in_its_disk_at_every_level_and_speed(real, tmp_path):
    code = build(shipped("rolling_sphere").ode, tmp_path, real=real)
    level = [p.name for p in shipped("rolling_sphere").ode.parameters].index("mu")
    speed, height = code.x_names.index("v.x"), code.x_names.index("p.z")
    numbers = np.finfo(code.dtype)
    lost = 10 * np.sqrt(numbers.tiny)  # the square of a smaller force is no number any more
    for mu, v in product([0.0, 1e-30, 0.1, 10.0], SPEEDS):
        p, x = code.p0, code.init()
        p[level], x[speed], x[height] = mu, v, 0.5 - 1e-4
        rows = code.run(100, 1e-3, x, p=p)
        y = np.array([code.out(0.0, row, p=p) for row in rows], dtype=float)
        _, normal, *friction = y.T
        assert np.isfinite(rows).all()
        assert (normal >= 0).all()
        bound = float(p[level]) * normal * (1 + 4 * float(numbers.eps))
        assert (np.hypot(*friction) <= bound + lost).all()
        if mu == 0:
            assert not np.any(friction)


@pytest.mark.parametrize("mu", [0.0, 1e-30, 0.1, 10.0])
def test_no_level_of_friction_feeds_a_sliding_sphere(mu):
    model = shipped("rolling_sphere").with_parameters({"mu": mu})
    step = min(1e-3, limit(model) / 4)
    found, _ = run(model, 0.5, step, x0={"p.z": 0.5})
    v, w = (np.array([found[f"{s}.{c}"] for c in "xyz"]) for s in "vw")
    energy = 0.5 * (v**2).sum(axis=0) + 0.05 * (w**2).sum(axis=0) + 9.8 * found["p.z"]
    assert energy.max() <= energy[0] * (1 + 1e-3)


@pytest.mark.parametrize(
    ("real", "height", "off"),
    [("double", 1e3, 1e-8), ("double", 1e6, 1e-6), ("float", 1.0, 1e-4), ("float", 1e3, 0.1)],
)
def test_far_from_the_origin_a_bounce_loses_the_digits_of_its_gap(real, height, off, tmp_path):
    """The gap is a difference: its rounding over the penetration of 2.5 mm is what is lost."""
    text = """
    model ball
    parameter floor = 0
    state p = 0
    state v = -1
    force f = dio(p - floor)
    der(p) = v
    der(v) = f
    approximate f: K = 1e5, alpha = 5e-3, beta = 1e-2
    """
    code = build(nsode.loads(text).ode, tmp_path, real=real)
    p, x = code.p0, code.init()
    near = code.run(400, 1e-4, x, p=p)
    p[0] = x[0] = height
    far = code.run(400, 1e-4, x, p=p)
    assert near[-1, 1] == pytest.approx(RESTITUTION, abs=1e-3)
    assert far[-1, 1] == pytest.approx(near[-1, 1], rel=off)
    assert (code.out(0.0, far[-1], p=p) == 0).all()


# finite and wrong, and said


def test_a_short_beta_slides_too_far_and_is_announced():
    model = shipped("dry_friction").with_parameters({"F.beta": 3e-4})
    (right, quiet), (wrong, said) = run(model, 5, 1e-4), run(model, 5, 1e-3, guard=False)
    assert np.isfinite(wrong.x).all()
    assert wrong["p"][-1] / right["p"][-1] - 1 == pytest.approx(0.41, abs=0.01)
    assert (quiet, said) == (set(), {"NS407"})
    assert "NS407" in {d.code for d in model.analyze().diagnostics}
    assert "NS407" in checked(model, 1e-3, beta=3e-4)
    assert "NS407" not in checked(model, 2e-4, beta=3e-4)


def test_a_hard_floor_throws_a_ball_and_is_announced():
    model = shipped("bouncing_mass").with_parameters({"f.K": 5e6})
    (right, quiet), (wrong, said) = run(model, 3, 1e-5), run(model, 3, 1e-3, guard=False)
    assert np.isfinite(wrong.x).all()
    assert wrong["p"].max() > 2 > 1.001 > right["p"].max()
    assert (quiet, said) == (set(), {"NS407"})
    assert "NS407" in {d.code for d in model.analyze().diagnostics}
    assert "NS407" in checked(model, 1e-3, K=5e6)
    assert "NS407" not in checked(model, 1e-5, K=5e6)


def test_example_two_never_rests_at_the_step_of_the_paper_and_it_is_announced():
    model = shipped("two_blocks_conveyor")
    speeds = {}
    for step in (6.5e-4, 1e-3):
        found, said = run(model, 4, step, guard=False)
        assert np.isfinite(found.x).all()
        last = found.t > 3.5
        speeds[step] = max(
            np.abs(found[f"{v}.{c}"][last]).max() for v in ("v1", "v2") for c in "xy"
        )
        assert said == (set() if step < 7e-4 else {"NS407"})
    assert speeds[6.5e-4] < 1e-12 < 1e-4 < speeds[1e-3]
    assert "NS407" in checked(model, 1e-3)
    assert "NS407" not in checked(model, 6.5e-4)


@pytest.mark.parametrize("beta", [2e-3, 3e-4, 1e-4])
def test_friction_is_right_up_to_the_limit_and_beyond_it_announced(beta):
    model = shipped("dry_friction").with_parameters({"F.beta": beta})
    exact = run(model, 5, 1e-5, every=1000).found["p"][-1]
    edge = limit(model)
    for share in (0.3, 0.9, 0.99):
        found, said = run(model, 5, share * edge)
        assert not said
        assert found["p"][-1] == pytest.approx(exact, rel=2e-3)
    for share in (1.01, 1.2, 2, 5):
        assert "NS407" in run(model, 5, share * edge, guard=False).said


@pytest.mark.parametrize("method", ["rk4", "heun", "euler"])
@pytest.mark.parametrize("share", [0.3, 0.5, 0.7, 0.9, 0.99, 1.1, 2.0])
def test_an_impact_that_goes_wrong_is_announced(method, share):
    """A stable step may be too long for an impact; where in a step it begins then matters."""
    model, w = ball()
    step = share * limit(model, method)
    errors = [
        abs(run(model, 20 / w, step, method=method, guard=False, x0={"p": p, "v": -1.0})
            .found["v"][-1] - RESTITUTION)
        for p in np.linspace(0.05, 0.95, 5) * step
    ]  # fmt: skip
    constants = {"alpha": KAPPA / w, "beta": RATIO * KAPPA / w}
    said = checked(model, step, method, **constants) & {"NS407", "NS409"}
    if not max(errors) < 0.07:
        assert said
