"""Coupled equations: against solutions by hand and by linear algebra."""

from __future__ import annotations

import math

import numpy as np
import pytest

from nsode.ode import Binding, LinearSolve
from support.reading import compiled, rate, rates, refused

PAIR = ("parameter m = 2", "parameter k = 3", "state a = 1", "state b = 2", "state c = 3")


def solves(*lines: str) -> list[LinearSolve]:
    return [item for item in compiled(*lines).ode.bindings if isinstance(item, LinearSolve)]


def test_coupled_rows_are_solved_together() -> None:
    model = compiled(*PAIR, "m*der(a) + k*der(b) = c", "k*der(a) + 5*der(b) = 1", "der(c) = 0")
    wanted = np.linalg.solve([[2, 3], [3, 5]], [7, 1])
    found = rates(model, {"c": 7})
    assert [found["a"], found["b"]] == pytest.approx(wanted, rel=1e-14)


def test_a_matrix_stands_before_der() -> None:
    model = compiled(
        "parameter m = 2",
        "state q[2] = [0.3, 0]",
        "let mass = [[m + 1, m*cos(q.x)], [m*cos(q.x), m]]",
        "mass*der(q) = [q.y, -q.x]",
    )
    c = 2 * math.cos(0.3)
    wanted = np.linalg.solve([[3, c], [c, 2]], [0.7, -0.3])
    found = rates(model, {"q.x": 0.3, "q.y": 0.7})
    assert [found["q.x"], found["q.y"]] == pytest.approx(wanted, rel=1e-14)


def test_a_cart_with_a_pole_accelerates_as_in_the_textbook() -> None:
    model = compiled(
        "parameter M = 1.5",
        "parameter m = 0.4",
        "parameter l = 0.7",
        "state v = 0",
        "state phi = 0.3",
        "state w = 0",
        "der(phi) = w",
        "(M + m)*der(v) + m*l*cos(phi)*der(w) = m*l*w^2*sin(phi)",
        "cos(phi)*der(v) + l*der(w) = -9.8*sin(phi)",
    )
    phi, w = 0.3, 0.9
    s, c = math.sin(phi), math.cos(phi)
    acceleration = 0.4 * s * (0.7 * w**2 + 9.8 * c) / (1.5 + 0.4 * s**2)
    found = rates(model, {"phi": phi, "w": w})
    assert found["v"] == pytest.approx(acceleration, rel=1e-14)
    assert found["w"] == pytest.approx((-9.8 * s - c * acceleration) / 0.7, rel=1e-14)


def test_a_family_of_blocks_is_one_small_system_for_each_index() -> None:
    lines = (
        "constant n = 3",
        "state q[i in 1..n][2] = [0, 0]",
        "let mass[i in 1..n] = [[2 + i, q[i].x], [q[i].x, 1]]",
        "for i in 1..n: mass[i]*der(q[i]) = [1, i]",
    )
    [solve] = solves(*lines)
    assert len(solve.unknowns) == 2
    assert solve.range is not None
    found = rates(compiled(*lines), {"q[2].x": 0.5, "q[3].x": 0.1})
    for i, x in ((1, 0.0), (2, 0.5), (3, 0.1)):
        wanted = np.linalg.solve([[2 + i, x], [x, 1]], [1, i])
        assert [found[f"q[{i}].x"], found[f"q[{i}].y"]] == pytest.approx(wanted, rel=1e-14)


def test_rows_of_a_block_may_call_their_index_differently() -> None:
    model = compiled(
        "constant n = 2",
        "state a[i in 1..n] = 0",
        "state b[j in 1..n] = 0",
        "for i in 1..n: 2*der(a[i]) + der(b[i]) = i",
        "for k in 0..n-1: der(a[k+1]) + 3*der(b[k+1]) = sum(i in 1..n: b[i]) + k + 1",
    )
    found = rates(model, {"b[1]": 0.5, "b[2]": 1})
    for i in (1, 2):
        wanted = np.linalg.solve([[2, 1], [1, 3]], [i, 1.5 + i])
        assert [found[f"a[{i}]"], found[f"b[{i}]"]] == pytest.approx(wanted, rel=1e-14)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 2, 0)])
def test_a_row_reads_derivatives_that_other_rows_say(order: tuple[int, ...]) -> None:
    rows = ["der(a) = k", "m*der(b) = der(a) + 1", "der(c) + der(a) = 3*der(b)"]
    lines = (*PAIR, *(rows[k] for k in order))
    assert solves(*lines) == []
    assert rates(compiled(*lines), {}) == {"a": 3, "b": 2, "c": 3}


def test_a_row_behind_a_system_reads_it_and_does_not_join_it() -> None:
    lines = (*PAIR, "der(a) + der(b) = 3", "der(a) - der(b) = 1", "der(c) = der(a) + 10*der(b)")
    [solve] = solves(*lines)
    assert set(solve.unknowns) == {"a.rate", "b.rate"}
    assert rates(compiled(*lines), {}) == {"a": 2, "b": 1, "c": 12}


def test_systems_that_share_no_derivative_are_apart() -> None:
    lines = ("state d = 0", "der(a) + der(b) = 3", "der(a) - der(b) = 1")
    rows = ("der(c) + 2*der(d) = 1", "der(c) - der(d) = 0")
    assert [len(s.unknowns) for s in solves(*PAIR, *lines, *rows)] == [2, 2]


def test_a_family_reads_scalars_and_scalars_read_elements() -> None:
    model = compiled(
        "constant n = 3",
        "state x[i in 1..n] = 0",
        "state y[i in 1..n] = 0",
        "state v = 0",
        "der(v) = 2",
        "for i in 1..n: der(x[i]) = i*der(v)",
        "der(y[1]) = der(x[3])",
        "for i in 2..n: der(y[i]) = der(x[i-1]) + 1",
    )
    found = rates(model, {})
    assert [found[f"y[{i}]"] for i in (1, 2, 3)] == [6, 3, 5]


def test_a_derivative_is_read_across_the_pieces_of_its_family() -> None:
    model = compiled(
        "constant n = 4",
        "state x[i in 1..n] = 0",
        "state y[i in 1..n] = 0",
        "der(x[1]) = 7",
        "for k in 2..3: der(x[k]) = k",
        "der(x[4]) = sum(k in 1..n: y[k])",
        "for i in 1..n: der(y[i]) = 2*der(x[i])",
    )
    found = rates(model, {"y[1]": 1, "y[4]": 0.5})
    assert [found[f"y[{i}]"] for i in (1, 2, 3, 4)] == [14, 4, 6, 3]
    names = [b.name for b in model.ode.bindings if isinstance(b, Binding)]
    assert names.count("x.rate") == 1


def test_a_row_is_aligned_with_the_element_that_it_says() -> None:
    model = compiled(
        "constant n = 3",
        "state x[i in 1..n] = 0",
        "state y[i in 1..n] = 0",
        "for i in 1..n: der(x[i]) = i",
        "for i in 2..n: der(x[i]) = der(y[i-1])",
        "der(y[n]) = 0",
    )
    found = rates(model, {})
    assert [found[f"y[{i}]"] for i in (1, 2, 3)] == [2, 3, 0]


@pytest.mark.parametrize(
    ("equation", "value"),
    [
        ("der(a) = 6", "6"),
        ("6 = der(a)", "6"),
        ("m*der(a) = c", "(c / m)"),
        ("-der(a) = c", "(c / -1)"),
        ("der(a) + c = 0", "-c"),
        ("der(a)/m = c", "(c / (1 / m))"),
        ("2*der(a) - der(a) = c", "(c / (2 + -1))"),
        ("m*(der(a) - c) = 0", "-(m * -c) / m"),
    ],
)
def test_an_equation_is_solved_for_its_derivative(equation: str, value: str) -> None:
    model = compiled(*PAIR, equation, "der(b) = 0", "der(c) = 0")
    assert rate(model, "a").strip("()") == value.strip("()")


@pytest.mark.parametrize(
    ("rows", "codes"),
    [
        (["der(a) + der(b) = 1"], ["NS107"]),
        (["der(a) + der(b) = 1", "der(a) - der(b) = 1", "der(a) = 2"], ["NS108"]),
        (["der(a) + der(b) = 1", "der(a) + der(b) = 2"], ["NS113"]),
        (["der(a) + 2*der(b) = 1", "k*der(a) + 2*k*der(b) = 2"], ["NS113"]),
        (["[[1, 2], [2, 4]]*[der(a), der(b)] = [1, 1]"], ["NS113"]),
        (["let M = [[m, k], [2*m, 2*k]]", "M*[der(a), der(b)] = [1, 1]"], ["NS113"]),
        (["let M = [[m, k], [0*m, 0]]", "M*[der(a), der(b)] = [1, 1]"], ["NS113"]),
        (["0*der(a) = 1", "der(b) = 1"], ["NS113"]),
        (["der(a) = 1", "der(a) = 2", "der(b) = 1"], ["NS108"]),
        (["der(a)*der(b) = 1", "der(b) = 1"], ["NS112"]),
        (["der(a)^2 = 1", "der(b) = 1"], ["NS112"]),
        (["1/der(a) = 1", "der(b) = 1"], ["NS112"]),
        (["if t > 1 then der(a) else 2 = 1", "der(b) = 1"], ["NS001"]),
        (["(if t > 1 then der(a) else 2) = 1", "der(b) = 1"], ["NS112"]),
        (["der(der(a)) = 1", "der(b) = 1"], ["NS112"]),
        (["der(2*a) = 1", "der(b) = 1"], ["NS112"]),
        (["a = 1", "der(b) = 1"], ["NS112"]),
        (["der(a) = der(c)*der(b)", "der(b) = 1"], ["NS112"]),
        (["let q = der(a)", "der(a) = q", "der(b) = 1"], ["NS112"]),
        (["der(a) = [1, 2]", "der(b) = 1"], ["NS105"]),
        (["der([a, b]) = [1, 2, 3]"], ["NS105"]),
    ],
)
def test_what_cannot_be_solved_is_refused(rows: list[str], codes: list[str]) -> None:
    assert refused(*PAIR, *rows, "der(c) = 0") == codes


def test_families_that_couple_neighbors_are_refused() -> None:
    head = ("constant n = 3", "state x[i in 1..n] = 0")
    assert refused(*head, "der(x[1]) = 1", "for i in 2..n: der(x[i]) = der(x[i-1])") == ["NS112"]
    assert refused(*head, "for i in 1..n: der(x[i]) = sum(j in 1..n: der(x[j]))") == ["NS112"]
