"""What is no error and yet said, and names: declared, misspelt, doubled, reserved."""

from __future__ import annotations

import pytest

from nsode.diagnostics import Diagnostic, ModelError
from support.reading import compiled, refused, remarks

CONSTANTS = "approximate default dio: K = 1e5, beta = 4e-3, alpha = 2e-3"
HEAD = ("state p = 1", "state v = 1", "der(p) = v")


def errors(*lines: str) -> list[Diagnostic]:
    with pytest.raises(ModelError) as caught:
        compiled(*lines)
    return list(caught.value.diagnostics)


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        (["parameter unused = 1", "der(v) = 0"], "NS401"),
        (["constant unused = 1", "der(v) = 0"], "NS401"),
        (["input unused = 1", "der(v) = 0"], "NS401"),
        (["let unused = 2*p", "der(v) = 0"], "NS401"),
        (["der(v) = 2*sgn(v)"], "NS402"),
        (["parameter F = 1", "der(v) = -F*sgn(v) - 2*F*sgn(v)"], "NS403"),
        (["der(v) = 0", "simulate 1 step 0.3"], "NS404"),
        (["parameter F = 1", "parameter M = 2", "der(v) = -F/M*sgn(v)"], "NS405"),
        (["der(v) = 1/(p - 1)"], "NS406"),
        (["let q = log(p - 2)", "der(v) = q"], "NS406"),
        (["force N = dio(p - 1.5)", "der(v) = N", CONSTANTS], "NS411"),
        (["let gap = p - 2", "der(v) = dio(gap)", CONSTANTS], "NS411"),
    ],
)
def test_is_remarked(lines: list[str], code: str) -> None:
    assert remarks(*HEAD, *lines) == [code]


@pytest.mark.parametrize(
    "lines",
    [
        ["parameter used = 1", "output y = used", "der(v) = 0"],
        ["parameter used = 1", "der(v) = 0", "assume used > 0"],
        ["constant n = 2", "state x[i in 1..n] = 0", "for i in 1..n: der(x[i]) = 0", "der(v) = 0"],
        ["der(v) = -2*sgn(v)", "approximate default sgn: K = 1, beta = 2"],
        ["der(v) = 0", "simulate 0.3 step 0.1"],
        ["der(v) = 0", "simulate 1 {min} step 1 {ms}"],
        ["der(v) = 1/(p + 1)"],
        ["der(v) = dio(p - 1.5)", f"{CONSTANTS}, at equilibrium"],
        ["der(v) = dio(p - 0.1 - 0.2 - 0.3 - 0.4)", CONSTANTS],  # -6e-17
        ["let gap = p - 0.9 - 0.1", "der(v) = dio(gap)", CONSTANTS],
        ["state q = -9.81*2/N.K", "der(q) = 0", "force N = dio(q)", "der(v) = N"],
    ],
)
def test_is_not_remarked(lines: list[str]) -> None:
    assert remarks(*HEAD, *lines) == []


def test_the_element_that_starts_deepest_inside_is_named() -> None:
    [found] = compiled(
        "state x[i in 1..4] = 0.1*(3 - i)^2",
        "force N[i in 1..4] = dio(x[i] - 0.05)",
        "for i in 1..4: der(x[i]) = N[i]",
        CONSTANTS,
    ).diagnostics
    assert (found.code, found.severity) == ("NS411", "warning")
    assert found.message == "the scene starts inside the contact `N[3]`, whose gap is -0.05"


def test_a_misspelt_name_gets_a_suggestion() -> None:
    [found] = errors(*HEAD, "parameter stiffness = 1", "der(v) = -stifness*p")
    assert found.code == "NS101"
    assert found.help == "did you mean `stiffness`?"


@pytest.mark.parametrize(
    ("line", "way_out"),
    [
        ("state q[2] = 1", "give one value for each component, for example `[0, 0]`"),
        ("state q = [1, 2, 3]", "declare `q[3]`, or give one number"),
        ("state q = [[1, 2], [3, 4]]", "give one number"),
    ],
)
def test_a_value_of_another_shape_gets_a_way_out_that_fits(line: str, way_out: str) -> None:
    [found] = errors(line, "der(q) = -q")
    assert (found.code, found.help) == ("NS105", way_out)


def test_a_misspelt_function_gets_a_suggestion() -> None:
    [found] = errors(*HEAD, "der(v) = sqt(p)")
    assert found.code == "NS104"
    assert found.help == "did you mean `sqrt`?"


def test_a_doubled_name_shows_both_places() -> None:
    [found] = errors(*HEAD, "let p = 2", "der(v) = 0")
    assert (found.code, len(found.labels)) == ("NS102", 2)


@pytest.mark.parametrize("name", ["t", "pi", "sin", "dio", "sgn", "der", "dio1", "sgn12", "max"])
def test_names_of_the_language_cannot_be_declared(name: str) -> None:
    assert refused(*HEAD, f"let {name} = 1", f"der(v) = {name}") == ["NS103"]


@pytest.mark.parametrize("name", ["lambda", "beta", "I", "S", "int", "K", "dio_", "sgnx", "psi"])
def test_other_names_are_free(name: str) -> None:
    assert refused(*HEAD, f"let {name} = 1", f"der(v) = {name}") == []


@pytest.mark.parametrize("name", ["sat(1, p)", "shrink(1, p)", "neg(p)", "and_(p, v)", "print(p)"])
def test_the_list_of_functions_is_closed(name: str) -> None:
    assert refused(*HEAD, f"der(v) = {name}") == ["NS104"]


@pytest.mark.parametrize(
    "slip",
    [
        "parameter a = 1/0",
        "parameter a = other",
        "let a = missing",
        "let a = [1, 2] + 3",
        "let a = a + 1",
        "force a = 3*p",
        "force a = dio(p) + dio(v)",
        "input a[2] = [1]",
    ],
)
def test_what_reads_a_refused_name_is_not_refused_again(slip: str) -> None:
    uses = ("let b = 2*a", "force c = b*sgn(v)", "output d = b", "der(v) = -c - a")
    assert len(errors(*HEAD, slip, *uses)) == 1


def test_several_errors_are_told_in_the_order_of_the_text() -> None:
    found = refused(*HEAD, "let a = x1", "let b = sin(1, 2)", "der(v) = [1, 2]", "let c = [1]+2")
    assert found == ["NS101", "NS110", "NS105", "NS105"]


@pytest.mark.parametrize(
    ("value", "code"),
    [
        ("1/0", "NS116"),
        ("0/0", "NS116"),
        ("sqrt(-1)", "NS116"),
        ("log(0)", "NS116"),
        ("1e200*1e200", "NS116"),
        ("exp(1000)", "NS116"),
        ("1e200*1e200*p", "NS116"),
        ("2^100", "NS013"),
        ("p^65", "NS013"),
    ],
)
def test_numbers_that_are_none_are_refused(value: str, code: str) -> None:
    assert refused(*HEAD, f"der(v) = {value}") == [code]


@pytest.mark.parametrize(
    ("state", "code"),
    [
        ("state x = p", "NS111"),
        ("state x = t", "NS111"),
        ("state x = load", "NS111"),
        ("state x = N", "NS111"),
        ("state x = moving", "NS111"),
        ("state x = dio(2)", "NS111"),
        ("state x = fixed", None),
        ("state x = 2*k + pi", None),
    ],
)
def test_a_start_rests_on_parameters(state: str, code: str | None) -> None:
    head = ("parameter k = 1", "input load = 0", "let fixed = 3*k", "let moving = p + k")
    found = refused(*HEAD, *head, "force N = dio(p)", state, "der(v) = N + load", "der(x) = 0")
    assert found == ([] if code is None else [code])
