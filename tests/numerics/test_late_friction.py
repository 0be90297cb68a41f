"""A sgn whose force acts on the second derivative of its argument: the cubic, and runs."""

from __future__ import annotations

import numpy as np
import pytest

import nsode
from nsode.simulate import RunWarning

SERVO = """model servo
parameter d = {damping}
parameter w = {weight}
state x = 1
state v = 0
force F = 2*sgn({argument})
der(x) = v
der(v) = -w*F - d*v{more}
approximate default sgn: K = {K}, beta = {beta}
simulate 30 {{s}} step {step}
"""


def servo(damping=0.0, weight=1.0, argument="x", K=1e6, beta=1e-3, step=1e-4, more=""):
    return nsode.loads(SERVO.format(**locals()))


def warned(model):
    return [d.code for d in model.diagnostics if d.code == "NS412"] == ["NS412"]


@pytest.mark.parametrize("weight", [0.3, 1.0, 20.0])
@pytest.mark.parametrize("K", [1e4, 1e6, 1e9])
@pytest.mark.parametrize("beta", [1e-4, 1e-3, 1e-1])
@pytest.mark.parametrize("share", [0.0, 0.5, 0.99, 1.01, 3.0])  # of the damping 1/beta
def test_it_is_said_where_the_cubic_of_stick_has_growing_roots(weight, K, beta, share):
    damping = share / beta
    cubic = np.roots([1.0, damping, weight * K * beta, weight * K])
    assert warned(servo(damping, weight, K=K, beta=beta)) == bool(cubic.real.max() > 0)


def last_second(run):
    return np.abs(run["x"][run.t >= run.t[-1] - 1.0]).max()


def test_twisting_rests_at_4_46_s_and_its_run_that_was_warned_of_does_not():
    model = servo(more=" - sgn(v)")
    assert warned(model)
    with pytest.warns(RunWarning, match="NS412"):
        run = model.simulate()
    assert 1e-4 < last_second(run) < 1e-2


@pytest.mark.parametrize(
    ("argument", "damping"), [("v + x", 0.0), ("x", 2e3)], ids=["sliding variable", "damped"]
)
def test_what_draws_no_warning_comes_to_rest(argument, damping):
    # -2/2000 m/s of creep under that damping takes the servo home in 1000 s
    beta = 1e-3
    model = servo(damping, 1.0 if damping == 0 else 200.0, argument, beta=beta)
    assert not warned(model)
    assert last_second(model.simulate()) < 1e-9


def test_super_twisting_whose_other_sgn_holds_the_same_argument_rests_unwarned():
    model = nsode.loads(
        """model supertwisting
state x = 1
state z = 0
der(x) = z - 1.5*sqrt(abs(x))*sgn(x)
der(z) = -1.1*sgn(x)
approximate default sgn: K = 1e6, beta = 1e-2
simulate 20 step 2e-5
"""
    )
    assert not warned(model)
    assert last_second(model.simulate()) < 1e-9


@pytest.mark.parametrize("start", [0.0, 1.0])
def test_a_sgn_that_acts_on_nothing_or_not_at_once_at_the_start_only_draws_none(start):
    model = nsode.loads(
        f"""model probe
state x = {start}
state v = 2
force G = sgn(v*sin(x))
output q = sgn(x)
der(x) = v
der(v) = -x - sgn(v) - G
approximate default sgn: K = 1e6, beta = 1e-3
"""
    )
    assert not warned(model)


def test_a_run_tells_of_the_parameters_that_it_runs_with():
    model = servo(damping=2e3, weight=200.0)
    with pytest.warns(RunWarning, match="NS412"):
        model.simulate(1.0, parameters={"d": 1.0})
