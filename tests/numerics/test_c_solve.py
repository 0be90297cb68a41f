"""Linear systems in the C: as accurate as their condition allows, singular ones told."""

import numpy as np
import pytest

from nsode.expr import Name
from nsode.ode import LinearSolve, Output, Parameter
from support.hand_built import ode
from support.native import StatusError

SIZES = [1, 2, 3, 4, 7]


def system(n):
    """Outputs v of M v = r, with M and r as parameters."""
    matrix = tuple(tuple(Name(f"m{i}_{j}") for j in range(n)) for i in range(n))
    right = tuple(Name(f"r{i}") for i in range(n))
    names = [entry.id for row in (*matrix, right) for entry in row]
    unknowns = tuple(f"v{i}" for i in range(n))
    return ode(
        f"solve{n}",
        parameters=[Parameter(name, (0.0,)) for name in names],
        bindings=[LinearSolve(unknowns, matrix, right)],
        outputs=[Output(name, Name(name)) for name in unknowns],
    )


def solve(native, matrix, right):
    return native.out(0.0, [], p=np.concatenate([np.ravel(matrix), right]))


@pytest.mark.parametrize("n", SIZES)
@pytest.mark.parametrize("spread", [0, 3, 8])
def test_the_error_is_that_of_the_condition(n, spread, compile_c):
    native = compile_c(system(n))
    rng = np.random.default_rng(4)
    for _ in range(50):
        u, _, v = np.linalg.svd(rng.normal(size=(n, n)))
        matrix = u @ np.diag(np.logspace(0, -spread, n)) @ v
        exact = rng.normal(size=n)
        right = matrix @ exact
        found = solve(native, matrix, right)
        bound = 20 * n * np.finfo(float).eps * np.linalg.cond(matrix)
        assert np.abs(found - exact).max() <= bound * np.abs(exact).max()


@pytest.mark.parametrize("n", SIZES[1:])
def test_rows_are_exchanged_where_the_diagonal_is_zero(n, compile_c):
    matrix = np.roll(np.eye(n), 1, axis=0)
    right = np.arange(1.0, n + 1)
    found = solve(compile_c(system(n)), matrix, right)
    np.testing.assert_array_equal(found, np.roll(right, -1))


@pytest.mark.parametrize("n", SIZES)
@pytest.mark.parametrize("scale", [1.0, 2.0**-600, 2.0**250])
def test_a_singular_matrix_is_told(n, scale, compile_c):
    native = compile_c(system(n))
    rng = np.random.default_rng(5)
    factors = rng.integers(-9, 10, size=(20, 2, n, n)).astype(float)
    factors[:, 0, :, -1] = 0
    for matrix in [np.zeros((n, n)), *(scale * (left @ right) for left, right in factors)]:
        with pytest.raises(StatusError) as told:
            solve(native, matrix, np.ones(n))
        assert told.value.status == 2


@pytest.mark.parametrize("n", SIZES)
def test_masses_of_very_different_size_are_no_singularity(n, compile_c):
    root = np.logspace(-3, 3, n)
    even = np.eye(n) + 0.1
    found = solve(compile_c(system(n)), even * np.outer(root, root), root)
    np.testing.assert_allclose(found * root, np.linalg.solve(even, np.ones(n)), rtol=1e-13)


@pytest.mark.parametrize("n", SIZES)
def test_a_nan_in_the_matrix_comes_out(n, compile_c):
    matrix = np.eye(n)
    matrix[-1, -1] = np.nan
    assert np.isnan(solve(compile_c(system(n)), matrix, np.ones(n))).any()
