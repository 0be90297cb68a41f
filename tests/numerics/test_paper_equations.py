"""The generated code against the paper's equations, coded by hand."""

from __future__ import annotations

import numpy as np
import pytest

import nsode
from nsode.ode import element_names
from support.models import MODELS
from support.modules import load_module
from support.paper import EQUATIONS, term

POINTS = 500
STATES = 10.0 ** np.arange(-6, 3)


def random_points(names: list[str], rng: np.random.Generator) -> np.ndarray:
    """Return states of many magnitudes, zeros and both signs among them."""
    shape = (POINTS, len(names))
    points = rng.choice([-1.0, 1.0], shape) * rng.uniform(0.1, 1, shape) * rng.choice(STATES, shape)
    points[rng.random(shape) < 0.1] = 0.0
    small = [k for k, name in enumerate(names) if name.endswith((".e", ".a", ".a.x", ".a.y"))]
    points[:, small] *= 1e-4  # the deformations of stiff contacts
    return points


def random_parameters(p0: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return parameters within a factor of 3 of the model's, signs kept."""
    return p0 * np.exp(rng.uniform(-1, 1, (POINTS, len(p0))))


def times(rng: np.random.Generator) -> np.ndarray:
    return rng.uniform(0, 4, POINTS)


def compare(name, rates, names, parameter_names, xs, ps, ts, dtype):
    """Assert 4 eps of the running term scale at every point; return the worst ratio."""
    worst = 0.0
    eps = np.finfo(dtype).eps
    for x, p, t in zip(xs, ps, ts, strict=True):
        x, p, t = x.astype(dtype), p.astype(dtype), float(np.asarray(t, dtype))
        states = {n: term(np.float64(v)) for n, v in zip(names, x, strict=True)}
        values = {n: term(np.float64(v)) for n, v in zip(parameter_names, p, strict=True)}
        wanted = EQUATIONS[name](t, states, values)
        found = rates(t, x, p)
        for k, state in enumerate(names):
            rate = term(wanted[state])
            ratio = abs(float(found[k]) - rate.value) / (eps * rate.scale or 1.0)
            assert ratio <= 4, (name, state, ratio, x, p, t)
            worst = max(worst, float(ratio))
    return worst


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("name", EQUATIONS)
def test_the_compiled_c_computes_the_equations_of_the_paper(name, real, compile_c):
    native = compile_c(MODELS / f"{name}.di", real=real)
    rng = np.random.default_rng(20130403)
    names, parameters = native.x_names, element_names(native.ode.parameters)
    xs, ps = random_points(names, rng), random_parameters(native.p0.astype(float), rng)

    def rates(t, x, p):
        return native.rhs(t, x, None, p)

    compare(name, rates, names, parameters, xs, ps, times(rng), native.dtype)


@pytest.mark.parametrize("name", EQUATIONS)
def test_the_numpy_module_computes_the_equations_of_the_paper(name):
    model = nsode.load(MODELS / f"{name}.di")
    module = load_module(model.ode)
    rng = np.random.default_rng(320276)
    names, parameters = element_names(model.ode.states), element_names(model.ode.parameters)
    xs, ps = random_points(names, rng), random_parameters(np.array(module.p0), rng)

    def rates(t, x, p):
        return module.rhs(t, x, np.zeros(0), p)

    compare(name, rates, names, parameters, xs, ps, times(rng), np.dtype(float))
