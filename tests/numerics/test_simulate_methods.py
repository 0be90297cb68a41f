"""Methods of a run: observed orders, tolerances, and agreement with other libraries."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.integrators import REGISTRY
from nsode.integrators.pairs import PAIRS
from nsode.simulate import RunError, cache, compilers, scene
from nsode.simulate.settings import SOLVERS
from support.models import MODELS

# p'' = -p + sin(2 t): smooth, driven, not autonomous
SMOOTH = """model smooth
state p = 1
state v = 0
der(p) = v
der(v) = -p + sin(2*t)
simulate 5 step 0.1
"""
DRIVEN = "model m\ninput f\nstate p = 0\nder(p) = f\nsimulate 1 step 0.1\n"


def exact(t):
    return np.cos(t) + 2 / 3 * np.sin(t) - np.sin(2 * t) / 3


def error(**kwargs):
    found = nsode.loads(SMOOTH).simulate(**kwargs)
    return np.abs(found["p"] - exact(found.t)).max()


@pytest.mark.parametrize("method", REGISTRY)
def test_the_observed_order_is_the_one_declared(method):
    errors = [error(step=5 / steps, method=method) for steps in (200, 400, 800)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(REGISTRY[method].order, abs=0.1)


@pytest.mark.parametrize("method", PAIRS)
def test_a_pair_satisfies_the_conditions_of_its_orders(method):
    pair = PAIRS[method]
    a, b, c = pair.method.a, pair.method.b, pair.method.c
    lower = [w - e for w, e in zip(b, pair.error, strict=True)]
    # quadrature conditions: 5 for the kept result, 4 for the other
    for k in range(5):
        assert sum(w * node**k for w, node in zip(b, c, strict=True)) == Fraction(1, k + 1)
    for k in range(4):
        assert sum(w * node**k for w, node in zip(lower, c, strict=True)) == Fraction(1, k + 1)
    inner = [sum(w * node for w, node in zip(row, c, strict=False)) for row in a]
    assert sum(w * m for w, m in zip(b, inner, strict=True)) == Fraction(1, 6)


@pytest.mark.parametrize("method", PAIRS)
def test_a_pair_keeps_its_tolerance_between_its_steps_too(method):
    # rows every 0.01 s: most are interpolated
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        assert error(step=0.01, method=method, tolerance=tolerance) < 20 * tolerance


@pytest.mark.parametrize("method", PAIRS)
def test_the_steps_of_a_pair_depend_on_nothing_but_the_problem(method):
    model = nsode.load(MODELS / "bouncing_mass.di")
    dense = model.simulate(3, 1e-3, method=method)
    for every in (10, 700):
        sparse = model.simulate(3, 1e-3, method=method, every=every)
        rows = np.append(np.arange(0, 3000, every), 3000)
        assert np.array_equal(sparse.x, dense.x[rows])


@pytest.mark.parametrize("method", [*PAIRS, *SOLVERS])
def test_impacts_agree_with_a_hundred_times_finer_runge_kutta(method):
    pytest.importorskip(SOLVERS.get(method, "numpy"))
    model = nsode.load(MODELS / "bouncing_mass.di")
    fine = model.simulate(1.0, 1e-5, every=1000)
    found = model.simulate(1.0, 1e-2, method=method, tolerance=1e-8)
    assert found["p"] == pytest.approx(fine["p"], abs=1e-5)
    assert found.t == pytest.approx(fine.t, rel=1e-14)


@pytest.mark.parametrize("method", [*PAIRS, "cvodes", "RK45"])
def test_inputs_are_held_between_the_points_of_the_grid(method):
    pytest.importorskip(SOLVERS.get(method, "numpy"))
    found = nsode.loads(DRIVEN).simulate(method=method, every=3, inputs={"f": lambda t: t**2})
    assert found.t == pytest.approx([0, 0.3, 0.6, 0.9, 1.0])
    assert found["p"][-1] == pytest.approx(0.1 * np.sum((0.1 * np.arange(10)) ** 2), rel=1e-9)


@pytest.mark.parametrize("method", [*PAIRS, "cvodes", "BDF"])
def test_a_solution_that_ends_keeps_the_rows_before_its_end(method, capfd):
    pytest.importorskip(SOLVERS.get(method, "numpy"))
    model = nsode.loads("model m\nstate p = 1\nder(p) = p^2\n")
    with pytest.raises(RunError) as refusal:
        model.simulate(2, 0.01, method=method)
    kept = refusal.value.trajectory
    assert 0.98 <= kept.t[-1] <= 1.001  # it is 1/(1 - t)
    assert kept["p"][50] == pytest.approx(2, rel=1e-6)
    capfd.readouterr()


def test_the_sphere_rolls_at_five_sevenths_by_a_pair_too():
    found = nsode.load(MODELS / "rolling_sphere.di").simulate(method="dopri5")
    assert found["v.x"][-1] == pytest.approx(5.5 * 5 / 7, rel=1e-6)


@pytest.mark.parametrize("tolerance", [0.0, 1.0, -1e-6, float("nan")])
def test_a_tolerance_out_of_range_is_refused(tolerance):
    with pytest.raises(ModelError, match="tolerance"):
        nsode.loads(SMOOTH).simulate(method="dopri5", tolerance=tolerance)


# without a compiler


@pytest.fixture
def no_compiler(monkeypatch):
    monkeypatch.setattr(scene, "compiler", lambda: None)


@pytest.mark.filterwarnings("ignore:a step of .* does not resolve the impacts")  # Euler's
@pytest.mark.parametrize("method", REGISTRY)
def test_without_a_compiler_casadi_runs_the_model_to_the_same_numbers(method, request):
    pytest.importorskip("casadi")
    model = nsode.load(MODELS / "frictional_contact.di")
    compiled = model.simulate(0.2, 5e-4, method=method, every=7, guard=False)
    request.getfixturevalue("no_compiler")
    virtual = nsode.load(MODELS / "frictional_contact.di").simulate(
        0.2, 5e-4, method=method, every=7, guard=False
    )
    np.testing.assert_allclose(virtual.x, compiled.x, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(virtual.y, compiled.y, rtol=1e-9, atol=1e-9)
    assert np.array_equal(virtual.modes, compiled.modes)


def test_without_a_compiler_a_pair_is_refused_with_the_way_to_one(no_compiler):
    with pytest.raises(ModelError, match="no C compiler") as refusal:
        nsode.loads(SMOOTH).simulate(method="dopri5")
    assert "pip install ziglang" in str(refusal.value)


def test_the_compiler_that_cc_names_comes_first(monkeypatch):
    monkeypatch.setenv("CC", "clang -fcolor-diagnostics")
    found = compilers.compiler()
    if found is None or "clang" not in found.command[0]:
        pytest.skip("clang is not installed")
    assert found.command[1:] == ("-fcolor-diagnostics",)


def test_the_compiler_of_a_wheel_computes_the_same_run_where_there_is_no_other(
    monkeypatch, tmp_path
):
    pytest.importorskip("ziglang")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("CC", "gcc")
    expected = nsode.load(MODELS / "two_blocks_conveyor.di").simulate(0.7, method="dopri5")
    monkeypatch.delenv("CC")
    monkeypatch.setenv("PATH", str(tmp_path))
    using = compilers.compiler()
    assert using is not None
    assert "ziglang" in using.command[0]
    found = nsode.load(MODELS / "two_blocks_conveyor.di").simulate(0.7, method="dopri5")
    assert np.array_equal(found.x, expected.x)
    assert cache.workbench().is_dir()
    cache.clear()
    assert list(cache.folder().iterdir()) == []


@pytest.mark.parametrize("cc", ["gcc", "clang", "tcc"])
def test_every_compiler_computes_the_same_run(cc, monkeypatch):
    monkeypatch.setenv("CC", cc)
    using = compilers.compiler()
    if using is None or cc not in using.command[0]:
        pytest.skip(f"{cc} is not installed")
    found = nsode.load(MODELS / "two_blocks_conveyor.di").simulate(0.7)
    monkeypatch.setenv("CC", "gcc")
    expected = nsode.load(MODELS / "two_blocks_conveyor.di").simulate(0.7)
    assert np.array_equal(found.x, expected.x)
