"""The predicted stable step against the growth of the difference of two runs."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import nsode
from nsode.analysis import analyze
from nsode.analysis.result import Analysis
from nsode.integrators import REGISTRY
from nsode.ode import size
from tests.support import MODELS
from tests.support.growth import inside

SMALL = [path for path in MODELS if sum(map(size, nsode.load(path).inclusion.terms)) <= 10]


@cache
def analyzed(path: Path) -> tuple[nsode.Model, Analysis]:
    model = nsode.load(path)
    return model, analyze(model.inclusion, model.ode)


@pytest.mark.parametrize("method", REGISTRY)
@pytest.mark.parametrize("path", SMALL, ids=lambda path: path.stem)
def test_runs_grow_apart_beyond_the_predicted_step_and_not_below_it(path, method):
    model, analysis = analyzed(path)
    limit = next(step for step in analysis.steps if step.method == method)
    place = inside(model, limit.modes)
    own_is_beyond = limit.own is not None and 0 < limit.own < limit.step
    steps = 8 if own_is_beyond else 200
    assert place.growth(method, 0.99 * limit.step, limit.eigenvalue, steps) < 0
    assert place.growth(method, 1.01 * limit.step, limit.eigenvalue, steps) > 0
