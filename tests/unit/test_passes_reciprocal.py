"""Quotients by what does not change become products, where that is safe."""

import pytest

from nsode.expr import If, Index, IndexRange, Name
from nsode.ode import Parameter, Rate, State
from nsode.passes.reciprocal import multiply_by_reciprocals
from support.hand_built import call, num, ode, parameters, plus

X, M, K = Name("x"), Name("M"), Name("K")


def changed(value):
    scene = ode(
        states=[State("x", num(0))],
        parameters=[*parameters(M=1, K=2), Parameter("side", (1.0, 2.0), IndexRange("i", 1, 2))],
        rates=[Rate("x", value)],
    )
    return multiply_by_reciprocals(scene).rates[0].value


def inverse(divisor):
    return call("/", 1, divisor)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (call("/", X, M), call("*", X, inverse(M))),
        (call("/", X, call("*", M, K)), call("*", X, inverse(call("*", M, K)))),
        (call("/", call("/", X, M), K), call("*", call("*", X, inverse(M)), inverse(K))),
        (call("/", X, 3), call("*", X, inverse(num(3)))),
        (call("max", 0, call("/", X, M)), call("max", 0, call("*", X, inverse(M)))),
    ],
    ids=str,
)  # fmt: skip
def test_a_quotient_by_parameters_is_a_product(before, after):
    assert changed(before) == after


@pytest.mark.parametrize(
    "value",
    [
        call("/", M, K),
        call("/", M, X),
        call("/", X, plus(X, M)),
        call("/", X, 2),
        call("/", X, 0.125),
        call("/", X, 0),
        call("/", X, Name("side", Index(None, 1))),
        If(call(">", K, 0), call("/", X, K), X),
    ],
    ids=str,
)
def test_a_quotient_that_gains_nothing_or_hides_in_a_branch_stays(value):
    assert changed(value) == value
