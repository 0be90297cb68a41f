"""Terms that are one element share their auxiliary states; the motion does not change."""

from __future__ import annotations

from itertools import product

import pytest

from support.reading import binding, compiled, rates, refused, remarks, states

HEAD = (
    "parameter mu = 0.5",
    "parameter R = 2",
    "parameter M = 4",
    "constant n = 3",
    "state s = 0",
    "state v = 1",
    "state w = 2",
    "der(s) = v",
    "der(w) = 0",
    "approximate default dio: K = 1e3, alpha = 2e-3, beta = 4e-3",
    "approximate default sgn: K = 1e3, beta = 4e-3",
)
FAMILIES = (
    *HEAD,
    "state x[i in 1..n] = 0",
    "state y[i in 1..n] = 0",
    "for i in 1..n: der(x[i]) = 0",
    "for i in 1..n: der(y[i]) = 0",
)


def auxiliary(*lines: str) -> list[str]:
    return [name for name in states(compiled(*lines)) if name.endswith((".e", ".a", ".x", ".y"))]


@pytest.mark.parametrize(
    ("written", "elements"),
    [
        ("dio(s) + dio(s)", 1),
        ("dio(s) + dio(2*s) + dio(s/4) + dio(-(-s))", 1),
        ("dio(s) + dio(-s)", 2),
        ("dio(s - R*w) + dio(2*s - 2*R*w) + dio(-w*R + s)", 1),
        ("dio(s - R*w) + dio(R*w - s)", 2),
        ("dio(0.1*s - 0.3*w) + dio(s - 3*w)", 1),
        ("dio(s + 1) + dio(2*(s + 1)) + dio(2*s + 2)", 1),
        ("dio(s + 1) + dio(s + 2)", 2),
        ("dio(R*s) + dio(s)", 2),
        ("dio(s + s) + dio(s)", 1),
        ("dio(gap) + dio(3*gap) + dio(s - w)", 1),
        ("mu*sgn(v) + mu*sgn(2*v) - mu*sgn(-v)", 1),
        ("mu*sgn(v - s) + mu*sgn(s - v) + mu*sgn(-2*s + 2*v)", 1),
        ("mu*R*sgn(v) + R*mu*sgn(v) + (mu*R)*sgn(v)", 1),
        ("mu*sgn(v) + 2*mu*sgn(v)", 2),
        ("mu*sgn(v) + R*sgn(v)", 2),
        ("mu*sgn(v) + mu*sgn(R*v)", 2),
    ],
)
def test_elements_are_counted_up_to_factors(written: str, elements: int) -> None:
    assert len(auxiliary(*HEAD, "let gap = s - w", f"der(v) = -({written})")) == elements


def test_vectors_agree_up_to_one_common_factor() -> None:
    force = "force A = mu*sgn([v, w])"
    same = "force B = mu*sgn([-2*v, -2*w])"
    other = "force B = mu*sgn([2*v, w])"
    assert len(auxiliary(*HEAD, force, same, "der(v) = -A.x - B.x")) == 2
    assert len(auxiliary(*HEAD, force, other, "der(v) = -A.x - B.x")) == 4


def test_the_first_written_gives_the_name_and_the_other_is_its_multiple() -> None:
    model = compiled(*HEAD, "force N = dio(s)", "force P = dio(2*s)", "der(v) = N + P")
    assert [term.name for term in model.inclusion.terms] == ["N"]
    assert binding(model, "P") == "(2 * N)"
    friction = compiled(*HEAD, "force F = mu*sgn(v)", "force G = mu*sgn(-3*v)", "der(v) = G - F")
    assert binding(friction, "G") == "-F"


def test_families_agree_whatever_their_index_is_called() -> None:
    forces = (
        "force A[i in 1..n] = dio(x[i] - y[i])",
        "let gap[j in 1..n] = x[j] - y[j]",
        "force B[k in 1..n] = 3*dio(3*gap[k])",
        "der(v) = sum(m in 1..n: A[m] + B[m])",
    )
    model = compiled(*FAMILIES, *forces)
    assert [term.name for term in model.inclusion.terms] == ["A"]
    assert binding(model, "B.lambda") == "(3 * A[i])"


@pytest.mark.parametrize(
    ("one", "other", "elements"),
    [
        ("sum(i in 1..n: dio(x[i]))", "sum(k in 1..n: dio(x[k]))", 3),
        ("sum(i in 1..n: dio(x[i]))", "sum(k in 2..n: dio(x[k]))", 5),
        ("sum(i in 2..n: dio(x[i]))", "sum(i in 2..n: dio(x[i-1]))", 4),
        ("dio(x[1])", "dio(x[1])", 1),
        ("dio(x[1])", "dio(x[2])", 2),
    ],
)
def test_elements_of_families_are_told_apart(one: str, other: str, elements: int) -> None:
    assert len(auxiliary(*FAMILIES, f"der(v) = {one} + {other}")) == elements


def test_sums_inside_sums_are_told_apart() -> None:
    first = "sum(i in 1..n: sum(j in 1..n: x[i]*y[j]))"
    second = "sum(i in 1..n: sum(j in 1..n: x[i]*y[i]))"
    third = "sum(k in 1..n: sum(i in 1..n: x[k]*y[i]))"
    assert len(auxiliary(*FAMILIES, f"der(v) = dio({first}) + dio({second})")) == 2
    assert len(auxiliary(*FAMILIES, f"der(v) = dio({first}) + dio({third})")) == 1


def test_one_argument_with_two_factors_draws_a_note() -> None:
    assert remarks(*HEAD, "der(v) = -mu*sgn(v) - R*sgn(-v)/M").count("NS403") == 1
    assert "NS403" not in remarks(*HEAD, "der(v) = -mu*sgn(v) - R*sgn(w)/M")


def test_one_element_has_one_set_of_constants() -> None:
    forces = (*HEAD, "force N = dio(s)", "force P = dio(2*s)", "der(v) = N + P")
    own = "K = 2e3, alpha = 1e-3, beta = 1e-3"
    assert refused(*forces, f"approximate P: {own}", f"approximate N: {own}") == ["NS305"]
    assert refused(*forces, f"approximate N, P: {own}") == []
    model = compiled(*forces, f"approximate P: {own}")
    assert [p.values for p in model.ode.parameters if p.name == "N.K"] == [(2e3,)]


SAMPLES = [
    {"s": s, "v": v, "w": 0.3} for s, v in product((-2e-3, 0.0, 1e-3), (-0.5, 0.0, 1e-5, 0.7))
]


@pytest.mark.parametrize(
    ("shared", "apart"),
    [
        ("3*dio(s) - dio(2*s)", "dio(s)"),
        ("mu*sgn(v) + mu*sgn(v)", "2*(mu*sgn(v))"),
        ("mu*sgn(v) + mu*sgn(3*v) - mu*sgn(-v)", "3*(mu*sgn(v))"),
        ("mu*sgn(v - w) - mu*sgn(w - v)", "2*(mu*sgn(v - w))"),
        ("mu*dio(s)*sgn(v) + dio(s)*mu*sgn(v)", "2*(mu*dio(s)*sgn(v))"),
    ],
)
@pytest.mark.parametrize("residual", [0.0, 3e-4])
def test_terms_that_share_move_like_the_one_that_they_are(
    shared: str, apart: str, residual: float
) -> None:
    one, other = (compiled(*HEAD, f"der(v) = -({written})") for written in (shared, apart))
    assert len(one.ode.auxiliary) == len(other.ode.auxiliary)
    for sample in SAMPLES:
        start = sample | dict.fromkeys([a.name for a in one.ode.auxiliary], residual)
        assert list(rates(one, start).values()) == pytest.approx(
            list(rates(other, start).values()), rel=1e-14, abs=1e-300
        )


def test_a_negative_argument_turns_the_auxiliary_state_and_nothing_else() -> None:
    plain, turned = (compiled(*HEAD, f"der(v) = {f}") for f in ("-mu*sgn(v)", "mu*sgn(-v)"))
    for sample in SAMPLES:
        for a in (-4e-4, 0.0, 1e-4):
            one, other = (
                rates(plain, sample | {"sgn1.a": a}),
                rates(turned, sample | {"sgn1.a": -a}),
            )
            assert one["v"] == other["v"]
            assert one["sgn1.a"] == -other["sgn1.a"]
