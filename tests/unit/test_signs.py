"""chi >= 0 is proved by structure, and exactly what a proof used is guarded."""

from __future__ import annotations

import pytest

import nsode
from nsode.diagnostics import ModelError
from support.reading import compiled, rates, refused, remarks, text

HEAD = (
    "parameter mu = 0.5",
    "parameter N = 2",
    "parameter zero = 0",
    "parameter below = -1",
    "parameter bounded = 3 {1} >= 0",
    "parameter far = 3 {1} >= 1",
    "constant n = 3",
    "parameter k[i in 1..n] = i",
    "parameter mixed[i in 1..n] = i - 2",
    "state v = 1",
    "state w = 2",
    "state x[i in 1..n] = 0",
    "der(w) = 0",
    "for i in 1..n: der(x[i]) = 0",
)

PROVED = [
    "1", "0", "mu", "zero", "mu*N", "mu + N", "N/mu", "bounded", "below*below", "below*(-N)",
    "abs(w)", "norm([v, w])", "sqrt(w)", "exp(w)", "cosh(w)", "max(0, w)", "max(w, mu)",
    "min(mu, max(0, w))", "min(mu, abs(w))", "w^2", "w^-2", "(v - w)^4", "mu^3", "w*w",
    "(v - w)*(2*v - 2*w)", "dio(w)", "mu*dio(w)", "mu*sqrt(dio(w))", "N/(mu + abs(w))",
    "N/(1 + w^2)", "N/exp(w)", "N/(far - 0)", "tanh(abs(w))", "atan(mu)", "if t > 0 then mu else 1",
    "sum(i in 1..n: x[i]^2)", "sum(i in 1..n: k[i]*abs(x[i]))", "sum(i in 1..n: i*x[i]^2)",
    "sum(i in 1..n: (i - 1)*abs(x[i]))", "sum(i in 1..n: (2*i - 1 - i)*abs(x[i]))", "acos(w)",
    "-(-mu)", "(-mu)*(-N)", "k[2]", "abs(w)/(k[1] + abs(v))",
    "N - mu", "log(N)", "N*cos(mu)", "mu + (N - mu)*exp(-abs(v))", "abs(w)/(N - mu - 1)",
]  # fmt: skip

UNPROVED = [
    "w", "below", "mu - N", "(N - mu)*w", "w^3", "w*v", "mu*below", "sin(w)", "mu + below",
    "N/zero", "N/w", "N/abs(w)", "min(mu, w)", "max(below, w)", "log(mu)", "cos(N)", "tanh(w)",
    "-dio(w)*w", "mixed[1]", "sum(i in 1..n: (i - 2)*abs(x[i]))", "sum(i in 1..n: mixed[i]^3)",
    "sum(i in 1..n: x[i])", "if t > 0 then mu else below", "-abs(w)*below*v", "x[1]",
    "-below*w - 1",
]  # fmt: skip


@pytest.mark.parametrize("factor", PROVED)
def test_is_proved(factor: str) -> None:
    assert refused(*HEAD, f"der(v) = -({factor})*sgn(v)") == []


@pytest.mark.parametrize("factor", UNPROVED)
def test_is_not_proved(factor: str) -> None:
    assert refused(*HEAD, f"let chi = {factor}", "der(v) = -chi*sgn(v)") == ["NS201"]


@pytest.mark.parametrize(
    ("assumption", "factor"),
    [
        ("w >= 0", "w"),
        ("w > 0", "mu/w"),
        ("0 <= w", "w"),
        ("w <= 0", "-w + 0"),
        ("mu >= w", "mu - w"),
        ("mu >= w", "2*(mu - w)"),
        ("w <= mu", "(mu - w)/N"),
        ("mu - w >= 0", "mu - w"),
        ("w - mu <= 0", "chi"),
        ("chi > 0", "chi"),
        ("chi > 0", "1/chi"),
        ("w > 0 and v > 0", "v*w"),
        ("v + w >= N", "w - N + v"),
        ("x[2] >= 0", "x[2]"),
        ("not (w < 0)", "w"),
        ("not (w <= mu)", "1/(w - mu)"),
        ("w == 2", "w"),
        ("w == mu", "w - mu"),
    ],
)
def test_is_proved_by_an_assumption(assumption: str, factor: str) -> None:
    lines = (*HEAD, "let chi = mu - w", f"der(v) = -({factor})*sgn(v)")
    assert refused(*lines) == ["NS201"]
    assert refused(*lines, f"assume {assumption}") == []


@pytest.mark.parametrize(
    ("assumption", "factor"),
    [
        ("w >= 0", "-w*v"),
        ("w >= 0", "mu/w"),
        ("w >= 0 or v >= 0", "w"),
        ("0*w >= 0", "-w + 0"),
        ("w - w >= 0", "-2*3*w^3"),
        ("x[2] >= 0", "x[1]"),
        ("not (w < 0)", "w - 1"),
    ],
)
def test_is_not_proved_by_another_assumption(assumption: str, factor: str) -> None:
    lines = (*HEAD, "let chi = " + factor, "der(v) = -chi*sgn(v)")
    assert refused(*lines, f"assume {assumption}") == ["NS201"]


@pytest.mark.parametrize(
    ("assumption", "term"),
    [
        ("for j in 1..n: assume x[j] >= 0", "T[i in 1..n] = x[i]*sgn(v)"),
        ("for i in 1..n: assume x[i] >= 0", "T[j in 0..n-1] = x[j+1]*sgn(v)"),
        ("for i in 0..n-1: assume x[i+1] >= 0", "T[i in 1..n] = x[i]*sgn(v)"),
        ("for i in 1..n: assume x[i] >= 0", "T = x[2]*sgn(v)"),
        ("for i in 1..n: assume x[i] >= 0", "T = sum(j in 1..n: x[j])*sgn(v)"),
        ("for i in 1..n: assume x[i] >= 0", "T[i in 0..n] = (if i > 0 then x[i] else mu)*sgn(v)"),
        ("for i in 2..n: assume x[i] >= 0", "T[i in 1..n] = (if i > 1 then x[i] else mu)*sgn(v)"),
        ("for i in 2..n: assume x[i-1] <= x[i]", "T[i in 1..n-1] = (x[i+1] - x[i])*sgn(v)"),
        ("for i in 1..n: assume w > x[i] and x[i] > 1", "T[i in 2..n] = (w - x[i])/x[1]*sgn(v)"),
        (
            "for i in 1..n: assume (if i < n then x[i] else 1) >= 0",
            "T[i in 1..n-1] = x[i]*sgn(v)",
        ),
        (
            "for i in 1..2: assume x[i] >= 0\nfor i in 3..n: assume x[i] > 0",
            "T[i in 1..n] = x[i]*sgn(v)",
        ),
    ],
)
def test_an_assumption_of_a_family_proves_its_elements(assumption: str, term: str) -> None:
    assert refused(*HEAD, "der(v) = 0", f"force {term}") == ["NS201"]
    assert refused(*HEAD, "der(v) = 0", f"force {term}", assumption) == []


@pytest.mark.parametrize(
    ("assumption", "term"),
    [
        ("for i in 2..n: assume x[i] >= 0", "T[i in 1..n] = x[i]*sgn(v)"),
        ("for i in 1..n-1: assume x[i+1] >= 0", "T[i in 1..n] = x[i]*sgn(v)"),
        ("for i in 1..n-1: assume x[i] >= 0", "T[i in 1..n-1] = x[i+1]*sgn(v)"),
        ("for i in 2..n: assume x[i] >= 0", "T = x[1]*sgn(v)"),
        ("for i in 1..n: assume x[2] >= 0", "T = x[1]*sgn(v)"),
        ("for i in 1..0: assume x[i] >= 0", "T[i in 1..n] = x[i]*sgn(v)"),
        ("for i in 1..n-1: assume x[i] <= x[i+1]", "T[i in 1..n-1] = (x[i] - 2*x[i+1])*sgn(v)"),
        ("for i in 1..n: assume x[i] >= 0", "T[i in 1..n] = x[i]*k[i]*v*sgn(v)"),
    ],
)
def test_an_assumption_of_a_family_proves_no_more_than_it_says(assumption: str, term: str) -> None:
    assert refused(*HEAD, "der(v) = 0", f"force {term}", assumption) == ["NS201"]


def test_an_element_of_an_unsound_family_may_be_sound() -> None:
    lines = ("der(v) = -(sum(i in 2..n: mixed[i]) + mixed[3])*sgn(v)",)
    assert guards(*lines) == {"(mixed[i] >= 0)"}
    checks = [c for c in compiled(*HEAD, *lines).inclusion.checks if c.kind == "bound"]
    assert {c.range for c in checks if "may then be negative" in c.reason} == {
        ("i", 2, 3),
        ("i", 3, 3),
    }


def guards(*lines: str) -> set[str]:
    """Return the bounds that the proof of a factor left behind."""
    model = compiled(*HEAD, *lines)
    return {text(c.condition) for c in model.inclusion.checks if "may then be negative" in c.reason}


@pytest.mark.parametrize(
    ("factor", "guarded"),
    [
        ("mu*N", {"(mu >= 0)", "(N >= 0)"}),
        ("mu*abs(w)", {"(mu >= 0)"}),
        ("N/mu", {"(N >= 0)", "(mu > 0)"}),
        ("mu/(mu + abs(w))", {"(mu > 0)"}),
        ("bounded*abs(w)", set()),
        ("N/far", {"(N >= 0)"}),
        ("below*below*mu", {"(mu >= 0)"}),
        ("below*(-N)", {"(below <= 0)", "(N >= 0)"}),
        ("max(mu, abs(w))", {"(mu >= 0)"}),
        ("max(abs(w), mu)", set()),
        ("exp(below)", set()),
        ("sum(i in 1..n: k[i]*abs(x[i]))", {"(k[i] >= 0)"}),
        ("2", set()),
    ],
)
def test_just_what_the_proof_used_is_guarded(factor: str, guarded: set[str]) -> None:
    assert guards(f"der(v) = -({factor})*sgn(v)") == guarded


@pytest.mark.parametrize(
    ("said", "factor", "mirrored"),
    [
        ("parameter low = -2 <= 0", "low", "2"),
        ("parameter low = -2 <= 0", "mu*low*N", "mu*2*N"),
        ("parameter low = -2 < 0", "mu/low", "mu/2"),
        ("input low = -2 <= -1", "low*abs(w)", "2*abs(w)"),
        ("assume w < 0", "w", "abs(w)"),
        ("let drag = -mu*dio(w)", "drag", "mu*dio(w)"),
    ],
)
def test_a_factor_known_to_be_negative_is_one_of_the_other_sign(said, factor, mirrored) -> None:
    """``chi*sgn(theta)`` is ``(-chi)*sgn(-theta)``: the state of the element is mirrored."""
    negative = compiled(*HEAD, said, f"der(v) = -{factor}*sgn(v)")
    positive = compiled(*HEAD, f"der(v) = {mirrored}*sgn(v)")
    constants = {"sgn1.K": 50, "sgn1.beta": 0.1} | (
        {"dio1.K": 9, "dio1.alpha": 0.1, "dio1.beta": 0.2} if "dio" in said else {}
    )
    for a in (-0.3, 0.01, 0.3):
        at = {"v": 0.2, "w": -0.7}
        found = rates(negative, {**at, "sgn1.a": -a}, constants)
        wanted = rates(positive, {**at, "sgn1.a": a}, constants)
        assert found["v"] == wanted["v"]
        assert found["sgn1.a"] == -wanted["sgn1.a"]


def test_a_negative_factor_is_held_to_what_was_declared_of_it() -> None:
    law = "approximate default sgn: K = 1, beta = 1"
    lines = ("parameter low = -2 <= 0", "der(v) = -mu*low*sgn(v)", law)
    with pytest.raises(ModelError, match="does not hold with `low` = 1"):
        compiled(*HEAD, *lines).with_parameters({"low": 1})
    with pytest.raises(ModelError, match="does not hold with `mu` = -1"):
        compiled(*HEAD, *lines).with_parameters({"mu": -1})


def test_a_negative_factor_that_pushes_draws_the_warning_that_it_deserves() -> None:
    low = "parameter low = -2 <= 0"
    assert "NS402" in remarks(*HEAD, low, "der(v) = -low*sgn(v)")
    assert "NS402" not in remarks(*HEAD, low, "der(v) = low*sgn(v)")


def test_an_assumption_is_checked_and_so_is_the_factor() -> None:
    model = compiled(*HEAD, "assume w >= 0", "der(v) = -w*sgn(v)")
    kinds = [(c.kind, text(c.condition)) for c in model.inclusion.checks]
    assert ("assume", "(w >= 0)") in kinds
    assert ("factor", "(w >= 0)") in kinds


def test_bounds_are_kept_in_si() -> None:
    model = compiled("parameter phi = 20 {deg} <= 180", "state v = 0", "der(v) = phi")
    [check] = model.inclusion.checks
    assert text(check.condition).startswith("(phi <= 3.14159")


@pytest.mark.parametrize(
    "lines",
    [
        ["parameter a = -1 >= 0"],
        ["parameter a = 0 > 0"],
        ["parameter a[i in 1..3] = 2 - i >= 0"],
        ["parameter a[2] = [1, -1] >= 0"],
        ["parameter a = 30 {deg} <= 20"],
        ["input a = 2 <= 1"],
        ["parameter a = 1", "assume a > 1"],
        ["parameter a = 1", "let b = 2*a", "assume b < a"],
        ["assume 1 < 0"],
        ["constant n = 3", "parameter k[i in 1..n] = 2 - i", "for i in 1..n: assume k[i] >= 0"],
        ["let k[i in 1..3] = 3 - i", "for i in 1..2: assume k[i] > 0 and k[i+1] > 0"],
        ["for i in 1..3: assume i < 3"],
    ],
)
def test_values_that_break_their_own_bounds_are_refused(lines: list[str]) -> None:
    assert refused(*lines, "state v = 0", "der(v) = 0") == ["NS307"]


@pytest.mark.parametrize(
    "lines",
    [
        ["parameter a = 0 >= 0"],
        ["parameter a = 1 > 0 < 2"],
        ["parameter a[i in 1..3] = 3 - i >= 0"],
        ["input a = 1 >= 0"],
        ["input a >= 0"],
        ["parameter a = 1", "assume a >= 1"],
        ["parameter k[i in 1..3] = 2 - i", "for i in 1..2: assume k[i] >= 0"],
        ["let k[i in 1..3] = 3 - i", "for i in 1..2: assume k[i] > k[i+1]"],
        ["for i in 1..0: assume i < 0"],
        ["state w = 0", "der(w) = 1", "assume w > 5"],
    ],
)
def test_values_within_their_bounds_are_accepted(lines: list[str]) -> None:
    assert refused(*lines, "state v = 0", "der(v) = 0") == []


@pytest.mark.parametrize(
    ("said", "factor"),
    [
        ("input u = 2\nassume u > 1", "u"),
        ("input u = 2\nassume u >= 1", "u"),
        ("input u = 2\nassume 1 <= u", "u"),
        ("input u = -2\nassume u <= -1", "(1 - u)"),
        ("parameter u = 2 >= 1", "(u - 1)"),
        ("parameter u = 2 > 1", "(u - 1)"),
    ],
)
def test_what_lies_beyond_a_number_has_the_sign_of_that_side(said, factor):
    model = f"model m\n{said}\nstate v = 1\nder(v) = -{factor}*sgn(v)\n"
    assert nsode.loads(model).inclusion.terms


def test_a_limit_on_the_wrong_side_of_zero_proves_nothing():
    with pytest.raises(ModelError, match="NS201"):
        nsode.loads("model m\ninput u = 2\nassume u > -1\nstate v = 1\nder(v) = -u*sgn(v)\n")


def test_what_parameters_alone_prove_is_guarded_as_one_value() -> None:
    lines = ("let drop = N - mu", "der(v) = -(mu + drop*exp(-abs(v)))*cos(mu)*sgn(v)")
    model = compiled(*HEAD, *lines, "approximate default sgn: K = 1e5, beta = 4e-3")
    model.with_parameters({"mu": 1.5, "N": 1.5})
    for values, why in (({"mu": 3}, "`mu` = 3"), ({"N": 0.4}, "`N` = 0.4")):
        with pytest.raises(ModelError, match=why) as refusal:
            model.with_parameters(values)
        assert {d.code for d in refusal.value.diagnostics} == {"NS307"}
    with pytest.raises(ModelError, match="NS307"):  # cos(1.6) is negative, N - mu is not
        model.with_parameters({"mu": 1.6})
