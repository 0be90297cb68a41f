"""Energy from nothing stops a run; sound runs never hear of it."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest

import nsode
from nsode.analysis.bounces import speeds
from nsode.analysis.quick import foresee
from nsode.diagnostics import ModelError
from nsode.integrators import REGISTRY
from nsode.integrators.verlet import VERLET
from nsode.ode import Run
from nsode.simulate import Manner, RunError, RunWarning, Wish, simulate
from nsode.simulate.foresee import foreseen
from nsode.simulate.guard import Books, verdict
from nsode.simulate.settings import settle
from support.models import MODELS


def run(name, *args, **parameters):
    return nsode.load(MODELS / f"{name}.di").simulate(*args, parameters=parameters)


@pytest.mark.parametrize(
    ("name", "duration", "step", "parameters"),
    [
        ("bouncing_mass", 3.0, 1e-3, {"f.K": 5e6}),  # would rise to 2.4 m from a drop of 1 m
        ("dry_friction", 5.0, 1e-3, {"F.beta": 3e-4}),  # finite, and 41 % off
        ("dry_friction", 5.0, 1e-3, {"F.beta": 1e-4}),
        ("two_blocks_conveyor", 2.0, 2e-3, {}),
        ("frictional_contact", 0.5, 1e-3, {"N.K": 1e7}),
    ],
)
def test_a_run_that_makes_energy_is_stopped_with_its_rows_kept(name, duration, step, parameters):
    with (
        pytest.warns(RunWarning, match="beyond what rk4 can take"),
        pytest.raises(RunError, match="more energy than it was given") as refusal,
    ):
        run(name, duration, step, **parameters)
    assert refusal.value.diagnostics[0].code == "NS506"
    kept = refusal.value.trajectory
    assert 0 < kept.t[-1] < duration
    assert np.all(np.isfinite(kept.x))
    assert not any(column.endswith((".moved", ".balance")) for column in kept.x_names)


def test_without_the_guard_it_goes_on_to_where_the_energy_leads():
    model = nsode.load(MODELS / "bouncing_mass.di")
    with pytest.warns(RunWarning, match="beyond"):
        found = model.simulate(3, 1e-3, parameters={"f.K": 5e6}, guard=False)
    assert found["p"].max() > 2  # dropped from 1 m


def test_a_step_that_is_stable_but_too_long_for_impacts_is_announced_and_watched():
    model = nsode.load(MODELS / "bouncing_mass.di")
    step = 6.1e-3
    assert step < model.analyze().stable_step["rk4"]
    with pytest.warns(RunWarning, match="does not resolve the impacts of `f`"):
        thrown = model.simulate(10, step, guard=False)
    assert thrown["p"].max() > 2  # dropped from 1 m
    with pytest.warns(RunWarning, match="NS409"), pytest.raises(RunError) as refusal:
        model.simulate(10, step)
    assert [d.code for d in refusal.value.diagnostics] == ["NS506"]
    with pytest.raises(ModelError, match="more than all of it is energy from nothing"):
        model.simulate(10, step, strict=True)


@pytest.mark.parametrize(("step", "severity"), [(2e-3, "note"), (2.4e-3, "warning")])
def test_more_speed_than_before_is_a_warning_and_less_of_it_a_note(step, severity):
    inclusion = nsode.load(MODELS / "bouncing_mass.di").inclusion
    [said] = foresee(replace(inclusion, run=Run(step=step, method="heun"))).diagnostics
    assert (said.code, said.severity) == ("NS409", severity)


def test_half_of_a_limit_that_varies_along_the_run_is_not_trusted():
    model = nsode.load(MODELS / "cart_pole.di")
    assert model.analyze().mass.varies
    assert foreseen(model.inclusion, model.ode, settings(model), model.p0).doubtful
    still = nsode.load(MODELS / "rolling_sphere.di")
    assert not foreseen(still.inclusion, still.ode, settings(still), still.p0).doubtful


def settings(model):
    return settle(Wish(), model.ode.run, 1)[0]


@pytest.mark.parametrize(("scheme", "step"), [(REGISTRY["rk4"], 4e-3), (VERLET, 3e-3)])
def test_an_impact_without_gravity_stays_within_what_the_note_says(scheme, step):
    text = (MODELS / "bouncing_mass.di").read_text().replace("fe = -9.8", "fe = 0")
    model = nsode.loads(text.replace("state v = 0", "state v = -1"))
    frequency = np.sqrt(1e5)
    least, most = speeds(scheme, step * frequency, 2.0, 5e-3 * frequency)
    speed = [
        model.simulate(2, step, method=scheme.name, x0={"p": 1 + part * step}, guard=False)["v"][-1]
        for part in np.linspace(0, 1, 40)
    ]
    assert most - least > 0.1
    assert min(speed) == pytest.approx(least, abs=0.02)
    assert max(speed) == pytest.approx(most, abs=0.02)


def test_a_run_that_cannot_be_checked_says_why_and_is_watched():
    text = (MODELS / "granular_column.di").read_text()
    model = nsode.loads(text.replace("constant n = 10", "constant n = 400"))
    said = []
    simulate(model.inclusion, model.ode, Wish(1e-3), manner=Manner(tell=said.append))
    [note] = [d for d in said if d.code == "NS410"]
    assert "1,200 states and multipliers" in note.notes[0]


def test_the_books_change_no_number_of_the_run():
    model = nsode.load(MODELS / "two_blocks_conveyor.di")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RunWarning)
        watched = model.simulate(1.0, 1e-3)
        alone = model.simulate(1.0, 1e-3, guard=False)
    assert np.array_equal(watched.x, alone.x)
    assert np.array_equal(watched.y, alone.y)
    assert np.array_equal(watched.modes, alone.modes)


def test_the_verdict_warns_from_one_percent_and_stops_from_ten():
    books = Books(("N",), 1, 0)
    t, start = np.array([0.0, 1.0]), np.array([[0, 1e5]])

    def said(surplus):
        # a state, then the balance and the energy moved; nothing is stored at the end, by K
        xs = np.array([[0, 0, 0], [0, -surplus, 1.0]])
        return verdict(books, t, xs, np.vstack([start, start]))

    assert said(0.005) is None
    assert said(-0.5) is None
    assert said(0.05).severity == "warning"
    assert said(0.15).severity == "error"


def test_balls_that_touch_at_rest_are_not_watched_for_rounding():
    row = nsode.loads("""
model row
constant n = 300
state x[i in 1..n] = 0.02*i  # the gaps are 0 but for rounding, some 1e-16
state v[i in 1..n] = 0
force N[i in 1..n-1] = dio(x[i+1] - x[i] - 0.02)
for i in 1..n: der(x[i]) = v[i]
for i in 1..n: der(v[i]) = (if i > 1 then N[i-1] else 0) - (if i < n then N[i] else 0)
approximate N: K = 1e5, beta = 4e-3, alpha = 2e-3, at equilibrium
""")
    found = row.simulate(0.5, 1e-3, every=10)
    assert np.abs(found["x"] - 0.02 * np.arange(1, 301)).max() < 1e-11


def test_the_guard_and_the_ledger_keep_the_same_books():
    model = nsode.load(MODELS / "bouncing_mass.di").with_ledger()
    watched = model.simulate(0.5, 4e-3)
    alone = model.simulate(0.5, 4e-3, guard=False)
    assert watched.y_names == alone.y_names
    assert np.array_equal(watched.y, alone.y)
    assert watched["f.stored"].max() > 1
