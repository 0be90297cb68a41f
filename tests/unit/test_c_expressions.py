"""Expressions in C mean what the tree means, operation by operation."""

import math
import random

import numpy as np
import pytest

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
        (call("^", X, 0), "pow(x, (real)0)"),
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
    return a if a > b else b if b >= a else a + b


def _min(a, b):
    return a if a < b else b if b <= a else a + b


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
    "min": _min,
    "sat": _sat,
    "shrink": lambda z, n: 1.0 if n < z else z / n if n > 0 else z + n,
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
        case Call("max", (Number(0.0), other)):
            y = meaning(other, values)
            return 0.0 if y <= 0 else y
        case Call(function, args):
            return MEANING[function](*(meaning(arg, values) for arg in args))
    raise AssertionError(expr)


NUMBERS = [0.0, 1.0, 2.0, 3.0, -1.0, 0.1, 9.8, -2.5, 1e6, 1e7, 1e-300]
VALUES = [0.0, -0.0, 1.0, -1.5, 0.3, 7e-5, -12345.678, 1e-310, math.nan, math.inf]


def random_test(rng, depth):
    kind = rng.choice(["compare", "compare", "not", "and"]) if depth else "compare"
    match kind:
        case "compare":
            sides = random_tree(rng, depth - 1), random_tree(rng, depth - 1)
            return call(rng.choice(["<", "<=", "==", "!="]), *sides)
        case "not":
            return call("not", random_test(rng, depth - 1))
        case _:
            sides = random_test(rng, depth - 1), random_test(rng, depth - 1)
            return call(rng.choice(["and", "or"]), *sides)


def random_tree(rng, depth):
    if depth <= 0 or rng.random() < 0.2:
        return rng.choice([X, Y, Z]) if rng.random() < 0.7 else num(rng.choice(NUMBERS))

    def some():
        return random_tree(rng, depth - 1)

    match rng.choice(["binary", "binary", "sum", "sum", "unary", "sat", "power", "norm", "if"]):
        case "binary":
            return call(rng.choice(["*", "/", "max", "min"]), some(), some())
        case "sum":
            return plus(*(some() for _ in range(rng.randint(2, 4))))
        case "unary":
            return call(rng.choice(["neg", "abs"]), some())
        case "sat":
            return call(rng.choice(["sat", "shrink"]), call("abs", some()), some())
        case "power":
            return call("^", some(), rng.choice([1, 2, 3, -1, -2]))
        case "norm":
            return call("norm", some(), some())
        case _:
            return If(random_test(rng, depth - 1), some(), some())


@pytest.mark.parametrize("seed", range(4))
def test_compiled_expressions_are_the_trees_bit_for_bit(seed, compile_c):
    rng = random.Random(seed)
    many = [random_tree(rng, 5) for _ in range(120)]
    scene = evaluating(
        {f"y{k}": tree for k, tree in enumerate(many)},
        parameters=[Parameter(k, (0.0,)) for k in "xyz"],
    )
    native = compile_c(scene)
    for _ in range(30):
        point = [rng.choice([*VALUES, rng.gauss(0, 1), rng.gauss(0, 1e5)]) for _ in "xyz"]
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
    np.testing.assert_array_equal(compile_c(scene).out(0.0, []), [0.0, 0.0])


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
