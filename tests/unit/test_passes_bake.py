"""Parameters that become numbers leave every result as it was, to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.ode import element_names
from nsode.passes.count import operations
from support.models import MODELS, PATHS
from support.modules import load_module


def scalars(model: nsode.Model) -> dict[str, float]:
    return {p.name: p.values[0] for p in model.ode.parameters if p.range is None}


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_a_baked_model_has_the_same_rates_bit_for_bit(path):
    model = nsode.load(path)
    baked = model.baked(scalars(model))
    whole, rest = load_module(model.ode), load_module(baked.ode)
    rng = np.random.default_rng(7)
    u = np.zeros(len(element_names(model.ode.inputs)))
    for _ in range(20):
        x = model.x0 + rng.standard_normal(len(model.x0)) * 10.0 ** rng.uniform(-6, 0)
        t = rng.uniform(0, 3)
        expected = whole.rhs(t, x, u, model.p0)
        np.testing.assert_array_equal(rest.rhs(t, x, u, baked.p0), expected)


def test_baking_drops_the_parameter_and_saves_operations():
    model = nsode.load(MODELS / "rolling_sphere.di")
    baked = model.baked({"M": 2.0, "R": 0.25, "g": 9.81})
    assert [p.name for p in baked.ode.parameters] == [
        "mu", "N.K", "N.alpha", "N.beta", "F.K", "F.beta",
    ]  # fmt: skip
    assert operations(baked.ode) < operations(model.ode)


def test_what_was_proved_stays_checked():
    model = nsode.load(MODELS / "rolling_sphere.di")
    with pytest.raises(ModelError, match="NS307"):
        model.baked({"mu": -0.1})


def test_a_condition_on_baked_parameters_is_decided():
    model = nsode.loads(
        "model m\nparameter a = 1\nparameter b = 2\nstate x = 1\n"
        "der(x) = if a < b and not a > 3 then -x else exp(x)\n"
    )
    assert operations(model.ode) > operations(model.baked({"a": 1.0, "b": 2.0}).ode) == 0


def test_a_formula_follows_what_is_baked_into_it():
    model = nsode.loads(
        "model m\nparameter M = 4\nstate v = 1\nforce F = 2*sgn(v)\nM*der(v) = -F\n"
        "approximate F: K = 1e4, beta = 2/sqrt(F.K/M)\n"
    )
    baked = model.baked({"M": 16.0, "F.K": 1e4})
    [beta] = baked.ode.parameters
    assert (beta.name, beta.formula) == ("F.beta", None)
    assert beta.values[0] == pytest.approx(2 / np.sqrt(1e4 / 16), rel=1e-15)


def test_only_scalar_parameters_can_be_baked():
    model = nsode.load(MODELS / "burridge_knopoff.di")
    with pytest.raises(ModelError, match="no scalar parameter"):
        model.baked({"F0": 2.0})


def test_operations_of_a_family_count_for_each_element():
    def row(n: int) -> int:
        text = (
            f"model m\nconstant n = {n}\nstate x[i in 1..n] = 1\nfor i in 1..n: der(x[i]) = -2*x[i]"
        )
        return operations(nsode.loads(text).ode)

    assert [row(n) for n in (0, 1, 10)] == [0, 1, 10]
