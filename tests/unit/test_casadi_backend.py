"""CasADi functions: values on random ODEs, and Jacobians where others give NaN."""

from __future__ import annotations

import importlib
import sys
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

import nsode
from nsode.backends import Options, emit
from nsode.backends.casadi import functions
from nsode.diagnostics import ModelError
from nsode.expr import Expr, If, Index, IndexRange, Name, Number
from nsode.ode import AugmentedODE, AuxiliaryState, Binding, Input, Output, Parameter, Rate, State
from support.models import MODELS, PATHS
from support.modules import load_module
from support.odes import Maker, call, ode, of_rates
from support.remainders import REMAINDERS
from support.running import Tracer

ca = pytest.importorskip("casadi")

EPS = np.finfo(float).eps
NAN, INF = float("nan"), float("inf")


def dense(value: object) -> np.ndarray:
    return np.array(ca.DM(value)).squeeze()


def value_and_slopes(expr: Expr, *known: float) -> tuple[float, list[float]]:
    """Return an expression of the states a, b, ... and its derivatives by them."""
    names = "abcd"[: len(known)]
    made = ode(
        states=[State(name, Number(0.0)) for name in names],
        rates=[Rate(name, expr) for name in names],
    )
    model = functions(made)
    jacobian = ca.Function("j", [model.x], [model.dx[0], ca.jacobian(model.dx[0], model.x)])
    value, slopes = jacobian(list(known))
    return float(value), np.atleast_1d(dense(slopes)).tolist()


@pytest.mark.parametrize("seed", range(40))
def test_random_models_agree_with_a_scalar_walk_within_4_eps_of_the_term_scale(seed):
    made = Maker(seed).make()
    model = functions(made)
    x = np.random.default_rng(seed).normal(size=len(model.x_names))
    rates, scale = Tracer(made, 0.3, x, model.u0, model.p0).rhs()
    assert np.all(np.isfinite(rates))
    assert np.all(np.abs(dense(model.rhs(0.3, x, model.u0, model.p0)) - rates) <= 4 * EPS * scale)


@pytest.mark.parametrize("seed", range(5))
def test_jacobians_agree_with_differences_away_from_kinks(seed):
    made = Maker(seed, depth=3).make()
    model = functions(made)
    point = np.random.default_rng(seed).normal(size=len(model.x_names))
    exact = np.array(model.rhs.jacobian()(0.3, point, model.u0, model.p0, 0)[1])

    def rates(x: np.ndarray) -> np.ndarray:
        return dense(model.rhs(0.3, x, model.u0, model.p0))

    for k in range(len(point)):
        h = 1e-6 * np.eye(len(point))[k]
        estimate = (rates(point + h) - rates(point - h)) / 2e-6
        np.testing.assert_allclose(exact[:, k], estimate, rtol=1e-5, atol=1e-6)


A, B = Name("a"), Name("b")
SPEED = call("norm", A, B)


@pytest.mark.parametrize(
    ("expr", "at", "value", "slopes"),
    [
        # at rest, in free flight, and in both at once, in one dimension ...
        (call("sat", 2, A), (0.0,), 0.0, [1.0]),
        (call("sat", 0, A), (3.0,), 0.0, [0.0]),
        (call("sat", 0, A), (0.0,), 0.0, [0.0]),
        (call("sat", A, B), (0.0, 0.0), 0.0, [0.0, 0.0]),
        (call("sat", A, B), (0.0, -3.0), 0.0, [-1.0, 0.0]),
        # ... and in two
        (call("*", call("shrink", 2, SPEED), A), (0.0, 0.0), 0.0, [1.0, 0.0]),
        (call("*", call("shrink", 0, SPEED), A), (3.0, 4.0), 0.0, [0.0, 0.0]),
        (call("*", call("shrink", 0, SPEED), A), (0.0, 0.0), 0.0, [0.0, 0.0]),
        (call("*", call("shrink", 5, call("norm", A, 0)), A), (10.0,), 5.0, [0.0]),
        (SPEED, (0.0, 0.0), 0.0, [0.0, 0.0]),
        (call("sqrt", call("*", A, A)), (0.0,), 0.0, [0.0]),
        (call("^", A, 0.5), (0.0,), 0.0, [0.0]),
        (call("^", A, 1), (0.0,), 0.0, [1.0]),
        (call("^", A, 0), (0.0,), 1.0, [0.0]),
        (call("^", A, 3), (0.0,), 0.0, [0.0]),
        (call("abs", A), (0.0,), 0.0, [0.0]),
        (call("atan2", A, B), (0.0, 0.0), 0.0, [0.0, 0.0]),
        (call("atan2", A, B), (0.0, 2.0), 0.0, [0.5, 0.0]),
        (call("asin", A), (1.0,), np.pi / 2, [0.0]),
        (call("max", 0, A), (0.0,), 0.0, [0.0]),
        (call("max", A, B), (1.0, 2.0), 2.0, [0.0, 1.0]),
        (call("min", A, B), (1.0, 2.0), 1.0, [1.0, 0.0]),
        (call("max", A, B), (INF, -INF), INF, [1.0, 0.0]),
        # a guard that a person writes is one
        (If(call(">", A, 0), call("/", 1, A), Number(0.0)), (0.0,), 0.0, [0.0]),
        (If(call(">", A, 0), call("sqrt", A), Number(7.0)), (-1.0,), 7.0, [0.0]),
        (If(call("==", A, 0), Number(1.0), call("/", call("sin", A), A)), (0.0,), 1.0, [0.0]),
        (If(call(">", A, 0), call("log", A), Number(0.0)), (-1.0,), 0.0, [0.0]),
        (If(call(">", A, 0), call("^", A, -0.5), Number(0.0)), (0.0,), 0.0, [0.0]),
    ],
)
def test_value_and_jacobian_are_right_where_others_are_not_a_number(expr, at, value, slopes):
    found, derivatives = value_and_slopes(expr, *at)
    assert found == pytest.approx(value, abs=0)
    assert derivatives == slopes


@pytest.mark.parametrize("place", range(2))
@pytest.mark.parametrize("function", ["max", "min", "sat", "shrink", "norm", "atan2", "mod"])
def test_nan_goes_through(function, place):
    args = [1.0, 1.0]
    args[place] = NAN
    assert np.isnan(value_and_slopes(call(function, A, B), *args)[0])


@pytest.mark.parametrize(
    ("expr", "at", "expected"),
    [
        (call("/", A, A), 0.0, NAN),
        (call("+", call("+", A, 1e16), -1e16), 1.5, 2.0),
        (call("*", 0, A), INF, NAN),
        (call("+", A, call("neg", A)), INF, NAN),
    ],
)
def test_nothing_is_rewritten(expr, at, expected):
    np.testing.assert_equal(value_and_slopes(expr, at)[0], expected)


def test_building_leaves_the_settings_of_casadi_alone():
    for setting in (False, True):
        ca.GlobalOptions.setSimplificationOnTheFly(setting)
        functions(of_rates(x=call("max", 0, Name("x"))))
        assert ca.GlobalOptions.getSimplificationOnTheFly() is setting


@pytest.mark.parametrize(("a", "b", "expected"), REMAINDERS)
def test_mod_is_floored(a, b, expected):
    np.testing.assert_array_equal(value_and_slopes(call("mod", A, B), a, b)[0], expected)


@pytest.mark.parametrize(
    "zero", [If(call(">", B, 0), A, Number(5.0)), call("min", A, B), call("max", call("neg", B), A)]
)
@pytest.mark.parametrize(("given", "turn"), [(0.0, np.pi), (-0.0, -np.pi)])
def test_a_choice_keeps_the_sign_of_a_zero(zero, given, turn):
    assert value_and_slopes(call("atan2", zero, -1), given, 1.0)[0] == turn


def oscillator() -> AugmentedODE:
    """x'' = -k x + f + sin t, and what stands beside it."""
    spring = call("neg", call("*", Name("k"), Name("x")))
    force = call("+", spring, Name("f"), call("sin", Name("t")))
    start = call("max", 0, Name("F"))
    return ode(
        "oscillator",
        states=[State("x", Name("k")), State("v", Number(1.0)), State("N.e", start)],
        inputs=[Input("f", 0.5)],
        parameters=[Parameter("k", (4.0,))],
        bindings=[Binding("F", force)],
        rates=[Rate("x", Name("v")), Rate("v", Name("F")), Rate("N.e", Number(0.0))],
        outputs=[Output("force", Name("F"))],
        auxiliary=[AuxiliaryState("N.e", Number(0.0), start, "N", "dio(x)")],
    )


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_shipped_models_have_finite_jacobians_at_rest_and_in_free_flight(path):
    model = nsode.load(path).casadi()
    jacobian = model.rhs.jacobian()
    zero = np.zeros_like(model.x0)
    for x in (model.x0, zero, zero + 1.0, zero - 1e-3, zero + 1e-300):
        blocks = jacobian(0.0, x, np.nan_to_num(model.u0), model.p0, 0)
        assert all(np.all(np.isfinite(np.array(block))) for block in blocks)


def test_a_sphere_above_the_floor_feels_no_friction_at_rest():
    """Example I with v = w = 0 and e = a = 0: every force and every slope of it is zero."""
    model = nsode.load(MODELS / "rolling_sphere.di").casadi()
    x = np.where(np.isin(model.x_names, ["p.z", "q[1]"]), 1.0, 0.0)
    slopes = ca.Function("j", [model.t, model.x, model.u, model.p], [ca.jacobian(model.y, model.x)])
    forces = [model.y_names.index(name) for name in ("N", "F.x", "F.y")]
    assert not np.any(np.array(slopes(0, x, [], model.p0))[forces])


def test_the_slope_of_friction_in_stick_is_that_of_its_spring_and_damper():
    """Pressed and at rest, F = K (a + beta slip), so dF.x/dv.x = K beta and dF.x/da.x = K."""
    model = nsode.load(MODELS / "rolling_sphere.di").casadi()
    values = {"p.z": 0.499, "N.e": 1e-3, "q[1]": 1.0}
    x = np.array([values.get(name, 0.0) for name in model.x_names])
    slopes = ca.Function("j", [model.t, model.x, model.u, model.p], [ca.jacobian(model.y, model.x)])
    row = np.array(slopes(0, x, [], model.p0))[model.y_names.index("F.x")]
    found = {name: slope for name, slope in zip(model.x_names, row, strict=True) if slope}
    K, beta, R = 1e5, 4e-3, 0.5
    assert found == pytest.approx({"v.x": K * beta, "w.y": -K * beta * R, "F.a.x": K})


def test_the_sphere_ends_up_rolling_through_an_integrator_of_casadi():
    model = nsode.load(MODELS / "rolling_sphere.di").casadi()
    options = {"reltol": 1e-9, "abstol": 1e-10, "max_num_steps": 200_000}
    sphere = ca.integrator("sphere", "cvodes", model.dae(), 0.0, 4.0, options)
    end = dict(zip(model.x_names, dense(sphere(x0=model.x0, p=model.p0)["xf"]), strict=True))
    assert end["v.x"] == pytest.approx(5 / 7 * 5.5, abs=1e-6)
    assert end["w.y"] * 0.5 == pytest.approx(end["v.x"], abs=1e-6)


def test_functions_have_named_inputs_and_outputs():
    model = functions(oscillator())
    assert model.rhs.name_in() == model.out.name_in() == ["t", "x", "u", "p"]
    assert model.step.name_in() == ["t", "h", "x", "u", "p"]
    assert [f.name_out() for f in (model.rhs, model.out, model.step)] == [["dx"], ["y"], ["x_next"]]
    found = model.rhs(t=0.0, x=[1.0, 2.0, 3.0], u=0.5, p=4.0)["dx"]
    np.testing.assert_array_equal(dense(found), [2.0, -3.5, 0.0])


def test_appended_states_may_start_from_the_others():
    np.testing.assert_array_equal(functions(oscillator()).x0, [4.0, 1.0, 0.0])
    assert dense(functions(oscillator()).init([20.0], [4.0]))[2] == 4.0


@pytest.mark.parametrize("method", ["rk4", "heun", "euler"])
def test_the_step_is_that_of_the_numpy_module(method):
    model, module = functions(oscillator(), method), load_module(oscillator())
    x = np.array([0.3, -0.2, 0.1])
    found = dense(model.step(0.7, 0.1, x, [0.5], [4.0]))
    expected = getattr(module, f"step_{method}")(0.7, 0.1, x)
    np.testing.assert_allclose(found, expected, rtol=4 * EPS, atol=0)


@pytest.mark.parametrize("name", ["haptic_wall", "two_blocks_conveyor"])
def test_steps_accumulate_in_one_function_as_they_do_in_compiled_c(name):
    scene = nsode.load(MODELS / f"{name}.di")
    model, h, n = scene.casadi(), scene.inclusion.run.step, 300
    run = model.step.mapaccum("run", n, ["x"], ["x_next"])
    found = dense(run(h * np.arange(n), h, model.x0, model.u0, model.p0)).T
    expected = scene.simulate(n * h, h, method="rk4").x[1:]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


def test_a_method_without_a_tableau_is_refused():
    with pytest.raises(ValueError, match="no explicit Runge-Kutta method; there are rk4"):
        functions(oscillator(), "bdf")


FINE = {"cvodes": {"reltol": 1e-11, "abstol": 1e-13}, "rk": {"number_of_finite_elements": 400}}


@pytest.mark.parametrize("solver", FINE)
def test_the_integrators_of_casadi_take_the_dae(solver):
    model = functions(oscillator())
    integrator = ca.integrator("F", solver, model.dae(), 0.0, 2.0, FINE[solver])
    end = dense(integrator(x0=[1.0, 0.0, 0.0], u=0.0, p=4.0)["xf"])
    # x'' + 4 x = sin t with x(0) = 1, x'(0) = 0
    exact = np.cos(4.0) - np.sin(4.0) / 6 + np.sin(2.0) / 3
    assert end[0] == pytest.approx(exact, rel=1e-8)


def test_a_model_without_inputs_has_none_in_its_dae():
    assert set(functions(of_rates(x=Number(1.0))).dae()) == {"t", "x", "p", "ode"}


def test_a_family_has_walls_and_a_jacobian_that_is_sparse():
    n, rows = 6, IndexRange("i", 1, 6)
    x = {k: Name("x", Index("i", k)) for k in (-1, 0, 1)}
    stretch = call("+", x[0], call("neg", If(call(">", Index("i"), 1), x[-1], Number(0.0))))
    made = ode(
        states=[State("x", call("*", 0.5, Index("i")), rows)],
        bindings=[Binding("N", call("max", 0, stretch), rows)],
        rates=[Rate("x", call("*", -1, Name("N", Index("i"))), rows)],
        outputs=[Output("gap", stretch, rows)],
    )
    model = functions(made)
    np.testing.assert_array_equal(model.x0, 0.5 * np.arange(1, n + 1))
    np.testing.assert_array_equal(dense(model.rhs(0, model.x0, [], [])), -0.5 * np.ones(n))
    np.testing.assert_array_equal(dense(model.out(0, model.x0, [], [])), 0.5 * np.ones(n))
    assert ca.jacobian(model.dx, model.x).nnz() == 2 * n - 1


def test_a_long_column_is_one_graph_that_grows_with_its_length():
    text = (MODELS / "granular_column.di").read_text()

    def column(n: int) -> AugmentedODE:
        return nsode.loads(text.replace("n = 10\n", f"n = {n}\n")).ode

    sizes = [functions(column(n)).rhs.n_nodes() for n in (250, 500, 1000)]
    assert sizes[2] - sizes[1] == 2 * (sizes[1] - sizes[0])
    long, module = functions(column(1000)), load_module(column(1000))
    x = long.x0 - 1e-3 * np.arange(len(long.x_names)) % 7e-3
    expected = module.rhs(0.0, x)
    np.testing.assert_allclose(dense(long.rhs(0, x, [], long.p0)), expected, rtol=1e-12)
    assert np.count_nonzero(expected[2000:]) > 100  # the balls press
    slopes = ca.jacobian(long.dx, long.x)
    assert slopes.nnz() < 10_000


def test_serialized_functions_load_and_compute_the_same(tmp_path, monkeypatch):
    for name, text in emit("casadi", oscillator(), Options(prefix="osc")).items():
        (tmp_path / name).write_text(text, encoding="ascii")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["osc.casadi", "osc_casadi.py"]
    monkeypatch.syspath_prepend(tmp_path)
    loaded, model = importlib.import_module("osc_casadi"), functions(oscillator())
    sys.modules.pop("osc_casadi")
    arguments = (0.3, [1.0, 2.0, 3.0], loaded.u0, loaded.p0)
    for one, other in ((loaded.rhs, model.rhs), (loaded.out, model.out)):
        np.testing.assert_array_equal(dense(one(*arguments)), dense(other(*arguments)))
    assert loaded.x_names == model.x_names == ("x", "v", "N.e")
    np.testing.assert_array_equal(dense(loaded.init(loaded.u0, loaded.p0)), model.x0)


def test_single_precision_is_refused():
    with pytest.raises(ModelError, match="double precision only"):
        emit("casadi", oscillator(), Options(real="float"))


@pytest.fixture
def do_mpc():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return pytest.importorskip("do_mpc")


def test_do_mpc_takes_the_model(do_mpc):
    model = functions(oscillator())
    made = model.do_mpc()
    assert list(made.x.keys()) == ["x_", "v", "N_e"]
    arguments = [made.x, made.u, made.p, made.tvp]
    rates = ca.Function("rates", arguments, [made._rhs])
    found = dense(rates([1.0, 2.0, 3.0], 0.5, 4.0, 0.3))
    np.testing.assert_array_equal(found, dense(model.rhs(0.3, [1.0, 2.0, 3.0], 0.5, 4.0)))


def test_the_sphere_ends_up_rolling_through_do_mpc(do_mpc):
    model = nsode.load(MODELS / "rolling_sphere.di").casadi()
    simulator = do_mpc.simulator.Simulator(model.do_mpc())
    simulator.set_param(t_step=4.0, integration_tool="cvodes", abstol=1e-10, reltol=1e-9)
    parameters = simulator.get_p_template()
    parameters.master = ca.DM(model.p0)
    simulator.set_p_fun(lambda t: parameters)
    simulator.setup()
    simulator.x0 = model.x0
    end = dict(zip(model.x_names, simulator.make_step(None).squeeze(), strict=True))
    assert end["v.x"] == pytest.approx(5 / 7 * 5.5, abs=1e-6)


def test_acados_is_handed_explicit_and_implicit_dynamics(monkeypatch):
    stand_in = SimpleNamespace(AcadosModel=SimpleNamespace)
    monkeypatch.setitem(sys.modules, "acados_template", stand_in)
    made = functions(oscillator()).acados()
    assert made.name == "oscillator"
    residual = ca.Function("r", [made.t, made.x, made.xdot, made.u, made.p], [made.f_impl_expr])
    assert not np.any(dense(residual(0, [1, 2, 3], [2.0, -3.5, 0.0], 0.5, 4)))
