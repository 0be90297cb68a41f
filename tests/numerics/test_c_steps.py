"""Fused steps: the textbook's arithmetic, the method's order, and a safe end."""

import math
from fractions import Fraction

import numpy as np
import pytest

from nsode.expr import Call, Name
from nsode.integrators import REGISTRY
from nsode.integrators.scheme import RungeKutta
from nsode.ode import Input, Rate, State
from support.hand_built import call, minus, num, ode, parameters, plus
from support.native import StatusError

METHODS = list(REGISTRY)
T, X, V = Name("t"), Name("x"), Name("v")


def pendulum(name="pendulum"):
    """A driven pendulum: nonlinear, and dependent on time."""
    drive = call("*", 0.5, call("cos", call("*", 2, T)))
    return ode(
        name,
        states=[State("x", num(1)), State("v", num(0))],
        inputs=[Input("u", 0.25)],
        rates=[Rate("x", V), Rate("v", plus(call("neg", call("sin", X)), drive, Name("u")))],
    )


def by_hand(method, f, t, h, x):
    """One step as textbooks write it."""
    if method == "euler":
        return x + h * f(t, x)
    k1 = f(t, x)
    if method == "heun":
        return x + h / 2 * (k1 + f(t + h, x + h * k1))
    k2 = f(t + h / 2, x + h / 2 * k1)
    k3 = f(t + h / 2, x + h / 2 * k2)
    k4 = f(t + h, x + h * k3)
    return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


@pytest.mark.parametrize("method", METHODS)
def test_a_step_is_the_textbook_s_bit_for_bit(method, compile_c):
    native = compile_c(pendulum())
    x = native.init()
    for k in range(20):
        t, h = 0.1 * k, 0.07
        expected = by_hand(method, native.rhs, t, h, x)
        x = native.step(t, h, x, method=method)
        np.testing.assert_array_equal(x, expected)


@pytest.mark.parametrize("method", METHODS)
def test_the_error_of_a_smooth_run_falls_with_the_order(method, compile_c):
    native = compile_c(pendulum())
    fine = native.run(16_000, 1 / 16_000, method="rk4")[-1]
    errors = [
        np.abs(native.run(n, 1 / n, method=method)[-1] - fine).max() for n in (16, 32, 64, 128)
    ]
    observed = np.polyfit(np.log2([16, 32, 64, 128]), np.log2(errors), 1)[0]
    assert observed == pytest.approx(-REGISTRY[method].order, abs=0.15)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("z", [-0.1, -1.0, -2.5, 0.3 + 0.4j, 1.7j, -2 + 1j])
def test_the_stability_function_is_what_a_step_does_to_a_mode(method, z, compile_c):
    rotation = ode(
        "mode",
        states=[State("x", num(1)), State("v", num(0))],
        parameters=parameters(a=0, b=0),
        rates=[
            Rate("x", minus(call("*", Name("a"), X), call("*", Name("b"), V))),
            Rate("v", plus(call("*", Name("b"), X), call("*", Name("a"), V))),
        ],
    )
    z = complex(z)
    x, v = compile_c(rotation).step(0.0, 1.0, [1.0, 0.0], p=[z.real, z.imag], method=method)
    assert complex(x, v) == pytest.approx(REGISTRY[method].stability(z), rel=1e-14)


def test_the_polynomial_of_a_method_of_full_order_is_that_of_exp():
    polynomial = REGISTRY["rk4"].stability_polynomial
    assert polynomial == tuple(Fraction(1, math.factorial(k)) for k in range(5))


def test_a_tableau_that_is_not_explicit_is_refused():
    half = Fraction(1, 2)
    with pytest.raises(ValueError, match="not explicit"):
        RungeKutta("mid", "implicit midpoint", 2, ((half,),), (Fraction(1),), (half,))
    with pytest.raises(ValueError, match="does not sum"):
        RungeKutta("bad", "bad", 1, ((), (half,)), (half, half), (Fraction(0), Fraction(1)))


@pytest.mark.parametrize("method", METHODS)
def test_a_step_that_is_not_finite_leaves_the_state_alone(method, compile_c):
    growth = ode(
        "growth",
        states=[State("x", num(1)), State("y", num(2))],
        rates=[Rate("x", call("*", X, 1e308)), Rate("y", num(1))],
    )
    native = compile_c(growth)
    x = np.array([1e308, 2.0])
    arguments = (0.0, 1.0, x, np.zeros(1), np.zeros(1))
    with pytest.raises(StatusError) as told:
        native._call(f"step_{method}", *arguments)
    assert told.value.status == 1
    assert list(x) == [1e308, 2.0]


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_state_that_is_not_finite_is_told(bad, compile_c):
    with pytest.raises(StatusError) as told:
        compile_c(pendulum()).step(0.0, 0.1, [bad, 0.0])
    assert told.value.status == 1


@pytest.mark.parametrize(("real", "tiny"), [("double", 1e-291), ("float", 9e-38)])
def test_what_has_all_but_decayed_becomes_zero(real, tiny, compile_c):
    still = ode("still", states=[State("x", num(0))], rates=[Rate("x", num(0))])
    native = compile_c(still, real=real)
    assert native.step(0.0, 0.1, [tiny]) == 0
    assert native.step(0.0, 0.1, [-tiny]) == 0
    assert native.step(0.0, 0.1, [20 * tiny]) != 0


@pytest.mark.parametrize(("real", "digits"), [("double", 1e-12), ("float", 2e-5)])
def test_float_steps_follow_double_steps(real, digits, compile_c):
    reference = compile_c(pendulum()).run(100, 0.01)[-1]
    found = compile_c(pendulum(), real=real).run(100, 0.01)[-1]
    np.testing.assert_allclose(found, reference, rtol=digits)


def test_inputs_are_held_over_a_step(compile_c):
    integrator = ode(
        "integrator",
        states=[State("x", num(0))],
        inputs=[Input("u")],
        rates=[Rate("x", Call("*", (num(2), Name("u"))))],
    )
    assert compile_c(integrator).step(0.0, 0.5, [1.0], u=[3.0]) == 4.0
