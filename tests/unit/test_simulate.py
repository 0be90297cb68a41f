"""Runs: settings, parameters, inputs, and what is said of one that goes wrong."""

from __future__ import annotations

import math
import os
import re
import signal
import threading

import numpy as np
import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.simulate import Manner, Mode, RunError, RunWarning, Wish, simulate
from support.models import MODELS

DECAY = "model m\nparameter k = 1\nstate p = 1\nder(p) = -k*p\nsimulate 1 step 0.1\n"
DRIVEN = "model m\ninput f\nstate p = 0\nder(p) = f\nsimulate 1 step 0.1\n"
BLOCK = """model block
parameter mu = 0.3
state x = 0
state v = 2
state y = 0
state w = 0
force N = dio(y)
force F = mu*N*sgn(v)
der(x) = v
der(v) = -F
der(y) = w
der(w) = N - 10
"""
CONSTANTS = {"N.K": 1e5, "N.alpha": 2.8e-3, "N.beta": 4e-3, "F.K": 1e5, "F.beta": 4e-3}


def codes(refusal):
    return [d.code for d in refusal.value.diagnostics]


def refused(text, *args, **kwargs):
    with pytest.raises(ModelError) as refusal:
        nsode.loads(text).simulate(*args, **kwargs)
    return refusal


def euler(text, steps, **kwargs):
    return nsode.loads(text).simulate(steps * 0.1, 0.1, method="euler", **kwargs)


# settings


def test_a_step_of_euler_is_that_of_the_textbook():
    assert euler(DECAY, 10)["p"] == pytest.approx(0.9 ** np.arange(11), rel=1e-14)


def test_rows_are_stored_every_so_many_steps_and_at_the_end():
    found = euler(DECAY, 10, every=4)
    assert found.t == pytest.approx([0, 0.4, 0.8, 1.0])
    assert found["p"] == pytest.approx([1, 0.9**4, 0.9**8, 0.9**10], rel=1e-14)


def test_rows_do_not_depend_on_where_the_chunks_of_a_run_end():
    dense = nsode.loads(DECAY).simulate(100, 1e-3)
    for every in (7, 512, 1000, 99_999):
        sparse = nsode.loads(DECAY).simulate(100, 1e-3, every=every)
        rows = [*range(0, 100_000, every), 100_000]
        assert np.array_equal(sparse.t, dense.t[rows])
        assert np.array_equal(sparse.x, dense.x[rows])


def test_a_duration_of_three_tenths_takes_three_steps():
    assert len(nsode.loads(DECAY).simulate(0.3, 0.1)) == 4


def test_a_run_may_start_at_another_time():
    text = "model m\nstate p = 0\nder(p) = t\nsimulate 1 step 0.1\n"
    found = nsode.loads(text).simulate(start=2.0)
    assert found.t[0] == 2.0
    assert found["p"][-1] == pytest.approx((3**2 - 2**2) / 2, rel=1e-12)


def test_a_run_may_start_at_the_time_of_day_but_not_where_steps_are_lost() -> None:
    driven = nsode.loads("model m\nstate p = 0\nder(p) = cos(t)\nsimulate 1 step 1e-3\n")
    now = 1.7e9  # s since 1970, where doubles are 2.4e-7 apart
    exact = np.sin(now + 1) - np.sin(now)
    assert driven.simulate(start=now)["p"][-1] == pytest.approx(exact, abs=1e-6)
    for start in (1e13, -1e13, 1e300):
        with pytest.raises(ModelError, match="cannot be told apart") as refusal:
            driven.simulate(start=start)
        assert [d.code for d in refusal.value.diagnostics] == ["NS501"]


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize("which", ["duration", "step"])
def test_a_duration_or_a_step_that_is_no_positive_number_is_refused(which, value):
    refusal = refused(DECAY, **{which: value})
    assert codes(refusal) == ["NS501"]
    assert which in str(refusal.value)


@pytest.mark.parametrize(
    ("wish", "code"),
    [
        ({"every": 0}, "NS501"),
        ({"every": 2.5}, "NS501"),
        ({"step": "1e-3"}, "NS501"),
        ({"start": math.nan}, "NS501"),
        ({"method": "rk5"}, "NS501"),
        ({"duration": 0.01}, "NS501"),
        ({"duration": 1e9, "step": 1e-6, "every": 10**9}, "NS502"),
        ({"duration": 1e6, "step": 2e-3}, "NS502"),
    ],
)
def test_what_cannot_be_run_is_refused_before_the_run(wish, code):
    assert codes(refused(DECAY, **wish)) == [code]


def test_too_many_rows_are_refused_with_a_number_that_fits():
    refusal = refused(DECAY, 1e6, 2e-3)
    wanted = int(refusal.value.diagnostics[0].help.split("--every ")[1].split("`")[0])
    assert 8 * 2 * 1e6 / 2e-3 / wanted < 2**31
    assert 8 * 2 * 1e6 / 2e-3 / (wanted - 1) > 2**31


def test_a_misspelt_method_draws_a_suggestion():
    [diagnostic] = refused(DECAY, method="rk5").value.diagnostics
    assert diagnostic.help == "did you mean `rk4`?"


def test_everything_that_is_missing_is_said_at_once():
    refusal = refused("model m\nstate p = 1\nder(p) = -p\n")
    assert codes(refusal) == ["NS503"]
    assert "--for" in refusal.value.diagnostics[0].help
    assert "--step" in refusal.value.diagnostics[0].help


# parameters


def test_an_override_holds_for_one_run():
    model = nsode.loads(DECAY)
    assert model.simulate(method="euler", parameters={"k": 2})["p"][1] == pytest.approx(0.8)
    assert model.simulate(method="euler")["p"][1] == pytest.approx(0.9)


def test_formulas_follow_what_they_are_made_of():
    text = BLOCK + (
        "approximate N: K = 1e5, beta = 4e-3, alpha = 0.7*N.beta\n"
        "approximate F: K = N.K, beta = 4e-3\nsimulate 0.01 step 1e-3\n"
    )
    found = nsode.loads(text).simulate(parameters={"N.K": 2e5, "N.beta": 5e-3})
    assert found.meta["parameters"]["F.K"] == 2e5
    assert found.meta["parameters"]["N.alpha"] == pytest.approx(3.5e-3)


def test_states_at_the_start_follow_parameters_and_can_be_chosen():
    text = "model m\nparameter R = 2\nstate p = 2*R\nstate q = 0\nder(p) = 0\nder(q) = 0\n"
    found = nsode.loads(text).simulate(1, 0.5, parameters={"R": 3}, x0={"q": 7})
    assert found["p"][-1] == 6
    assert found["q"][-1] == 7


def test_elements_of_a_family_are_set_one_by_one_or_all_at_once():
    text = (
        "model m\nparameter m[i in 1..3] = 1\nstate p[i in 1..3] = 0\n"
        "for i in 1..3: der(p[i]) = m[i]\nsimulate 1 step 0.5\n"
    )
    model = nsode.loads(text)
    assert model.simulate(parameters={"m[2]": 5})["p"][-1].tolist() == [1, 5, 1]
    assert model.simulate(parameters={"m": 2})["p"][-1].tolist() == [2, 2, 2]
    assert model.simulate(parameters={"m": [1, 2, 3]})["p"][-1].tolist() == [1, 2, 3]
    assert codes(refused(text, parameters={"m": [1, 2]})) == ["NS105"]


@pytest.mark.parametrize(
    ("kwargs", "code"),
    [
        ({"parameters": {"kk": 1}}, "NS101"),
        ({"parameters": {"k": math.nan}}, "NS501"),
        ({"parameters": {"k": "1"}}, "NS501"),
        ({"parameters": {"k": None}}, "NS501"),
        ({"x0": {"v": 1}}, "NS101"),
        ({"x0": {"p": math.inf}}, "NS501"),
        ({"inputs": {"f": 1}}, "NS101"),
    ],
)
def test_names_and_values_that_are_wrong_are_refused(kwargs, code):
    assert codes(refused(DECAY, **kwargs)) == [code]


def test_a_model_without_constants_is_refused_naming_the_flags():
    [diagnostic] = refused(BLOCK, 1, 1e-3).value.diagnostics
    assert diagnostic.code == "NS503"
    for name in CONSTANTS:
        assert f"-p {name}=" in diagnostic.help


def test_constants_given_to_a_run_make_it_possible():
    found = nsode.loads(BLOCK).simulate(1, 1e-3, parameters=CONSTANTS)
    assert found["v"][-1] == pytest.approx(0, abs=1e-12)  # 2 m/s last 2/3 s at 3 m/s^2
    assert found["x"][-1] == pytest.approx(2 / 3, rel=2e-2)


@pytest.mark.parametrize(
    "wrong", [{"mu": -0.1}, {"N.alpha": 5e-3}, {"N.K": -1}, {"F.beta": 0}, {"N.beta": 1e-3}]
)
def test_an_override_that_breaks_a_proof_is_refused(wrong):
    refusal = refused(BLOCK, 1, 1e-3, parameters=CONSTANTS | wrong)
    assert set(codes(refusal)) == {"NS307"}
    assert f"`{next(iter(wrong))}`" in str(refusal.value)


# inputs


def test_an_input_without_data_is_refused_naming_the_flag():
    [diagnostic] = refused(DRIVEN).value.diagnostics
    assert diagnostic.code == "NS503"
    assert "-u f=" in diagnostic.help


def test_inputs_are_read_at_the_start_of_a_step_and_held_over_it():
    # Each method sees a staircase: the left sum of the signal.
    times = 0.1 * np.arange(10)
    for method in ("rk4", "heun", "euler"):
        found = nsode.loads(DRIVEN).simulate(method=method, inputs={"f": lambda t: t**2})
        assert found["p"][-1] == pytest.approx(0.1 * np.sum(times**2), rel=1e-13)


def test_recorded_inputs_are_interpolated_at_the_steps():
    recorded = ([0.0, 1.0], [0.0, 2.0])
    found = nsode.loads(DRIVEN).simulate(inputs={"f": recorded})
    assert found["p"][-1] == pytest.approx(0.1 * np.sum(0.2 * np.arange(10)), rel=1e-13)


def test_a_constant_input_and_a_default_are_the_same():
    declared = DRIVEN.replace("input f", "input f = 3")
    assert nsode.loads(declared).simulate()["p"][-1] == pytest.approx(3)
    assert nsode.loads(DRIVEN).simulate(inputs={"f": 3})["p"][-1] == pytest.approx(3)


@pytest.mark.parametrize(
    "data",
    [
        ([0.0, 0.5], [0.0, 1.0]),
        ([0.1, 2.0], [0.0, 1.0]),
        ([0.0, 2.0, 1.0], [0.0, 1.0, 2.0]),
        ([0.0, 2.0], [0.0, math.nan]),
        ([0.0, 2.0], [0.0]),
        ([], []),
        lambda t: np.where(t > 0.5, np.nan, 0.0),
        math.inf,
    ],
    ids=["too short", "too late", "back in time", "nan", "lengths", "empty", "nan later", "inf"],
)
def test_data_that_cannot_drive_a_run_is_refused(data):
    assert codes(refused(DRIVEN, inputs={"f": data})) == ["NS508"]


# what goes wrong


def test_a_state_that_is_no_longer_finite_is_named_with_step_and_time():
    model = nsode.loads("model m\nstate q = 0\nstate p = 1\nder(q) = 1\nder(p) = p^2\n")
    with pytest.raises(RunError, match="`p` is no longer finite in step 1,0") as refusal:
        model.simulate(2, 1e-3)
    kept = refusal.value.trajectory
    assert 1.0 <= kept.t[-1] < 1.01  # the solution is 1/(1 - t)
    assert np.all(np.isfinite(kept.x))
    assert kept["p"][900] == pytest.approx(1 / (1 - 0.9), rel=1e-6)
    assert len(kept) == kept.meta["run"]["taken"] + 1


def test_a_broken_assumption_stops_the_run_where_it_breaks():
    text = (
        "model m\nparameter c = 1\nstate q = 1\nstate v = 1\nassume q >= 0\n"
        "der(q) = -c\nder(v) = -q*sgn(v)\n"
    )
    with pytest.raises(RunError) as refusal:
        nsode.loads(text).simulate(2, 1e-2, parameters={"sgn1.K": 1e3, "sgn1.beta": 4e-2})
    assert codes(refusal) == ["NS505"]
    assert refusal.value.trajectory.t[-1] == pytest.approx(1.0, abs=0.02)


def test_an_assumption_is_watched_for_every_element_of_a_family():
    model = nsode.loads(
        "model m\nparameter q0[i in 1..3] = [3, 1, 2]\nstate q[i in 1..3] = q0[i]\n"
        "state v[i in 1..3] = 1\nfor i in 1..3: assume q[i] >= 0\n"
        "for i in 1..3: der(q[i]) = -1\nfor i in 1..3: der(v[i]) = -q[i]*sgn(v[i])\n"
        "approximate default sgn: K = 1e3, beta = 4e-2\n"
    )
    for start, first, which in (([3, 1, 2], 1.0, 2), ([3, 2, 1.5], 1.5, 3)):
        with pytest.raises(RunError, match=f"does not hold for `i = {which}` in step") as refusal:
            model.simulate(2.5, 1e-2, parameters={"q0": start})
        assert codes(refusal) == ["NS505"]
        assert refusal.value.trajectory.t[-1] == pytest.approx(first, abs=0.02)


def test_the_bound_of_an_input_is_watched():
    model = nsode.loads(
        "model m\ninput u = 1 >= 0\nstate v = 1\nder(v) = -u*sgn(v)\n"
        "approximate sgn1: K = 1e3, beta = 4e-2\n"
    )
    assert abs(model.simulate(2, 1e-3).x[-1][0]) < 1e-3
    with pytest.raises(RunError, match="does not hold in step 1 at") as refusal:
        model.simulate(2, 1e-3, inputs={"u": -1.0})
    assert codes(refusal) == ["NS505"]
    with pytest.raises(RunError, match="`>= 0` was declared") as refusal:
        model.simulate(2, 1e-3, inputs={"u": lambda t: 0.5 - t})
    assert refusal.value.trajectory.t[-1] == pytest.approx(0.5, abs=2e-3)


def test_the_factor_that_may_turn_negative_is_shown():
    model = nsode.loads(
        "model m\nparameter phi = 0.3\nparameter a = 0.5\nstate v = 1\nlet mu = cos(phi) - a\n"
        "force F = 2*sgn(v)*mu\nder(v) = -F\napproximate F: K = 1e3, beta = 4e-2\n"
    )
    with pytest.raises(ModelError, match="with `phi` = 2") as refusal:
        model.simulate(1, 1e-3, parameters={"phi": 2})
    assert codes(refusal) == ["NS307"]
    assert "the factor `2*mu` of `F` may then be negative" in str(refusal.value)


def test_an_element_that_breaks_a_proof_is_named_once():
    model = nsode.loads(
        "model m\nparameter F0[i in 1..3] = i\nstate v[i in 2..3] = 1\n"
        "force F[k in 2..3] = F0[k-1]*sgn(v[k])\nfor i in 2..3: der(v[i]) = -F[i]\n"
        "approximate F: K = 1e3*F0[3], beta = 4e-2\n"
    )
    assert model.with_parameters({"F0[3]": 2}).ode.parameters[1].values == (2e3,)
    for given, shown in (({"F0": [1, -2, -3]}, "`F0[2]` = -2"), ({"F0[1]": -1}, "`F0[1]` = -1")):
        with pytest.raises(ModelError, match=re.escape(f"does not hold with {shown}")) as refusal:
            model.simulate(1, 1e-3, parameters={**given, "F.K": 1e3})
        assert codes(refusal) == ["NS307"]


def test_a_step_beyond_the_limit_draws_a_warning_and_is_refused_on_demand():
    model = nsode.load(MODELS / "two_blocks_conveyor.di")
    with pytest.warns(RunWarning, match="beyond what rk4 can take"):
        model.simulate(0.1, 1e-3)
    with pytest.raises(ModelError, match="beyond what rk4 can take"):
        model.simulate(0.1, 1e-3, strict=True)
    model.simulate(0.1, 6.5e-4)


def test_the_limit_is_that_of_the_constants_of_the_run():
    model = nsode.load(MODELS / "two_blocks_conveyor.di")
    with pytest.warns(RunWarning, match="beyond"):
        model.simulate(0.01, parameters={f"F{i}.K": 5e6 for i in (1, 2, 3)})


def test_a_subnormal_state_is_zero():
    text = "model m\nstate a = 1\nder(a) = -1000*a\n"
    found = nsode.loads(text).simulate(2, 1e-3)
    assert found["a"][-1] == 0.0
    assert not np.any((found["a"] != 0) & (np.abs(found["a"]) < 1e-290))


def test_ctrl_c_keeps_what_was_computed():
    main = threading.main_thread().ident
    timer = threading.Timer(0.3, signal.pthread_kill, (main, signal.SIGINT))
    model = nsode.loads(DECAY)
    model.simulate(1, 1e-3)
    timer.start()
    try:
        with pytest.warns(RunWarning, match="interrupted at t = "):
            found = model.simulate(1e5, 1e-3, every=1000)
    finally:
        timer.cancel()
    assert found.meta["run"]["interrupted"]
    assert 0 < found.meta["run"]["taken"] < 10**8
    assert len(found) >= found.meta["run"]["taken"] // 1000
    assert np.all(np.isfinite(found.x))


def test_progress_is_told_and_ends_at_the_last_step():
    model, told = nsode.loads(DECAY), []
    manner = Manner(progress=lambda taken, steps: told.append((taken, steps)))
    simulate(model.inclusion, model.ode, Wish(100, 1e-3), manner=manner)
    assert told[-1] == (100_000, 100_000)
    assert [taken for taken, _ in told] == sorted(taken for taken, _ in told)


def test_the_lock_is_released_while_the_c_runs():
    model, ticks = nsode.loads(DECAY), []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.005):
            ticks.append(os.times().elapsed)

    thread = threading.Thread(target=tick)
    thread.start()
    before = len(ticks)
    simulate(model.inclusion, model.ode, Wish(2e4, 1e-3, 10**6))
    stop.set()
    thread.join()
    assert len(ticks) - before > 5


# modes


def test_modes_tell_what_each_element_does():
    found = nsode.loads(BLOCK).simulate(1, 1e-3, parameters=CONSTANTS, x0={"y": 0.05})
    falling = found.t < 0.09  # 5 cm take 0.1 s
    assert set(found.mode("N")[falling]) == {Mode.FREE}
    assert set(found.mode("F")[falling]) == {Mode.FREE}
    assert found.mode("N")[-1] == Mode.CONTACT
    assert found.mode("F")[-1] == Mode.STICK
    assert Mode.SLIP in found.mode("F")
    pressed = found["N"] > 0
    assert np.array_equal(found.mode("N") == Mode.CONTACT, pressed)
    assert np.array_equal(found["N.psi"], found["y"])


def test_elements_without_a_name_are_recorded_too():
    text = "model m\nstate v = 1\nder(v) = -0.5*sgn(v)\n"
    found = nsode.loads(text).simulate(3, 1e-3, parameters={"sgn1.K": 1e4, "sgn1.beta": 2e-2})
    assert found.forces == ("sgn1",)
    assert found["sgn1"][1000] == 0.5
    assert found.mode("sgn1")[1000] == Mode.SLIP
    assert found.mode("sgn1")[-1] == Mode.STICK


WIND = """model wind
input w[2]
state x = 0
state y = 0
der(x) = w.x
der(y) = w.y
simulate 1 step 0.5
"""


def test_a_value_of_a_whole_vector_is_that_of_each_component_that_has_no_other():
    found = nsode.loads(WIND).simulate(inputs={"w": 3, "w.y": 4})
    assert found.x[-1].tolist() == [3, 4]


def test_a_mistake_in_case_alone_is_the_first_guess():
    with pytest.raises(ModelError) as refusal:
        nsode.loads(WIND).simulate(inputs={"w": 0}, method="RK4")
    assert refusal.value.diagnostics[0].help == "did you mean `rk4`?"


def test_a_mass_that_an_override_makes_negative_feeds_energy_before_it_diverges():
    model = nsode.load(MODELS / "bouncing_mass.di")
    with pytest.raises(ModelError) as refusal:
        model.simulate(parameters={"M": -1}, strict=True)
    assert [d.code for d in refusal.value.diagnostics] == ["NS402"]
