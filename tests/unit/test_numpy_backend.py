"""The NumPy module: its text and what it computes, on hand-made and random ODEs."""

from __future__ import annotations

import ast
import keyword

import numpy as np
import pytest

from nsode.backends import Options, emit
from nsode.backends.numpy.names import python_names
from nsode.expr import Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.integrators import REGISTRY, RungeKutta
from nsode.ode import (
    AugmentedODE,
    AuxiliaryState,
    Binding,
    Input,
    LinearSolve,
    Output,
    Parameter,
    Rate,
    State,
)
from support.modules import load_module
from support.odes import Maker, call, ode, of_rates
from support.remainders import REMAINDERS
from support.running import Tracer

EPS = np.finfo(float).eps
NAN = float("nan")
INF = float("inf")


def value(expr: Expr, **known: float) -> float:
    """Return what the module computes for an expression of parameters."""
    made = ode(
        states=[State("s", Number(0.0))],
        parameters=[Parameter(name, (number,)) for name, number in known.items()],
        rates=[Rate("s", expr)],
    )
    return float(load_module(made).rhs(0.0, [0.0])[0])


@pytest.mark.parametrize("seed", range(80))
def test_random_models_agree_with_a_scalar_walk_within_4_eps_of_the_term_scale(seed):
    made = Maker(seed).make()
    module = load_module(made)
    x = np.random.default_rng(seed).normal(size=module.NX)
    rates, scale = Tracer(made, 0.3, x, module.u0, module.p0).rhs()
    assert np.all(np.isfinite(rates))
    assert np.all(np.abs(module.rhs(0.3, x) - rates) <= 4 * EPS * scale)


@pytest.mark.parametrize(
    ("expr", "expected"),
    [
        (call("/", 1, 0), INF),
        (call("/", call("neg", 1), 0), -INF),
        (call("/", 0, 0), NAN),
        (call("^", 10, 400), INF),
        (call("^", call("neg", 8), call("/", 1, 3)), NAN),
        (call("sqrt", -1), NAN),
        (call("log", 0), -INF),
        (call("exp", 1e4), INF),
        (call("*", 1e200, 1e200), INF),
        (call("/", If(call("<", 1, 2), Number(1.0), Number(2.0)), 0), INF),
        (call("^", 0, -1), INF),
        (call("mod", 1, 0), NAN),
    ],
)
def test_undefined_values_are_ieee_values_and_raise_nothing(expr, expected):
    np.testing.assert_equal(value(expr), expected)


@pytest.mark.parametrize("place", range(2))
@pytest.mark.parametrize("function", ["max", "min", "sat", "shrink", "norm", "+", "*", "/"])
def test_nan_goes_through(function, place):
    args: list[float] = [1.0, 1.0]
    args[place] = NAN
    expr = call(function, Name("a"), Name("b"))
    assert np.isnan(value(expr, a=args[0], b=args[1]))


def test_friction_at_rest_without_normal_force_is_zero():
    assert value(call("*", call("shrink", 0, call("norm", 0, 0)), 0)) == 0.0
    assert value(call("sat", 0, 0)) == 0.0


@pytest.mark.parametrize(
    ("level", "x", "expected"),
    [(2, 3, 2), (2, -3, -2), (2, 1.5, 1.5), (0, 5, 0), (INF, 5, 5), (2, -INF, -2)],
)
def test_sat_cuts_off_at_its_level(level, x, expected):
    assert value(call("sat", Name("level"), Name("x")), level=level, x=x) == expected


@pytest.mark.parametrize(("a", "b", "expected"), REMAINDERS)
def test_mod_is_floored(a, b, expected):
    np.testing.assert_array_equal(value(call("mod", Name("a"), Name("b")), a=a, b=b), expected)


@pytest.mark.parametrize(
    ("expr", "expected"),
    [
        (call("neg", call("^", Name("a"), 2)), -9),
        (call("^", call("neg", Name("a")), 2), 9),
        (call("^", 2, call("^", Name("a"), 2)), 512),
        (call("+", 2, call("neg", call("neg", Name("a")))), 5),
        (call("+", 2, call("neg", call("+", Name("a"), 1))), -2),
        (call("/", 12, call("neg", call("*", Name("a"), 2))), -2),
        (call("/", 12, call("*", Name("a"), 2)), 2),
        (call("*", call("/", 12, Name("a")), 2), 8),
        (call("+", 1, call("+", Name("a"), -5)), -1),
        (call("*", If(call("<", Name("a"), 0), Number(1.0), Number(2.0)), 3), 6),
        (
            If(
                call("not", call("and", call("<", Name("a"), 4), call("<", 4, Name("a")))),
                Number(1.0),
                Number(2.0),
            ),
            1,
        ),
    ],
)
def test_parentheses_stand_where_they_must(expr, expected):
    assert value(expr, a=3.0) == expected


def test_terms_are_added_from_the_left():
    big = call("+", call("+", Name("a"), 1e16), -1e16)
    assert value(big, a=1.5) == (1.5 + 1e16) - 1e16 != 1.5


def test_a_sum_of_thousands_of_terms_compiles_and_keeps_its_order():
    terms = [call("neg", Name("a")) if k % 3 else Name("b") for k in range(5000)]
    expected = 0.0
    for k in range(5000):
        expected += -0.1 if k % 3 else 0.7
    assert value(call("+", *terms), a=0.1, b=0.7) == expected


HARD_NAMES = [
    *keyword.kwlist, *keyword.softkwlist, "np", "real", "int", "print", "rhs", "out", "init", "t",
    "h", "x", "u", "p", "dx", "NX", "p0", "sat", "solve", "vectors", "k1", "step_rk4", "I", "S",
    "tiny", "flush", "N_K", "N.K", "N__K", "lambda_", "x_names", "indices", "numpy", "a.x", "a_x",
]  # fmt: skip


@pytest.mark.parametrize("role", ["parameter", "state", "binding"])
@pytest.mark.parametrize("name", [n for n in HARD_NAMES if n != "t"])
def test_no_name_of_a_model_clashes(name, role):
    rate = call("*", -2, Name(name))
    states, parameters, bindings = [], [], []
    match role:
        case "parameter":
            states, parameters = [State("s", Number(0.0))], [Parameter(name, (1.0,))]
        case "state":
            states = [State(name, Number(1.0))]
        case _:
            states, bindings = [State("s", Number(0.0))], [Binding(name, Number(1.0))]
    made = ode(
        states=states, parameters=parameters, bindings=bindings, rates=[Rate(states[0].name, rate)]
    )
    module = load_module(made)
    assert module.rhs(0.0, module.init()) == [-2.0]
    assert module.step_rk4(0.0, 0.0, module.init()) == module.init()


def test_spelling_is_one_to_one():
    spelling = python_names(HARD_NAMES)
    assert len(set(spelling.values())) == len(HARD_NAMES)
    assert all(word.isidentifier() and not keyword.iskeyword(word) for word in spelling.values())


def test_a_name_that_needs_no_change_keeps_its_spelling():
    assert python_names(["N.K", "N_K"])["N_K"] == "N_K"


def test_text_that_is_no_name_cannot_become_code():
    evil = '__import__("os").system("true")\n#'
    made = ode(
        states=[State(evil, Number(1.0))], rates=[Rate(evil, call("neg", Name(evil)))], name=evil
    )
    [(file, text)] = emit("numpy", made, Options()).items()
    assert file.removesuffix(".py").isidentifier()
    tree = ast.parse(text)
    assert not [n for n in ast.walk(tree) if isinstance(n, ast.Name) and n.id == "__import__"]
    assert load_module(made).x_names == (evil,)


@pytest.mark.parametrize("name", ["numpy", "random", "lambda", "types"])
def test_the_file_hides_no_module_of_python(name):
    [file] = emit("numpy", ode(name), Options())
    assert file == f"{name}_model.py"


def chain(n: int) -> AugmentedODE:
    """A row of n masses between walls: x[i] feels its two neighbors."""
    rows = IndexRange("i", 1, n)
    here, left, right = (Name("x", Index("i", k)) for k in (0, -1, 1))
    behind = If(call(">", Index("i"), 1), left, Number(0.0))
    ahead = If(call("<", Index("i"), n), right, Name("L"))
    force = call("+", ahead, behind, call("neg", call("*", 2, here)))
    return ode(
        states=[State("x", call("*", 0.5, Index("i")), rows)],
        parameters=[Parameter("L", (7.0,))],
        bindings=[Binding("f", force, rows)],
        rates=[Rate("x", Name("f", Index("i")), rows)],
        outputs=[Output("total", Sum(rows, Name("x", Index("i")))), Output("pull", force, rows)],
    )


@pytest.mark.parametrize("n", [1, 2, 3, 10])
def test_a_family_with_walls_computes_each_element(n):
    module = load_module(chain(n))
    x = module.init()
    np.testing.assert_array_equal(x, 0.5 * np.arange(1, n + 1))
    padded = np.concatenate([[0.0], x, [7.0]])
    expected = padded[2:] + padded[:-2] - 2 * x
    np.testing.assert_array_equal(module.rhs(0.0, x), expected)
    np.testing.assert_array_equal(module.out(0.0, x), [x.sum(), *expected])


def test_the_text_of_a_family_does_not_grow_with_it():
    # Numbers of as many digits, up to three times the length for the places of x.
    sizes = [len(emit("numpy", chain(n), Options())["made.py"]) for n in (4_100, 4_900)]
    assert sizes[1] == sizes[0]


def test_a_sum_runs_in_rising_order():
    rows = IndexRange("i", 1, 4)
    made = ode(
        states=[State("s", Number(0.0))],
        parameters=[Parameter("a", (1.0, 1e16, 1.0, -1e16), rows)],
        rates=[Rate("s", Sum(rows, Name("a", Index("i"))))],
    )
    assert load_module(made).rhs(0.0, [0.0])[0] == ((1.0 + 1e16) + 1.0) - 1e16


def test_a_sum_inside_a_family_pairs_all_elements():
    rows, other = IndexRange("i", 1, 3), IndexRange("j", 1, 3)
    pair = call("*", Name("x", Index("i")), call("+", Name("x", Index("j")), Index("i")))
    made = ode(
        states=[State("x", Number(0.0), rows)],
        rates=[Rate("x", Sum(other, pair), rows)],
    )
    x = np.array([2.0, 3.0, 5.0])
    expected = [sum(a * (b + i) for b in x) for i, a in enumerate(x, start=1)]
    np.testing.assert_array_equal(load_module(made).rhs(0.0, x), expected)


def test_a_family_of_equal_elements_is_a_whole_array():
    rows = IndexRange("i", 0, 2)
    made = ode(
        states=[State("x", Number(0.0), rows)],
        parameters=[Parameter("c", (4.0,))],
        bindings=[Binding("b", Name("c"), rows)],
        rates=[Rate("x", Name("b", Index("i")), rows)],
    )
    np.testing.assert_array_equal(load_module(made).rhs(0.0, np.zeros(3)), [4.0, 4.0, 4.0])


def coupled(over: IndexRange | None = None) -> AugmentedODE:
    at = None if over is None else Index(over.variable)
    m = Name("m", at)
    solve = LinearSolve(
        ("a.x", "a.y"), ((m, Number(1.0)), (Number(1.0), m)), (Number(1.0), Number(3.0)), over
    )
    return ode(
        states=[State("x", Number(0.0), over), State("y", Number(0.0), over)],
        parameters=[Parameter("m", (2.0,) if over is None else (2.0, 3.0), over)],
        bindings=[solve],
        rates=[Rate("x", Name("a.x", at), over), Rate("y", Name("a.y", at), over)],
    )


def test_coupled_rates_are_solved_for():
    np.testing.assert_allclose(load_module(coupled()).rhs(0, [0, 0]), [-1 / 3, 5 / 3], rtol=1e-15)


def test_a_family_of_small_systems_is_solved_at_once():
    module = load_module(coupled(IndexRange("i", 1, 2)))
    expected = [-1 / 3, 0.0, 5 / 3, 1.0]
    np.testing.assert_allclose(module.rhs(0, np.zeros(4)), expected, rtol=1e-15, atol=1e-16)


def test_a_singular_mass_matrix_raises():
    with pytest.raises(np.linalg.LinAlgError):
        load_module(coupled()).rhs(0.0, [0.0, 0.0], [], [1.0])


def test_appended_states_may_start_from_the_others():
    start = call("max", 0, call("neg", Name("psi")))
    made = ode(
        states=[State("z", call("neg", Name("c"))), State("N.e", start)],
        parameters=[Parameter("c", (0.25,))],
        bindings=[Binding("psi", Name("z"))],
        rates=[Rate("z", Number(0.0)), Rate("N.e", Number(0.0))],
        auxiliary=[AuxiliaryState("N.e", Number(0.0), start, "N", "dio(z)")],
    )
    np.testing.assert_array_equal(load_module(made).init(), [-0.25, 0.25])


@pytest.mark.parametrize("scheme", REGISTRY.values(), ids=REGISTRY)
def test_a_step_multiplies_a_mode_by_the_stability_function(scheme):
    if not isinstance(scheme, RungeKutta):
        pytest.skip("not a tableau")
    module = load_module(of_rates(x=call("*", -2, Name("x"))))
    step = getattr(module, f"step_{scheme.name}")
    h = 0.1
    assert step(0.0, h, [3.0])[0] == pytest.approx(3.0 * scheme.stability(-2 * h).real, rel=1e-15)


@pytest.mark.parametrize("scheme", REGISTRY.values(), ids=REGISTRY)
def test_a_step_reads_the_time_at_its_nodes(scheme):
    if not isinstance(scheme, RungeKutta):
        pytest.skip("not a tableau")
    module = load_module(of_rates(x=call("^", Name("t"), scheme.order - 1)))
    step = getattr(module, f"step_{scheme.name}")
    expected = (2.5**scheme.order - 2.0**scheme.order) / scheme.order
    assert step(2.0, 0.5, [0.0])[0] == pytest.approx(expected, rel=1e-14)


def test_a_step_flushes_what_would_turn_subnormal():
    module = load_module(of_rates(x=call("neg", Name("x"))))
    assert module.step_rk4(0.0, 0.1, [1e-291])[0] == 0.0
    assert np.isnan(module.step_rk4(0.0, 0.1, [NAN])[0])


def test_inputs_have_their_defaults_and_nan_where_there_is_none():
    made = ode(
        states=[State("s", Number(0.0))],
        inputs=[Input("f", 2.0), Input("g")],
        rates=[Rate("s", Name("f"))],
    )
    module = load_module(made)
    np.testing.assert_array_equal(module.u0, [2.0, NAN])
    assert module.rhs(0.0, [0.0]) == [2.0]
    assert module.rhs(0.0, [0.0], [3.0, 0.0]) == [3.0]


def test_single_precision_stays_single():
    module = load_module(of_rates(x=call("*", 0.1, Name("x"))), real="float")
    dx = module.rhs(0.0, [1.0])
    assert dx.dtype == np.float32
    assert dx[0] == np.float32(0.1) * np.float32(1.0)
    assert module.step_rk4(0.0, 0.1, [1.0]).dtype == np.float32


def test_vectors_of_a_wrong_length_are_refused():
    with pytest.raises(ValueError, match="need 1, 0 and 0 elements"):
        load_module(of_rates(x=Number(1.0))).rhs(0.0, [1.0, 2.0])


def test_the_arguments_are_left_alone():
    module = load_module(of_rates(x=call("neg", Name("x"))))
    x = np.array([1.0])
    module.rhs(0.0, x)
    module.step_rk4(0.0, 0.1, x)
    assert x == [1.0]
