"""Planar friction at rest without a load: no force, and no slope, in every target."""

from __future__ import annotations

import numpy as np
import pytest

import nsode
from support.models import MODELS
from support.modules import load_module


@pytest.fixture(scope="module")
def model() -> nsode.Model:
    return nsode.load(MODELS / "frictional_contact.di")


@pytest.fixture(scope="module")
def flight(model) -> np.ndarray:
    x = np.zeros(len(model.x0))
    x[2] = 1.0  # above the surface, nothing moves
    return x


def differences(rhs, x: np.ndarray) -> np.ndarray:
    """Return the Jacobian by central differences, far below the size of any kink."""
    h = 1e-7
    columns = [(rhs(x + h * e) - rhs(x - h * e)) / (2 * h) for e in np.eye(len(x))]
    return np.array(columns).T


def test_the_jacobian_in_free_flight_is_that_of_finite_differences(model, flight):
    module = load_module(model.ode)
    expected = differences(lambda x: module.rhs(0.0, x), flight)
    values = module.jac(0.0, flight)
    dense = np.zeros_like(expected)
    columns = np.repeat(np.arange(len(flight)), np.diff(module.jac_columns))
    dense[module.jac_rows, columns] = values
    np.testing.assert_allclose(dense, expected, rtol=1e-6, atol=1e-3)


def test_casadi_and_numpy_have_one_jacobian_there(model, flight):
    ca = pytest.importorskip("casadi")
    f = model.casadi()
    jacobian = ca.Function("J", [f.t, f.x, f.u, f.p], [ca.jacobian(f.dx, f.x)])
    module = load_module(model.ode)
    values = module.jac(0.0, flight)
    dense = np.zeros((len(flight), len(flight)))
    columns = np.repeat(np.arange(len(flight)), np.diff(module.jac_columns))
    dense[module.jac_rows, columns] = values
    np.testing.assert_array_equal(dense, np.array(jacobian(0, flight, 0, model.p0)))
