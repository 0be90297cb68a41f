"""Depth and size: nothing recurses through names, and nothing grows faster than the text."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from nsode.diagnostics import ModelError
from support.reading import built, compiled, refused

DEEP = 1100  # beyond Python's recursion limit
HEAD = ("parameter mu = 0.5", "state s = 0", "state v = 1", "der(s) = v")


def chain(base: str, link: Callable[[str], str], length: int = DEEP) -> list[str]:
    """Return lets of which each reads the one before."""
    return [f"let b0 = {base}", *(f"let b{k} = {link(f'b{k - 1}')}" for k in range(1, length))]


LAST = f"b{DEEP - 1}"


@pytest.mark.parametrize(
    ("base", "link", "rate"),
    [
        ("s", "{0} + s", "{0}"),
        ("s", "{0} + s", "-mu*sgn({0})"),
        ("s", "{0} + s", "dio({0})"),
        ("abs(s)", "{0} + abs(s)", "-{0}*sgn(v)"),
        ("sgn(v)", "0.5*{0}", "-{0}"),
        ("sgn(v)", "{0} + dio(s)", "-{0}"),
        ("t", "{0} + 1", "der({0})"),
        ("sin(t)", "0.5*{0}", "der({0})"),
        ("s", "{0} + {0}", "-mu*sgn({0})"),
        ("s", "{0}*{0}", "-{0}*sgn(v)"),
        ("s", "{0} - {0}", "dio({0} + s)"),
        ("mu", "if t > 1 then {0} else 2", "-{0}*sgn(v)"),
    ],
)
def test_a_long_chain_of_names_compiles(base: str, link: str, rate: str) -> None:
    lets = chain(base, link.format)
    assert refused(*HEAD, *lets, f"der(v) = {rate.format(LAST)}") == []


def test_a_long_chain_may_be_written_backwards() -> None:
    lets = chain("s", "{0} + s".format)
    assert refused(*HEAD, *lets[::-1], f"der(v) = -mu*sgn({LAST})") == []


@pytest.mark.parametrize(
    ("base", "link", "rate", "code"),
    [
        ("s", "{0} + abs(s)", "-{0}*sgn(v)", "NS201"),
        ("sgn(v)", "{0} + s", "-mu*sgn({0})", "NS204"),
        ("sgn(v)", "{0} + s", "-abs({0})*sgn(s)", "NS202"),
        ("if s > 0 then 1 else 2", "{0} + s", "dio({0})", "NS207"),
        ("sgn(v)^2", "{0} + s", "{0}", "NS203"),
        ("s", "{0} + t", "der({0})", "NS112"),
        (LAST, "{0} + 1", "{0}", "NS106"),
    ],
)
def test_a_refusal_looks_through_a_long_chain(base: str, link: str, rate: str, code: str) -> None:
    lets = chain(base, link.format)
    assert refused(*HEAD, *lets, f"der(v) = {rate.format(LAST)}") == [code]


def test_the_members_of_a_long_circle_are_not_all_listed() -> None:
    with pytest.raises(ModelError) as caught:
        built(*HEAD, *chain(LAST, "{0} + 1".format), f"der(v) = {LAST}")
    [found] = caught.value.diagnostics
    assert len(found.message) < 100
    assert len(found.labels) <= 5


def test_derivatives_that_read_each_other_are_a_chain_of_names() -> None:
    declared = [f"state x{k} = 0" for k in range(DEEP)]
    rows = [f"der(x{k}) = der(x{k - 1}) + 1" for k in range(1, DEEP)]
    assert refused(*declared, *rows, "der(x0) = 1") == []
    assert refused(*declared, "der(x0) = 1", *rows[::-1]) == []


def test_constants_and_their_laws_may_be_long_chains() -> None:
    integers = ["constant c0 = 1", *(f"constant c{k} = c{k - 1} + 1" for k in range(1, DEEP))]
    assert refused(*integers[::-1], "state x = 0", f"der(x) = c{DEEP - 1}") == []
    n = 200
    forces = [f"force F{k} = sgn(x + {k})" for k in range(n)]
    laws = [f"approximate F{k}: K = F{k - 1}.K + F{k - 1}.K/2, beta = 1" for k in range(1, n)]
    rate = "der(x) = -" + " - ".join(f"F{k}" for k in range(n))
    first = "approximate F0: K = 1, beta = 1"
    assert refused("state x = 0", *forces, rate, *laws[::-1], first) == []


def test_families_that_read_their_neighbors_make_a_chain_too() -> None:
    n = 60
    lets = [
        f"let b{k}[i in 1..5] = b{k - 1}[i] + (if i < 5 then b{k - 1}[i+1] else 0)"
        for k in range(1, n)
    ]
    lines = ("state x[i in 1..5] = 0", "let b0[i in 1..5] = x[i]", *lets)
    assert refused(*lines, f"for i in 1..5: der(x[i]) = -sgn(b{n - 1}[i])") == []


def test_a_sum_of_thousands_of_terms_compiles() -> None:
    terms = " + ".join(["abs(s)"] * 5000)
    assert refused(*HEAD, f"der(v) = -({terms})*sgn(v)") == []


def test_the_analysis_goes_through_a_long_chain_too() -> None:
    lets = chain("s", "{0} + s".format)
    compiled(
        *HEAD, *lets, f"der(v) = dio({LAST})", "approximate default dio: K = 1, alpha = 1, beta = 1"
    )


def test_a_list_of_thousands_of_items_makes_no_deep_expression() -> None:
    items = ", ".join(str(k) for k in range(2000))
    lines = ("constant n = 2000", "state x[i in 1..n] = 0", f"let k[i in 1..n] = [{items}]")
    assert len(built(*lines, "for i in 1..n: der(x[i]) = k[i]").bindings) == 1


@pytest.mark.parametrize("power", [2, 3, 5])
def test_products_of_matrices_compile_as_far_as_they_go(power: int) -> None:
    lines = ("state q[3] = [0, 0, 0]", "let R = [[q.x, 1, 2], [3, q.y, 4], [5, 6, q.z]]")
    assert refused(*lines, f"der(q) = {'*'.join(['R'] * power)}*q") == []


def test_a_product_of_matrices_that_grows_without_end_is_refused() -> None:
    lines = ("state q[3] = [0, 0, 0]", "let R = [[q.x, 1, 2], [3, q.y, 4], [5, 6, q.z]]")
    assert refused(*lines, f"der(q) = {'*'.join(['R'] * 40)}*q") == ["NS011"]


@pytest.mark.parametrize("count", [1, 30])
def test_every_error_is_told_and_none_twice(count: int) -> None:
    lines = [f"let a{k} = missing{k} + 1" for k in range(count)]
    uses = [f"let b{k} = 2*a{k}" for k in range(count)]
    assert refused(*HEAD, *lines, *uses, "der(v) = b0") == ["NS101"] * min(count, 20)
