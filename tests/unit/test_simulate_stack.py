"""A scene whose step would not fit onto the stack is refused before the run."""

from __future__ import annotations

import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.simulate.stack import too_large_for_the_stack

resource = pytest.importorskip("resource")


def family(n: int) -> nsode.Model:
    return nsode.loads(
        f"model m\nconstant n = {n}\nstate x[i in 1..n] = 1\nfor i in 1..n: der(x[i]) = -x[i]\n"
        "simulate 0.01 {s} step 1e-3 {s}\n"
    )


@pytest.fixture
def small_stack():
    soft, hard = resource.getrlimit(resource.RLIMIT_STACK)
    resource.setrlimit(resource.RLIMIT_STACK, (8 * 2**20, hard))
    yield
    resource.setrlimit(resource.RLIMIT_STACK, (soft, hard))


def test_what_fits_runs(small_stack):
    assert too_large_for_the_stack(family(1000).ode) is None
    assert family(1000).simulate().x.shape == (11, 1000)


def test_what_does_not_fit_is_refused_with_the_way_out(small_stack):
    with pytest.raises(ModelError, match=r"NS511.*(\n.*)*ulimit -s"):
        family(500_000).simulate()
