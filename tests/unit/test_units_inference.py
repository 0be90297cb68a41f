"""The units of expressions, against pint's arithmetic on quantities."""

from __future__ import annotations

import math
import operator
from fractions import Fraction

import pint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nsode.dimension import ONE
from nsode.expr import FUNCTIONS, Call, Expr, If, Index, IndexRange, Name, Number, Sum, add
from nsode.inclusion.units.inference import Inference
from nsode.inclusion.units.quantity import CLOCK, UNKNOWN, Quantity
from nsode.inclusion.units.reading import measure
from nsode.source import Span
from nsode.syntax.ast import Unit

REGISTRY = pint.UnitRegistry()
UNITS = {
    "x": "m",
    "v": "m/s",
    "m": "kg",
    "f": "N",
    "k": "N/m",
    "c": "N*s/m",
    "tau": "s",
    "mu": "1",
    "w": "rad/s",
    "E": "J",
}
KNOWN = {name: Quantity(measure(Unit(unit)).dimension, text=unit) for name, unit in UNITS.items()}


def call(function: str, *args: Expr) -> Expr:
    return Call(function, args)


def infer(expr: Expr) -> tuple[Quantity, list[str]]:
    """Return what is known of an expression, and the messages on the way."""
    found = Inference({**KNOWN, "t": CLOCK}, {})
    quantity = found.of(expr)
    return quantity, [problem.message for problem in found.found.values()]


def unit(text: str) -> object:
    return measure(Unit(text)).dimension


# pint as the oracle


def worth(expr: Expr) -> pint.Quantity:
    """Return the value of an expression in pint's arithmetic, every name being 1."""
    match expr:
        case Name(id):
            return REGISTRY.Quantity(1.0, UNITS[id])
        case Number(value):
            return REGISTRY.Quantity(value)
        case If(_, then, otherwise):
            return worth(then) + worth(otherwise)
        case Sum(_, body):
            return worth(body)
    assert isinstance(expr, Call)
    args = [worth(arg) for arg in expr.args]
    match expr.function:
        case "sqrt":
            return args[0] ** 0.5
        case "^":
            return args[0] ** args[1].magnitude
        case "sin" | "exp" | "tanh":
            return REGISTRY.Quantity(1.0 + abs(math.tanh(args[0].m_as(""))))
        case "atan2":
            return REGISTRY.Quantity(abs(math.atan((args[0] / args[1]).m_as(""))))
        case "norm" | "+" | "max":
            return sum(args[1:], start=args[0])
        case "mod":
            return args[0] + args[1]
    return {"*": operator.mul, "/": operator.truediv, "abs": lambda a: a}[expr.function](*args)


def larger(inner: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    binary = st.sampled_from(["*", "/", "+", "max", "norm", "mod", "atan2"])
    unary = st.sampled_from(["abs", "sqrt", "sin", "exp", "tanh"])
    exponent = st.sampled_from([2.0, 3.0, 0.5, -1.0]).map(Number)
    condition = call("<", Name("x"), Name("x"))
    return st.one_of(
        st.builds(call, binary, inner, inner),
        st.builds(call, unary, inner),
        st.builds(call, st.just("^"), inner, exponent),
        st.builds(lambda a: call("*", Number(2.0), a), inner),
        st.builds(lambda a, b: If(condition, a, b), inner, inner),
        st.builds(lambda a: Sum(IndexRange("i", 1, 3), a), inner),
    )


EXPRESSIONS = st.recursive(st.sampled_from([*UNITS]).map(Name), larger, max_leaves=8)


@given(EXPRESSIONS)
@settings(max_examples=600, deadline=None)
def test_units_combine_as_in_pint(expr: Expr) -> None:
    quantity, problems = infer(expr)
    try:
        expected = worth(expr)
    except pint.DimensionalityError:
        assert problems
        return
    assert problems == []
    assert quantity.rigid is not None
    shown = REGISTRY.Quantity(1.0, str(quantity.rigid).replace("^", "**"))
    assert dict(shown.dimensionality) == pytest.approx(dict(expected.dimensionality))


# what is gradual


@pytest.mark.parametrize("function", sorted(FUNCTIONS))
def test_every_function_has_a_rule_and_the_unknown_is_never_wrong(function: str) -> None:
    unknown = [Name(name) for name in ("a", "b")][: FUNCTIONS[function].arity or 2]
    mixed = [Name("mu"), *unknown[1:]] if len(unknown) > 1 else unknown
    for args in (unknown, mixed, mixed[::-1]):
        assert infer(call(function, *args))[1] == []


@pytest.mark.parametrize(
    "expr",
    [
        add(Name("x"), Number(1.0)),
        add(Number(1.0), Name("t"), Name("x"), Index("i")),
        add(Name("x"), call("*", Number(0.02), Index("i"))),
        add(Name("x"), call("*", Number(3.0), call("sin", call("*", Number(100.0), Name("t"))))),
        call("max", Number(0.0), Name("x")),
        If(call("<", Name("t"), Number(2.0)), Number(3.0), Name("x")),
        call("*", Name("v"), Name("t")),
        call("*", Number(2.0), Name("x")),
        add(Name("x"), Name("nobody")),
    ],
)
def test_numbers_indices_and_the_time_fit_anywhere(expr: Expr) -> None:
    quantity, problems = infer(expr)
    assert problems == []
    assert quantity.rigid is unit("m")


def test_a_number_beside_a_product_sign_is_dimensionless() -> None:
    bare = call("*", Number(2.0), Name("v"))
    _, problems = infer(add(Name("x"), bare))
    assert problems == ["`m` and `m/s` cannot be added"]


def test_the_time_is_in_seconds_beside_a_unit() -> None:
    assert infer(call("*", Name("f"), Name("t")))[0].rigid is unit("N*s")
    assert infer(call("cos", call("*", Name("w"), Name("t")))) == (Quantity(ONE), [])
    _, problems = infer(call("cos", call("*", Name("f"), Name("t"))))
    assert problems == ["the argument of `cos` must be dimensionless, not in `N*s`"]


def test_what_is_multiplied_by_an_unknown_is_unknown() -> None:
    assert infer(call("*", Name("nobody"), Name("x")))[0] == UNKNOWN
    assert infer(add(Name("f"), call("/", Name("x"), Name("nobody"))))[1] == []


def test_an_exponent_may_be_a_fraction_and_must_not_have_a_unit() -> None:
    third = call("/", Number(1.0), Number(3.0))
    quantity, problems = infer(call("^", call("^", Name("x"), Number(6.0)), third))
    assert (quantity.rigid, problems) == (unit("m^2"), [])
    assert infer(call("^", Name("x"), call("neg", Number(2.0))))[0].rigid is unit("1/m^2")
    assert infer(call("^", Name("x"), Name("mu"))) == (UNKNOWN, [])
    _, problems = infer(call("^", Name("mu"), Name("x")))
    assert problems == ["an exponent must be dimensionless, not in `m`"]


@pytest.mark.parametrize(
    ("expr", "message"),
    [
        (call("<", Name("x"), Name("v")), "`m` and `m/s` cannot be compared"),
        (call("min", Name("mu"), Name("v")), "a dimensionless value and `m/s` cannot be compared"),
        (call("norm", Name("x"), Name("w")), "`m` and `rad/s` cannot be components of one vector"),
        (
            If(call("<", Name("x"), Number(0.0)), Name("f"), Name("k")),
            "`N` and `N/m` cannot be branches of one `if`",
        ),
        (call("mod", Name("x"), Name("f")), "`m` and `N` cannot be divided with a remainder"),
        (call("atan2", Name("x"), Name("v")), "`m` and `m/s` cannot be the two sides of an angle"),
        (call("exp", Name("E")), "the argument of `exp` must be dimensionless, not in `J`"),
    ],
)
def test_a_misfit_names_both_units_as_they_were_declared(expr: Expr, message: str) -> None:
    assert infer(expr)[1] == [message]


def test_one_misfit_does_not_draw_others_after_it() -> None:
    inner = add(Name("x", span=Span(0, 1)), Name("v", span=Span(4, 5)))
    outer = add(call("*", inner, Name("f")), Name("E", span=Span(8, 9)), Name("tau"))
    assert len(infer(inner)[1]) == 1
    assert infer(outer)[1] == ["`m` and `m/s` cannot be added", "`J` and `s` cannot be added"]


def test_a_long_list_over_a_family_is_no_deep_recursion() -> None:
    chain: Expr = Name("x")
    for k in range(20_000):
        chain = If(call("==", Index("i"), Number(float(k))), Name("x"), chain)
    assert infer(chain)[0].rigid is unit("m")


def test_powers_of_powers_end_in_a_message_and_no_crash() -> None:
    tower: Expr = Name("x")
    for _ in range(60):
        tower = call("^", tower, Number(64.0))
    _, problems = infer(add(Name("x"), tower))
    assert problems == ["`m` and `a huge power` cannot be added"]
    assert infer(tower)[0].rigid is not None
    assert Fraction(64) ** 60 in infer(tower)[0].rigid.exponents
