"""Friction in one, two and three dimensions has one stable step: that of the stiffest direction."""

from __future__ import annotations

import pytest

import nsode


def slider(dimension: int) -> nsode.Model:
    rest = ", ".join("0" for _ in range(dimension - 1))
    start = f"[1, {rest}]" if rest else "1"
    size = f"[{dimension}]" if dimension > 1 else ""
    return nsode.loads(
        f"model slider\nparameter M = 2\nstate v{size} = {start}\nforce F = sgn(v)\n"
        "M*der(v) = -F\napproximate F: K = 1e5, beta = 4e-3\n"
    )


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_step_does_not_depend_on_the_dimension_of_slip(dimension):
    steps = slider(dimension).analyze().as_json()["stable_step"]
    line = slider(1).analyze().as_json()["stable_step"]
    assert steps == pytest.approx(line, rel=1e-6)


@pytest.mark.parametrize(("dimension", "sets"), [(1, 3), (2, 5), (3, 7)])
def test_slip_along_each_axis_is_a_set_of_its_own(dimension, sets):
    assert slider(dimension).analyze().sets == sets
