"""Texts that break other tools and are right here: each target gives them one meaning."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import nsode
from support.modules import load_module
from support.native import Native

#: Names with a meaning of their own in C, its libraries, Python, SymPy or the paper.
NAMES = [
    *("I", "S", "Q", "E", "N", "O", "zeta", "beta", "gamma", "Symbol", "oo", "nan", "inf"),
    *("lambda", "def", "class", "None", "True", "async", "np", "ca", "sp", "math", "self"),
    *("int", "double", "restrict", "inline", "register", "main", "y0", "j1", "errno", "unix"),
    *("linux", "NULL", "INFINITY", "NAN", "M_PI", "EOF", "assert", "signal", "real", "dx", "u"),
    *("p", "x", "h", "k1", "NX", "p0", "rhs", "m", "m_real", "fmax", "pow", "e1", "a1"),
]

#: Expressions of one state `@` with its value, and what its derivative must be.
MEANINGS = [
    ("-1/2*@", 1.0, -0.5),
    ("mod(@, 2)", -7.5, 0.5),
    ("2--@", 1.0, 3.0),
    ("-@^2", 3.0, -9.0),
    ("2^-@", 1.0, 0.5),
    ("2^3^@", 2.0, 512.0),
    ("1/3*3*@", 1.0, 1.0 / 3.0 * 3.0),
    ("(@ + 1e16) - 1e16", 1.0, (1.0 + 1e16) - 1e16),
    ("@*(if @ < (if @ < 2 then @ else -@) then 1 else 3)", 1.0, 3.0),
    ("-7*@/2", 1.0, -3.5),
]


def named() -> str:
    lines = ["model m"]
    lines += [f"parameter {name} = {k + 2}" for k, name in enumerate(NAMES)]
    lines += [f"state {name}_ = 1" for name in NAMES]
    lines += [f"der({name}_) = -{name}*{name}_" for name in NAMES]
    return "\n".join(lines)


def meant() -> str:
    lines = ["model m"]
    for k, (text, value, _) in enumerate(MEANINGS):
        state = f"z{k}"
        lines.append(f"state {state} = {value}")
        lines.append(f"der({state}) = {text.replace('@', state)}")
    return "\n".join(lines)


CASES = {
    "names": (named(), [-(k + 2.0) for k in range(len(NAMES))]),
    "meanings": (meant(), [expected for *_, expected in MEANINGS]),
}


@pytest.mark.parametrize("case", CASES)
def test_c_means_what_the_model_says(case: str, compile_c: Callable[..., Native]) -> None:
    text, expected = CASES[case]
    native = compile_c(text)
    np.testing.assert_array_equal(native.rhs(0.0, native.init()), expected)


@pytest.mark.parametrize("case", CASES)
def test_numpy_means_what_the_model_says(case: str) -> None:
    text, expected = CASES[case]
    module = load_module(nsode.loads(text).ode)
    np.testing.assert_array_equal(module.rhs(0.0, module.init()), expected)


@pytest.mark.parametrize("case", CASES)
def test_casadi_means_what_the_model_says(case: str) -> None:
    pytest.importorskip("casadi")
    from nsode.backends.casadi import functions

    text, expected = CASES[case]
    ode = nsode.loads(text).ode
    module = load_module(ode)
    rates = functions(ode).rhs(0.0, module.init(), [], module.p0)
    np.testing.assert_array_equal(np.array(rates).ravel(), expected)


def test_no_comment_reaches_the_generated_text() -> None:
    model = nsode.loads(
        "model m # injected\nstate s = 1 # */ int injected;\nder(s) = 0 # injected\n"
    )
    for target in ("c", "numpy"):
        for name, text in model.emit(target).items():
            assert "injected" not in text, name


def test_a_name_that_an_auxiliary_state_could_have_is_the_authors() -> None:
    text = """model m
state p = 0
state v = 0
state e1 = 3
state a1 = 4
der(p) = v
der(v) = dio(p) - 0.5*sgn(v)
der(e1) = -e1
der(a1) = -a1
"""
    ode = nsode.loads(text).ode
    assert [state.name for state in ode.states][:4] == ["p", "v", "e1", "a1"]
    assert len(ode.states) == 6
