"""Derivatives against finite differences and CasADi, and their values at kinks."""

from __future__ import annotations

import ctypes
import math

import casadi as ca
import numpy as np
import pytest

import nsode
from nsode.backends import Options, emit
from nsode.backends.casadi import functions
from nsode.derivative import derivative, jacobian, partials, pattern, time_derivative
from nsode.evaluate import evaluate
from nsode.expr import FUNCTIONS, Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import AugmentedODE, Binding, LinearSolve, Parameter, Rate, State, layout
from tests.support import MODELS
from tests.support.native import Native, build
from tests.support.odes import Maker, call, ode, of_rates

X, Y, Z = Name("x"), Name("y"), Name("z")
ROWS = IndexRange("i", 1, 4)
OPERANDS = {"asin": (0.3,), "acos": (-0.4,), "log": (1.7,), "sqrt": (2.3,), "^": (1.6, 2.4)}
SMOOTH = [name for name, known in FUNCTIONS.items() if not known.boolean]


def value(expr: Expr, **values: float) -> float:
    return evaluate(expr, lambda name, at: values[name])


def difference(expr: Expr, by: str, **values: float) -> float:
    h = 1e-6
    up, down = values | {by: values[by] + h}, values | {by: values[by] - h}
    return (value(expr, **up) - value(expr, **down)) / (2 * h)


@pytest.mark.parametrize("function", SMOOTH)
@pytest.mark.parametrize("signs", [(1, 1), (-1, 1), (1, -1)])
def test_a_function_has_the_slope_of_its_finite_difference(function, signs):
    arity = FUNCTIONS[function].arity or 3
    operands = OPERANDS.get(function, (0.8, 1.9, 0.6))[:arity]
    if function not in {"log", "sqrt", "^"}:
        operands = tuple(s * v for s, v in zip((*signs, 1), operands, strict=False))
    names = ("x", "y", "z")[:arity]
    values = dict(zip(names, operands, strict=True))
    expr = Call(function, tuple(map(Name, names)))
    for name in names:
        slope = value(derivative(expr, name), **values)
        assert slope == pytest.approx(difference(expr, name, **values), rel=1e-7, abs=1e-8)


@pytest.mark.parametrize(
    ("level", "slip"), [(1.0, 0.4), (1.0, 1.7), (1.0, -1.7), (0.3, 0.2), (0.3, -0.9)]
)
def test_sat_and_shrink_have_the_slopes_that_casadi_gives_their_definition(level, slip):
    z, x = ca.SX.sym("z"), ca.SX.sym("x")
    definition = ca.if_else(ca.fabs(x) <= z, x, z * ca.sign(x))
    wanted = ca.Function("f", [z, x], [ca.gradient(definition, ca.vertcat(z, x))])(level, slip)
    expr = Call("sat", (Name("z"), X))
    found = [value(derivative(expr, name), z=level, x=slip) for name in ("z", "x")]
    assert found == np.array(wanted).ravel().tolist()
    factor = ca.fmin(1, z / x)
    wanted = ca.Function("f", [z, x], [ca.gradient(factor, ca.vertcat(z, x))])(level, abs(slip))
    expr = Call("shrink", (Name("z"), X))
    found = [value(derivative(expr, name), z=level, x=abs(slip)) for name in ("z", "x")]
    assert found == pytest.approx(np.array(wanted).ravel().tolist(), rel=1e-15)


@pytest.mark.parametrize(
    ("expr", "values", "slope"),
    [
        (call("max", 0.0, X), {"x": 0.0}, 0.0),
        (call("max", X, 0.0), {"x": 0.0}, 1.0),
        (call("min", 0.0, X), {"x": 0.0}, 0.0),
        (call("abs", X), {"x": 0.0}, 0.0),
        (call("sqrt", X), {"x": 0.0}, 0.0),
        (call("norm", X, Y), {"x": 0.0, "y": 0.0}, 0.0),
        (call("sat", Y, X), {"x": 0.0, "y": 0.0}, 0.0),
        (call("sat", Y, X), {"x": 0.0, "y": 1.0}, 1.0),
        (call("sat", Y, X), {"x": 1.0, "y": 1.0}, 0.0),
        (call("shrink", Y, X), {"x": 0.0, "y": 0.0}, 0.0),
        (call("shrink", Y, X), {"x": 1.0, "y": 1.0}, -1.0),
        (call("atan2", X, Y), {"x": 0.0, "y": 0.0}, 0.0),
        (call("asin", X), {"x": 1.0}, 0.0),
        (call("^", X, 0.5), {"x": 0.0}, 0.0),
        (call("^", X, 2.0), {"x": 0.0}, 0.0),
        (call("^", X, Y), {"x": 0.0, "y": 1.0}, 0.0),
        (If(call(">", X, 0.0), call("/", 1.0, X), Number(0.0)), {"x": 0.0}, 0.0),
    ],
)
def test_a_kink_has_the_finite_slope_that_the_convention_says(expr, values, slope):
    assert value(derivative(expr, "x"), **values) == slope


def test_the_elements_of_a_family_are_told_apart():
    here, after = Name("x", Index("i")), Name("x", Index("i", 1))
    expr = call("*", here, call("*", after, after))
    assert [p.name for p in partials(expr)] == [here, after, after]
    at = {"i": 2}
    lookup = {2: 3.0, 3: 5.0}
    found = evaluate(derivative(expr, "x", Index("i", 1)), lambda _, k: lookup[k], at)
    assert found == 30.0


def test_a_sum_that_hides_an_outer_index_is_renamed():
    inner = Sum(IndexRange("i", 1, 2), call("*", Name("x", Index("i")), Name("x", Index("i"))))
    (first, second) = partials(call("*", Name("y", Index("i")), inner), frozenset({"i"}))[1:]
    assert first.over[0].variable == second.over[0].variable != "i"


def test_deriving_in_time_goes_through_lets_pieces_and_mass_matrices():
    # a u = b with u, a, b moving: u' = (b' - a' u)/a
    solve = LinearSolve(("u",), ((call("+", 2.0, X),),), (call("*", X, Y),))
    system = ode(
        states=[State("x", Number(0.0)), State("y", Number(0.0))],
        bindings=[Binding("s", call("sin", X)), solve],
        rates=[Rate("x", call("*", 2.0, Y)), Rate("y", call("neg", X))],
    )
    definitions, rate = time_derivative(system, call("*", Name("s"), Name("u")))
    known = {"x": 0.7, "y": -1.2}
    for item in (*system.bindings, *definitions):
        if isinstance(item, Binding):
            known[item.name] = value(item.value, **known)
        else:
            right, divisor = value(item.right[0], **known), value(item.matrix[0][0], **known)
            known[item.unknowns[0]] = right / divisor

    def exact(x: float, y: float) -> float:
        return math.sin(x) * x * y / (2 + x)

    h, (x, y) = 1e-6, (0.7, -1.2)
    moved = [exact(x + s * h * 2 * y, y - s * h * x) for s in (1, -1)]
    assert value(rate, **known) == pytest.approx((moved[0] - moved[1]) / (2 * h), rel=1e-8)


def test_a_multiplier_has_no_derivative_in_time():
    inclusion = nsode.load(next(m for m in MODELS if m.stem == "bouncing_mass")).inclusion
    with pytest.raises(ValueError, match="multiplier `f` has no derivative"):
        time_derivative(inclusion, Name("f"))


def test_the_size_of_a_derivative_is_linear_in_the_lets():
    def nodes(length: int) -> int:
        bindings = [Binding("b0", call("sin", X))]
        for k in range(1, length):
            before = Name(f"b{k - 1}")
            bindings.append(Binding(f"b{k}", call("*", before, call("sin", before))))
        made = ode(
            states=[State("x", Number(0.0))],
            bindings=bindings,
            rates=[Rate("x", Name(f"b{length - 1}"))],
        )
        return sum(len(repr(item)) for item in jacobian(made).definitions)

    assert nodes(80) < 2.3 * nodes(40)


def test_bands_of_a_family_stay_families():
    x = [Name("x", Index("i", k)) for k in (-1, 0, 1)]
    inside = call("+", x[0], call("*", -2.0, x[1]), x[2])
    wall = If(call("<", Index("i"), Index(None, 4)), inside, Number(0.0))
    made = ode(states=[State("x", Number(0.0), ROWS)], rates=[Rate("x", wall, ROWS)])
    found = jacobian(made)
    assert not found.definitions
    assert [entry.column.at.offset for entry in found.entries] == [-1, 0, 1]
    places = pattern(found.entries, layout(made.states), layout(made.states))
    assert places.places[0][0] == places.places[2][-1] == -1


def dense(native: Native, *arguments: object) -> np.ndarray:
    """Return the Jacobian that compiled C computes."""
    nx = len(native.x_names)
    rows, columns = (ctypes.c_int * (nx * nx + 1))(), (ctypes.c_int * (nx + 1))()
    getattr(native.library, f"{native.prefix}_jac_pattern")(rows, columns)
    count = columns[nx]
    values = np.full(max(1, count), np.nan)
    t, x, u, p = arguments
    vectors = map(native._array, (x, native._u(u), native._p(p)))
    native._call("jac", float(t), *vectors, values)
    matrix = np.zeros((nx, nx))
    for j in range(nx):
        places = range(columns[j], columns[j + 1])
        assert sorted({rows[k] for k in places}) == [rows[k] for k in places]
        for k in places:
            matrix[rows[k], j] = values[k]
    return matrix


def dense_of_numpy(made: AugmentedODE, x: np.ndarray) -> np.ndarray:
    """Return the Jacobian that the NumPy module computes."""
    (text,) = emit("numpy", made, Options()).values()
    code: dict = {}
    exec(compile(text, "made", "exec"), code)
    matrix = np.zeros((len(x), len(x)))
    values, starts = code["jac"](0.1, x), code["jac_columns"]
    for j in range(len(x)):
        places = slice(starts[j], starts[j + 1])
        matrix[code["jac_rows"][places], j] = values[places]
    return matrix


def slopes_of(native: Native, x: np.ndarray, h: float) -> np.ndarray:
    steps = h * np.eye(len(x))
    return np.array([(native.rhs(0.1, x + e) - native.rhs(0.1, x - e)) / (2 * h) for e in steps]).T


@pytest.mark.parametrize("seed", range(8))
def test_the_jacobian_in_c_is_that_of_finite_differences_and_of_casadi(seed, tmp_path):
    made = Maker(seed, depth=3).make()
    native = build(made, tmp_path, flags=("-O0",))
    x = native.init() + np.random.default_rng(seed).normal(scale=0.3, size=len(native.x_names))
    found = dense(native, 0.1, x, None, None)
    coarse, fine = slopes_of(native, x, 1e-5), slopes_of(native, x, 5e-6)
    smooth = np.isclose(coarse, fine, rtol=1e-5, atol=1e-6)
    assert smooth.mean() > 0.9
    np.testing.assert_allclose(found[smooth], coarse[smooth], rtol=2e-4, atol=2e-5)
    np.testing.assert_allclose(dense_of_numpy(made, x), found, rtol=1e-11, atol=1e-11)
    rhs = functions(made).rhs
    wanted = rhs.jacobian()(0.1, x, native._u(None), native.p0, 0)[1]
    np.testing.assert_allclose(found, np.array(wanted), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_the_jacobian_of_a_model_is_casadis_away_from_kinks_and_finite_at_them(path, tmp_path):
    model = nsode.load(path)
    native = build(model.ode, tmp_path, flags=("-O0",))
    rng = np.random.default_rng(7)
    start = native.init()
    slopes = functions(model.ode).rhs.jacobian()
    for scale in (1e-4, 1e-2):
        x = start + scale * rng.normal(size=len(start))
        wanted = np.array(slopes(0.1, x, native._u(None), native.p0, 0)[1])
        size = np.abs(wanted).max()
        np.testing.assert_allclose(dense(native, 0.1, x, None, None), wanted, atol=1e-12 * size)
        np.testing.assert_allclose(dense_of_numpy(model.ode, x), wanted, atol=1e-12 * size)
    assert np.isfinite(dense(native, 0.0, start, None, None)).all()
    assert np.isfinite(dense(native, 0.0, np.zeros(len(start)), None, None)).all()


def test_a_quotient_by_zero_in_a_dead_branch_leaves_the_jacobian_finite(tmp_path):
    """y = x/k is infinite for k = 0, where the author left it out."""
    x, y, k = Name("x"), Name("y"), Name("k")
    long = call("*", call("*", call("sin", y), call("cos", y)), call("exp", call("neg", y)))
    made = ode(
        states=[State("x", Number(1.0))],
        parameters=[Parameter("k", (0.0,))],
        bindings=[Binding("y", call("/", x, k))],
        rates=[Rate("x", If(call(">", k, 0), long, Number(0.0)))],
    )
    native = build(made, tmp_path)
    assert dense(native, 0.0, [1.0], None, None).tolist() == [[0.0]]
    assert dense_of_numpy(made, np.ones(1)).tolist() == [[0.0]]


def test_a_nest_of_functions_is_derived_part_by_part():
    def nodes(depth: int) -> int:
        expr: Expr = X
        for _ in range(depth):
            expr = call("sin", call("*", expr, expr) if expr is X else call("+", expr, 1.0))
        return sum(len(repr(item)) for item in jacobian(of_rates(x=expr)).definitions)

    assert nodes(40) < 2.3 * nodes(20)


def test_a_state_that_nothing_drives_leaves_an_empty_pattern(tmp_path):
    native = build(of_rates(x=Number(1.0)), tmp_path)
    assert dense(native, 0.0, [0.0], None, None).tolist() == [[0.0]]
