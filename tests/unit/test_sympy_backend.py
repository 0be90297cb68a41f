"""SymPy objects: the names are the model's, nothing evaluates, derivatives are right."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import nsode
from nsode.evaluate import apply
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import Binding, LinearSolve, Parameter, Rate, State
from support.models import MODELS
from support.odes import Maker, call, ode

sp = pytest.importorskip("sympy")

from nsode.backends.latex.names import symbols as typeset  # noqa: E402
from nsode.backends.sympy import SymbolicSystem, system  # noqa: E402
from nsode.backends.sympy.lower import Environment, lower  # noqa: E402


def symbolic(expr: Expr, *names: str) -> tuple[object, ...]:
    env = Environment({name: sp.Symbol(name, real=True) for name in names})
    return (lower(expr, env), *env.symbols.values())


VALUES = {
    "maximum": lambda a, b: apply("max", a, b),
    "minimum": lambda a, b: apply("min", a, b),
    "absolute": abs,
    "norm": lambda *v: apply("norm", *v),
    "sat": lambda a, b: apply("sat", a, b),
    "shrink": lambda a, b: apply("shrink", a, b),
    "modulo": lambda a, b: apply("mod", a, b),
    "choose": lambda c, a, b: a if c else b,
}


def number(expression: object, **known: float) -> float:
    symbols = sorted(expression.free_symbols, key=str)
    function = sp.lambdify(symbols, expression, [VALUES, "math"])
    return float(function(*(known[str(s)] for s in symbols)))


@pytest.mark.parametrize(
    "name", ["I", "S", "Q", "N", "E", "O", "C", "beta", "lambda", "pi", "zeta", "gamma", "x.y"]
)
def test_a_name_means_what_the_model_means(name):
    made = ode(states=[State(name, Number(1.0))], rates=[Rate(name, call("*", -2, Name(name)))])
    found = system(made)
    [(state, rate)] = found.rates
    assert isinstance(state, sp.Symbol)
    assert state.name == name
    assert rate.subs(state, 1) == -2


@pytest.mark.parametrize(
    ("expr", "shown"),
    [
        (call("max", 0, call("neg", Name("a"))), "maximum(0, -a)"),
        (call("max", 3, 5), "maximum(3, 5)"),
        (call("abs", call("*", Name("a"), Name("a"))), "absolute(a**2)"),
        (call("sat", 2, 5), "sat(2, 5)"),
        (If(call("<", 1, 2), Name("a"), Number(0.0)), "choose(1 < 2, a, 0)"),
        (call("norm", Name("a"), 0), "norm(a, 0)"),
    ],
)
def test_what_has_a_kink_stays_closed(expr, shown):
    assert str(symbolic(expr, "a")[0]) == shown


def test_a_gap_is_never_taken_to_be_positive():
    found = system(nsode.loads(BALL).ode)
    psi = found.symbols["N.psi"]
    assert psi.is_real
    assert psi.is_nonnegative is None


BALL = """model ball
state p = 1
state v = 0
force N = dio(p)
der(p) = v
der(v) = N - 9.8
approximate N: K = 1e5, beta = 0.01, alpha = 0.005
"""


def test_the_rate_of_the_contact_is_equation_24():
    found = system(nsode.loads(BALL).ode)
    e, p, alpha, beta = (found.symbols[name] for name in ("N.e", "p", "N.alpha", "N.beta"))
    rate = found.expand(found.rate("N.e"))
    maximum = rate.func
    assert rate == maximum(-e / beta, (-p - e) / alpha)
    assert found.auxiliary == (e,)


@pytest.mark.parametrize("seed", range(30))
def test_slopes_agree_with_differences(seed):
    functions = [
        call("max", Name("a"), Name("b")),
        call("min", Name("a"), call("*", 2, Name("b"))),
        call("abs", call("*", Name("a"), Name("b"))),
        call("sat", call("abs", Name("a")), Name("b")),
        call("shrink", call("abs", Name("a")), call("norm", Name("a"), Name("b"))),
        call("mod", Name("a"), call("+", 2, call("abs", Name("b")))),
        If(call("<", Name("a"), Name("b")), call("sin", Name("a")), call("exp", Name("b"))),
    ]
    expression, *symbols = symbolic(functions[seed % len(functions)], "a", "b")
    a, b = np.random.default_rng(seed).normal(size=2)
    for symbol, da, db in zip(symbols, (1e-6, 0), (0, 1e-6), strict=True):
        slope = number(sp.diff(expression, symbol), a=a, b=b)
        above, below = (
            number(expression, a=a + da, b=b + db),
            number(expression, a=a - da, b=b - db),
        )
        assert slope == pytest.approx((above - below) / 2e-6, rel=1e-5, abs=1e-8)


def test_nested_kinks_stay_as_they_are():
    expr: Expr = Name("a")
    for k in range(30):
        gate = call("<", Name("a"), float(k))
        expr = call("max", float(k), call("abs", If(gate, expr, Number(2.0))))
    expression, a = symbolic(expr, "a")
    kinds = [type(node).__name__ for node in sp.preorder_traversal(expression)]
    assert [kinds.count(kind) for kind in ("maximum", "absolute", "choose")] == [30, 30, 30]
    assert a in expression.free_symbols


def test_families_are_indexed():
    rows = IndexRange("i", 1, 4)
    here, ahead = Name("x", Index("i")), Name("x", Index("i", 1))
    made = ode(
        states=[State("x", Number(0.0), rows)],
        parameters=[Parameter("k", (2.0,))],
        bindings=[Binding("f", call("+", ahead, call("neg", here)), IndexRange("i", 1, 3))],
        rates=[
            Rate("x", Name("f", Index("i")), IndexRange("i", 1, 3)),
            Rate("x", Sum(IndexRange("j", 1, 4), Name("x", Index("j"))), IndexRange("i", 4, 4)),
        ],
    )
    found = system(made)
    x, f = found.symbols["x"], found.symbols["f"]
    i, j = (sp.Symbol(name, integer=True) for name in "ij")
    assert found.bindings == ((f[i], x[i + 1] - x[i]),)
    assert found.rates[0] == (x[i], f[i])
    state, total = found.rates[1]
    assert state == x[4]
    assert total.doit() == x[1] + x[2] + x[3] + x[4]
    assert total == sp.Sum(x[j], (j, 1, 4))
    assert found.ranges == {"x": (1, 4), "f": (1, 3)}


def test_coupled_rates_are_a_matrix():
    solve = LinearSolve(
        ("a", "b"), ((Name("m"), Number(1.0)), (Number(1.0), Number(2.0))), (Number(3.0), Name("m"))
    )
    made = ode(
        states=[State("s", Number(0.0))],
        parameters=[Parameter("m", (2.0,))],
        bindings=[solve],
        rates=[Rate("s", Name("a"))],
    )
    [found] = system(made).solves
    m = system(made).symbols["m"]
    assert found.matrix == sp.Matrix([[m, 1], [1, 2]])
    assert found.right == sp.Matrix([3, m])
    assert [str(unknown) for unknown in found.unknowns] == ["a", "b"]


@pytest.mark.parametrize("seed", range(15))
def test_random_models_keep_every_definition(seed):
    made = Maker(seed).make()
    found: SymbolicSystem = system(made)
    assert len(found.bindings) == sum(isinstance(b, Binding) for b in made.bindings)
    assert len(found.rates) == len(made.rates)


def test_numbers_keep_their_value():
    for value in (0.1, 1e300, 5e-324, 2.0, -3.0, 1 / 3):
        assert float(symbolic(Number(value))[0]) == value


def shown(expression: object) -> str:
    """Return what a notebook typesets."""
    return expression._repr_latex_().removeprefix(r"$\displaystyle ").removesuffix("$")


SLIDER = """model slider
parameter mu1 = 0.3
state p[2] = [0, 0]
state v[2] = [1, 0]
state x[i in 1..3] = 0
force N_floor = dio(p.y)
force F = mu1*N_floor*sgn(v.x)
der(p) = v
der(v) = [-F, N_floor - 9.8]
for i in 1..3: der(x[i]) = (if i > 1 then x[i-1] else 0) - x[i]
approximate N_floor: K = 1e5, beta = 0.01, alpha = 0.005
approximate F: K = 1e5, beta = 0.01
"""


def test_a_notebook_shows_names_as_the_latex_backend_does():
    model = nsode.loads(SLIDER)
    found, known = model.sympy(), typeset(model.ode)
    assert {n: sp.latex(s) for n, s in found.symbols.items()} == {
        name: str(known[name]) for name in found.symbols
    }
    assert shown(found.symbols["mu1"]) == r"\mu_{1}"
    assert shown(found.symbols["F.beta"] ** 2) == r"\beta_{F}^{2}"
    assert shown(found.symbols["N_floor.e"]) == r"e_{N_{\mathrm{floor}}}"
    assert "e_{N_" in shown(found)
    assert str(found.symbols["F.beta"]) == "F.beta"


def test_a_notebook_shows_elements_of_families_with_their_index():
    x = nsode.loads(SLIDER).sympy().symbols["x"]
    i = sp.Symbol("i", integer=True)
    assert shown(x[i + 1]) == "x_{i + 1}"
    assert shown((x[i] ** 2).subs(i, 3)) == "x_{3}^{2}"


def test_what_differs_at_a_wall_is_an_element_of_its_own():
    found = nsode.loads(SLIDER).sympy()
    x, i = found.symbols["x"], sp.Symbol("i", integer=True)
    rates = dict(zip((state for state, _ in found.rates), found.limits, strict=True))
    assert rates[x[1]] is None
    assert rates[x[i]] == (i, 2, 3)
    assert dict(found.rates)[x[1]] == -x[1]
    assert dict(found.rates)[x[i]] == x[i - 1] - x[i]
    assert r"\left(x_{i}\right)_{i=2}^{3}" in shown(found)


def test_symbols_compute_and_travel():
    found = nsode.loads(SLIDER).sympy()
    a, beta = found.symbols["F.a"], found.symbols["F.beta"]
    assert sp.lambdify([a, beta], a / beta)(3.0, 2.0) == 1.5
    assert pickle.loads(pickle.dumps(a / beta)) == a / beta
    assert copy.deepcopy(a) == a


def test_w_of_the_sphere_is_that_of_a_solid_sphere():
    """A force at the rim of a solid sphere sees 2/7 of its mass, one through the center all."""
    found = nsode.load(MODELS / "rolling_sphere.di").sympy()
    M = found.symbols["M"]
    assert found.multipliers == ("N", "F.x", "F.y")
    assert sp.diag(1 / M, 7 / (2 * M), 7 / (2 * M)) == found.W


def test_w_of_two_blocks_couples_the_frictions_that_touch_one_block():
    """The paper's Example II, M1 = 0.5 and M2 = 1, at the left wall and between the blocks."""
    found = nsode.load(MODELS / "two_blocks_conveyor.di").sympy()
    rows = [found.multipliers.index(name) for name in ("F1", "F2")]
    M1, M2 = found.symbols["M1"], found.symbols["M2"]
    expected = sp.Matrix([[1 / M1, 1 / M1], [1 / M1, 1 / M1 + 1 / M2]])
    block = found.W.extract(rows, rows)
    assert (block - expected).applyfunc(sp.simplify).is_zero_matrix
    np.testing.assert_array_equal(block.subs(found.defaults), [[2.0, 2.0], [2.0, 3.0]])


def test_w_behind_a_mass_matrix_is_its_inverse():
    found = nsode.load(MODELS / "cart_pole.di").sympy()
    mc, mp, length, phi = (found.symbols[name] for name in ("mc", "mp", "l", "phi"))
    coupling = mp * length * sp.cos(phi)
    mass = sp.Matrix([[mc + mp, coupling], [coupling, mp * length**2]])
    assert (found.W * mass).applyfunc(sp.simplify) == sp.eye(2)


def test_w_holds_the_numbers_that_were_baked_in():
    found = nsode.load(MODELS / "rolling_sphere.di").baked({"M": 2.0}).sympy()
    assert sp.diag(sp.Rational(1, 2), sp.Rational(7, 4), sp.Rational(7, 4)) == found.W


def test_families_have_no_w():
    assert nsode.load(MODELS / "granular_column.di").sympy().W is None


def test_a_call_that_nobody_knows_is_loud():
    with pytest.raises(KeyError):
        symbolic(Call("frobnicate", ()))
