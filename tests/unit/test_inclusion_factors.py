"""chi is what the author wrote: the innermost unbracketed product that holds sgn."""

from __future__ import annotations

import pytest

from support.reading import binding, compiled, rate, refused, remarks, term, text

HEAD = (
    "parameter mu = 0.5",
    "parameter N = 2",
    "parameter F = 3",
    "parameter M = 4",
    "parameter V = 5",
    "state s = 0",
    "state v = 1",
    "state w = 2",
    "der(s) = v",
    "der(w) = 0",
)


@pytest.mark.parametrize(
    ("written", "factor", "rest"),
    [
        ("mu*N*sgn(s)", "(mu * N)", "sgn1"),
        ("-mu*N*sgn(s)", "(mu * N)", "-sgn1"),
        ("-F*sgn(v)/M", "F", "-(sgn1 / M)"),
        ("F*sgn(v)/M*mu", "F", "((sgn1 / M) * mu)"),
        ("F/(V + abs(w))*sgn(w)", "(F / (V + abs(w)))", "sgn1"),
        ("F/M*sgn(v)", "(F / M)", "sgn1"),
        ("F/M/N*sgn(v)", "((F / M) / N)", "sgn1"),
        ("2*(mu*sgn(v))", "mu", "(2 * sgn1)"),
        ("(mu*N*sgn(s))*F", "(mu * N)", "(sgn1 * F)"),
        ("mu*(sgn(v))", "1", "(mu * sgn1)"),
        ("sgn(v)*F", "F", "sgn1"),
        ("sgn(v)*F*mu/M", "(F * mu)", "(sgn1 / M)"),
        ("sgn(v)/M*F", "1", "((sgn1 / M) * F)"),
        ("mu*-sgn(v)", "mu", "-sgn1"),
        ("-mu*-N*sgn(v)", "(mu * N)", "sgn1"),
        ("(-mu)*sgn(v)", "mu", "-sgn1"),
        ("(-(-mu))*sgn(v)", "mu", "sgn1"),
        ("sgn(v)*(-F)", "F", "-sgn1"),
        ("2*-3*sgn(v)", "(2 * 3)", "-sgn1"),
        ("mu^2*sgn(v)", "(mu ^ 2)", "sgn1"),
        ("(mu + N)*sgn(v)", "(mu + N)", "sgn1"),
        ("F - mu*sgn(v)", "mu", "(F + -sgn1)"),
        ("-(mu*sgn(v))", "mu", "-sgn1"),
        ("sgn(v)", "1", "sgn1"),
        ("sgn([v, w]).x", "1", "sgn1.x"),
        ("mu*sgn([v, w]).y/M", "mu", "(sgn1.y / M)"),
        ("mu*sgn([v, w])[2]", "mu", "sgn1.y"),
        ("dot([v, w], mu*sgn([v, w]))", "mu", "((v * sgn1.x) + (w * sgn1.y))"),
        ("if t < 1 then mu*sgn(v) else 0", "mu", "(if (t < 1) then sgn1 else 0)"),
    ],
)
def test_the_factor_is_read_off_the_text(written: str, factor: str, rest: str) -> None:
    model = compiled(*HEAD, f"der(v) = {written}")
    chi = term(model, "sgn1").factor
    assert chi is not None
    assert text(chi) == factor
    assert rate(model, "v") == rest


@pytest.mark.parametrize(
    ("written", "factor", "multiplier", "value"),
    [
        ("mu*N*sgn(s)", "(mu * N)", "G", None),
        ("(mu*N*sgn(s))", "(mu * N)", "G", None),
        ("-mu*N*sgn(s)", "(mu * N)", "G.lambda", "-G.lambda"),
        ("2*v + F*sgn(v)", "F", "G.lambda", "((2 * v) + G.lambda)"),
        ("F*sgn(v)/M", "F", "G.lambda", "(G.lambda / M)"),
        ("mu*(N*sgn(v))", "N", "G.lambda", "(mu * G.lambda)"),
        ("mu*dio(s)*sgn(v)", "(mu * dio1)", "G", None),
    ],
)
def test_a_named_force_is_its_term_and_what_stands_around_it(
    written: str, factor: str, multiplier: str, value: str | None
) -> None:
    model = compiled(*HEAD, f"force G = {written}", "M*der(v) = G")
    found = term(model, "G")
    assert found.factor is not None
    assert text(found.factor) == factor
    assert found.multiplier == (multiplier,)
    if value is not None:
        assert binding(model, "G") == value
    assert rate(model, "v") == "(G / M)"


def test_a_force_of_vectors_has_one_multiplier_for_each_component() -> None:
    model = compiled(*HEAD, "force G = -mu*sgn([v, w])", "der(v) = G.x + G.y")
    assert term(model, "G").multiplier == ("G.lambda.x", "G.lambda.y")
    assert binding(model, "G.y") == "-G.lambda.y"


def test_a_factor_divided_by_a_parameter_draws_a_note_and_one_that_is_not_does_not() -> None:
    assert "NS405" in remarks(*HEAD, "der(v) = -F/M*sgn(v)")
    assert "NS405" not in remarks(*HEAD, "der(v) = -F*sgn(v)/M")
    assert "NS405" not in remarks(*HEAD, "der(v) = -F/(V + abs(w))*sgn(v)")


def test_inline_terms_are_numbered_by_kind_in_the_order_of_the_text() -> None:
    model = compiled(
        *HEAD,
        "let late = early + dio(s - 1)",
        "let early = mu*sgn(w)",
        "der(v) = -late - dio(s) - mu*sgn(v)",
    )
    assert [t.name for t in sorted(model.inclusion.terms, key=lambda t: t.span)] == [
        "dio1",
        "sgn1",
        "dio2",
        "sgn2",
    ]


@pytest.mark.parametrize(
    ("written", "code"),
    [
        ("sgn(v)*sgn(w)", "NS202"),
        ("M*sgn(v)/2*sgn(w)", "NS203"),
        ("sgn(v)^2", "NS203"),
        ("1/sgn(v)", "NS203"),
        ("abs(sgn(v))", "NS203"),
        ("max(0, sgn(v))", "NS203"),
        ("if sgn(v) > 0 then 1 else 2", "NS203"),
        ("(F*sgn(v))*(mu*sgn(w))", "NS203"),
        ("mu*sgn(dio(s))", "NS204"),
        ("mu*sgn(v + sgn(w))", "NS204"),
        ("dio(s + dio(s))", "NS204"),
        ("dio(s - 1e-3*sgn(v))", "NS204"),
        ("(if s > 0 then 1 else 2)*sgn(v)", "NS202"),
        ("mod(s, 2)*sgn(v)", "NS202"),
        ("mu*sgn(mod(s, 2))", "NS207"),
        ("dio(if s > 0 then s else 2*s)", "NS207"),
        ("[1, 2]*sgn(v)", "NS206"),
        ("dio([s, v])", "NS105"),
        ("sgn([s, v, w, s]).x", "NS105"),
    ],
)
def test_what_the_method_does_not_allow_is_refused(written: str, code: str) -> None:
    assert refused(*HEAD, f"der(v) = -({written})") == [code]


@pytest.mark.parametrize(
    "written",
    [
        "(if t > 1 then 1 else 2)*sgn(v)",
        "mu*sgn(if t > 1 then v else w)",
        "mu*dio(s)*sgn(v)",
        "sqrt(dio(s))*sgn(v)",
        "dio(s)^2",
        "(mu*sgn(v))*s",
        "(mu*sgn(v) + F*sgn(w))/M",
        "dio(if mu > 1 then s else 2*s)",
    ],
)
def test_what_the_method_allows_is_accepted(written: str) -> None:
    assert refused(*HEAD, f"der(v) = -({written})") == []


def test_refusals_look_through_names() -> None:
    lines = (*HEAD, "let a = sgn(w)", "let b = a + v", "let c = if s > 0 then 1 else 2")
    assert refused(*lines, "der(v) = -abs(b)*sgn(v)") == ["NS202"]
    assert refused(*lines, "der(v) = -mu*sgn(b)") == ["NS204"]
    assert refused(*lines, "der(v) = -sin(b)") == ["NS203"]
    assert refused(*lines, "der(v) = -c*sgn(v)") == ["NS202"]
    assert refused(*lines, "der(v) = -sgn(c*v)") == ["NS207"]


def test_an_output_may_be_nonlinear_in_sgn() -> None:
    lines = (*HEAD, "force G = mu*sgn(v)", "let power = G^2", "der(v) = -G")
    assert refused(*lines, "output y = abs(G)*power") == []


def test_a_mass_matrix_may_hold_dio_but_not_sgn() -> None:
    assert refused(*HEAD, "(M + dio(s))*der(v) + der(w) = 1", "der(v) + 3*der(w) = 1")[-1:] == [
        "NS108"
    ]
    head = HEAD[:-1]
    rows = ("der(v) + 3*der(w) = 1",)
    assert refused(*head, "(M + dio(s))*der(v) + der(w) = 1", *rows) == []
    assert refused(*head, "(M + sgn(s))*der(v) + der(w) = 1", *rows) == ["NS203"]
