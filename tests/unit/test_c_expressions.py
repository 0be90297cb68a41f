"""Expressions in C mean what the tree means, operation by operation."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from nsode.backends.c.expressions import condition, lower
from nsode.expr import Call, Expr, If, Index, Name, Number
from nsode.ode import Parameter
from support.hand_built import call, evaluating, minus, num, plus

X, Y, Z = Name("x"), Name("y"), Name("z")


class Bare:
    """A scope in which every name is its own C text."""

    single = False

    def __init__(self):
        self.used = set()

    def name(self, name):
        return name.id

    def index(self, index):
        return index.variable if not index.offset else f"{index.variable} + {index.offset}"

    def use(self, function):
        self.used.add(function)


def text(expr):
    return lower(expr, Bare())


@pytest.mark.parametrize(
    ("expr", "expected"),
    [
        (minus(2, call("neg", X)), "2 - (-x)"),
        (call("neg", call("neg", X)), "-(-x)"),
        (plus(X, num(-2)), "x - 2"),
        (plus(X, call("*", call("neg", X), Y)), "x + (-x*y)"),
        (call("*", X, num(-2)), "x*(-2)"),
        (call("*", call("/", 1, 2), X), "(real)1/2*x"),
        (call("neg", call("*", call("/", 1, 2), X)), "-(real)1/2*x"),
        (plus(1, 2, X), "(real)1 + 2 + x"),
        (call("*", X, call("*", Y, Z)), "x*(y*z)"),
        (call("*", call("*", X, Y), Z), "x*y*z"),
        (call("/", X, call("/", Y, Z)), "x/(y/z)"),
        (call("/", call("/", X, Y), Z), "x/y/z"),
        (plus(X, plus(Y, Z)), "x + (y + z)"),
        (minus(X, plus(Y, Z)), "x - (y + z)"),
        (call("*", plus(X, Y), Z), "(x + y)*z"),
        (call("neg", plus(X, Y)), "-(x + y)"),
        (call("^", X, 2), "x*x"),
        (call("/", 1, call("^", X, 2)), "1/(x*x)"),
        (call("^", X, -1), "1/x"),
        (call("^", plus(X, Y), 2), "square(x + y)"),
        (call("^", X, 5), "power(x, 5)"),
        (call("^", X, 0), "1"),
        (call("^", X, 9), "pow(x, (real)9)"),
        (call("^", X, 0.5), "sqrt(x)"),
        (call("max", 0, X), "max0(x)"),
        (call("max", X, Y), "larger(x, y)"),
        (call("abs", X), "fabs(x)"),
        (call("norm", X, Y), "norm2(x, y)"),
        (If(call("<", X, 0), num(1), num(0)), "x < 0 ? (real)1 : 0"),
        (plus(If(call("<", X, 0), X, Y), Z), "(x < 0 ? x : y) + z"),
        (call("*", 0.1, Index("i", 1)), "(real)0.1*(real)(i + 1)"),
        (call("/", Index("i"), 2), "(real)i/2"),
        (num(1e7), "(real)10000000.0"),
        (num(-0.0), "(real)-0.0"),
        (num(math.nan), "(real)NAN"),
        (num(-math.inf), "(real)-INFINITY"),
    ],
    ids=str,
)
def test_text_is_short_and_safe(expr, expected):
    assert text(expr) == expected


def test_a_minus_never_meets_another_minus():
    trees = [minus(X, num(-3.5)), call("*", X, call("neg", Y)), minus(call("neg", X), num(-1))]
    assert not any("--" in text(tree) for tree in trees)


@pytest.mark.parametrize(
    ("test", "expected"),
    [
        (call("and", call("<", X, Y), call("or", call("==", X, Z), call("not", call(">", X, 0)))),
         "(x < y && (x == z || !(x > 0)))"),
        (call("not", call("<", X, Y)), "!(x < y)"),
        (call("<", plus(X, Y), If(call(">", X, 0), X, Y)), "(x + y < (x > 0 ? x : y))"),
    ],
)  # fmt: skip
def test_conditions_can_stand_under_a_not(test, expected):
    assert condition(test, Bare()) == expected


def test_what_c_does_not_know_is_refused():
    with pytest.raises(NotImplementedError, match="dio"):
        text(call("dio", X))
    with pytest.raises(NotImplementedError, match="Expr"):
        text(Expr())


# Trees evaluated by Python, whose floats are IEEE doubles, give the oracle: each operation
# rounds once, in the order of the tree.


def _max(a, b):
    return math.nan if math.isnan(a) or math.isnan(b) else max(a, b)


def _sat(level, x):
    if math.isnan(level) or math.isnan(x):
        return math.nan
    return x if abs(x) <= level else math.copysign(level, x)


def _power(a, n):
    product = 1.0
    for _ in range(int(abs(n))):
        product *= a
    return product if n > 0 else _divide(1.0, product)


def _divide(a, b):
    return float(np.float64(a) / np.float64(b))


def _add(*terms):
    total = terms[0]
    for term in terms[1:]:
        total += term
    return total


MEANING = {
    "+": _add,
    "neg": lambda a: -a,
    "*": lambda a, b: a * b,
    "/": _divide,
    "^": _power,
    "abs": abs,
    "max": _max,
    "min": lambda a, b: -_max(-a, -b),
    "sat": _sat,
    "shrink": lambda z, n: 1.0 if n <= z else _divide(z, n),
    "norm": lambda a, b: math.sqrt(a * a + b * b),
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
    "and": lambda a, b: a and b,
    "or": lambda a, b: a or b,
    "not": lambda a: not a,
}


def meaning(expr, values):
    match expr:
        case Number(value):
            return value
        case Name(id):
            return values[id]
        case If(test, then, otherwise):
            return meaning(then if meaning(test, values) else otherwise, values)
        case Call(function, args):
            return MEANING[function](*(meaning(arg, values) for arg in args))
    raise AssertionError(expr)


numbers = st.sampled_from([0.0, 1.0, 2.0, 3.0, -1.0, 0.1, 9.8, -2.5, 1e6, 1e7, 1e-300])
leaves = st.one_of(st.sampled_from([X, Y, Z]), numbers.map(Number))


def _tests(e):
    compare = st.builds(call, st.sampled_from(["<", "<=", "==", "!="]), e, e)
    return st.one_of(
        compare,
        compare.map(lambda c: call("not", c)),
        st.builds(call, st.sampled_from(["and", "or"]), compare, compare),
    )


trees = st.recursive(
    leaves,
    lambda e: st.one_of(
        st.builds(call, st.sampled_from(["*", "/", "max", "min"]), e, e),
        st.lists(e, min_size=2, max_size=4).map(lambda terms: plus(*terms)),
        e.map(lambda a: call("neg", a)),
        e.map(lambda a: call("abs", a)),
        st.builds(call, st.sampled_from(["sat", "shrink"]), e.map(lambda a: call("abs", a)), e),
        st.builds(lambda a, n: call("^", a, n), e, st.sampled_from([1, 2, 3, -1, -2])),
        st.builds(call, st.just("norm"), e, e),
        st.builds(If, _tests(e), e, e),
    ),
    max_leaves=12,
)
values = st.sampled_from([0.0, -0.0, 1.0, -1.5, 0.3, 7e-5, -12345.678, 1e-310, math.nan, math.inf])


@settings(
    max_examples=6,
    deadline=None,
    phases=[Phase.explicit, Phase.reuse, Phase.generate],  # each attempt is a compilation
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.large_base_example],
)
@given(
    many=st.lists(trees, min_size=60, max_size=80),
    points=st.lists(st.tuples(values, values, values), min_size=20, max_size=20),
)
def test_compiled_expressions_are_the_trees_bit_for_bit(many, points, compile_c):
    outputs = {f"y{k}": tree for k, tree in enumerate(many)}
    scene = evaluating(outputs, parameters=[Parameter(k, (0.0,)) for k in "xyz"])
    native = compile_c(scene)
    for point in points:
        found = native.out(0.0, [], p=point)
        with np.errstate(all="ignore"):
            wanted = [meaning(tree, dict(zip("xyz", point, strict=True))) for tree in many]
        np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize("real", ["double", "float"])
def test_nothing_swallows_a_nan(real, compile_c):
    bad, good = Name("x"), Name("y")
    through = [
        call("max", 0, bad), call("max", bad, good), call("max", good, bad),
        call("min", bad, good), call("min", good, bad), call("sat", good, bad),
        call("sat", bad, good), call("shrink", good, bad), call("shrink", bad, good),
        call("norm", good, bad), call("abs", bad), call("mod", bad, good),
    ]  # fmt: skip
    scene = evaluating(
        {f"y{k}": tree for k, tree in enumerate(through)},
        parameters=[Parameter("x", (math.nan,)), Parameter("y", (1.0,))],
    )
    assert np.isnan(compile_c(scene, real=real).out(0.0, [])).all()


def test_nothing_at_rest_is_zero_over_zero(compile_c):
    zero = Name("x")
    scene = evaluating(
        {"sat": call("sat", zero, zero), "shrink": call("shrink", zero, call("norm", zero, zero))},
        parameters=[Parameter("x", (0.0,))],
    )
    np.testing.assert_array_equal(compile_c(scene).out(0.0, []), [0.0, 1.0])


def test_mod_is_floored(compile_c):
    pairs = [(7.5, 2.0), (-7.5, 2.0), (7.5, -2.0), (-7.5, -2.0), (6.0, 2.0), (-6.0, 2.0), (1e17, 3)]
    scene = evaluating({f"m{k}": call("mod", a, b) for k, (a, b) in enumerate(pairs)})
    found = compile_c(scene).out(0.0, [])
    np.testing.assert_array_equal(found, [a % b for a, b in pairs])


def test_powers_beyond_a_few_are_those_of_the_library(compile_c):
    exponents = [4, 5, 6, 7, 8, -4, -7, 9, 12, 1.5, 0.5]
    scene = evaluating(
        {f"y{k}": call("^", Name("x"), n) for k, n in enumerate(exponents)},
        parameters=[Parameter("x", (1.7,))],
    )
    np.testing.assert_allclose(
        compile_c(scene).out(0.0, []), [1.7**n for n in exponents], rtol=8 * 2.0**-53, atol=0
    )
