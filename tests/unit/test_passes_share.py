"""Common expressions get a name, once, and where it parts no loops and wakes no dead branch."""

from __future__ import annotations

import pytest

import nsode
from nsode.backends.jacobian import sparse_jacobian
from nsode.expr import If, Index, IndexRange, Name, Number, Sum, walk
from nsode.ode import Binding, expressions
from nsode.passes.share import Value, share
from support.models import PATHS
from support.odes import call

A, B, C = Name("a"), Name("b"), Name("c")
PRODUCT = call("*", call("+", A, B), C)
QUOTIENT = call("/", call("+", A, B), C)
POSITIVE = call(">", A, 0)


def shared(*values, definitions=()):
    return share((), definitions, [Value(value) for value in values])


def test_what_stands_twice_is_computed_once():
    [item], values = shared(call("sin", PRODUCT), call("cos", PRODUCT))
    assert item == Binding("shared.1", PRODUCT, role="part")
    assert values == [call("sin", Name("shared.1")), call("cos", Name("shared.1"))]


def test_common_parts_of_common_parts_have_names_too():
    found, _ = shared(PRODUCT, PRODUCT, call("^", call("+", A, B), 2), call("+", A, B))
    assert [item.value for item in found] == [call("+", A, B), call("*", Name("shared.1"), C)]


@pytest.mark.parametrize("small", [A, Number(2.0), call("neg", A), call("/", 1, 2), POSITIVE])
def test_what_a_name_would_not_shorten_stays(small):
    values = [If(call(">", B, 0), small, C), If(call("<", B, 0), small, C), small]
    assert shared(*values) == ([], values)


def test_a_quotient_in_branches_is_not_computed_where_both_are_dead():
    one, other = (If(call(f, C, 0), QUOTIENT, Number(0.0)) for f in (">", "<"))
    assert shared(one, other) == ([], [one, other])
    assert shared(one, other, QUOTIENT)[0] == [Binding("shared.1", QUOTIENT, role="part")]


def test_a_branch_as_a_whole_may_have_a_name():
    gated = If(call("!=", C, 0), QUOTIENT, Number(0.0))
    [item], values = shared(call("*", 2, gated), call("*", 3, gated))
    assert item.value == gated
    assert values == [call("*", k, Name("shared.1")) for k in (2, 3)]


HERE, AHEAD = Name("x", Index("i")), Name("x", Index("i", 1))
OVER = IndexRange("i", 1, 3)


def test_what_reads_an_index_is_shared_in_its_loop():
    element = call("norm", HERE, AHEAD)
    given = [Binding(name, call(name, element), OVER) for name in ("sin", "cos")]
    found, _ = share((), given, [Value(element), Value(element, IndexRange("i", 1, 2))])
    assert found[0] == Binding("shared.1", element, OVER, role="part")
    shared_one = Name("shared.1", Index("i"))
    assert [item.value for item in found[1:]] == [call(n, shared_one) for n in ("sin", "cos")]


def test_the_body_of_a_sum_keeps_what_reads_its_index():
    element = call("*", call("+", HERE, A), call("sin", HERE))
    values = [Sum(OVER, element), Sum(OVER, call("cos", element))]
    assert shared(*values) == ([], values)


def test_an_element_beyond_a_wall_is_not_read_where_the_wall_is():
    apart = call("*", call("+", AHEAD, HERE), B)
    inside = call("<", Index("i"), 3)
    given = [Binding(n, If(inside, call(n, apart), Number(0.0)), OVER) for n in ("sin", "cos")]
    assert shared(definitions=given) == (given, [])


def test_a_definition_lends_its_own_name():
    given = (Binding("d", PRODUCT), Binding("e", call("sin", PRODUCT)))
    found, values = shared(PRODUCT, definitions=given)
    assert found == [Binding("d", PRODUCT), Binding("e", call("sin", Name("d")))]
    assert values == [Name("d")]


def test_names_stand_as_early_as_they_can():
    loops = [Binding(name, call(name, PRODUCT, HERE), OVER) for name in ("max", "min")]
    found, _ = share([Binding("c", Number(2.0))], loops, [])
    assert [item.name for item in found] == ["c", "shared.1", "max", "min"]


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_no_jacobian_of_a_model_computes_a_norm_twice(path):
    ode = nsode.load(path).ode
    found = sparse_jacobian(ode)
    made = [item for item in found.ode.bindings if item not in ode.bindings]
    nodes = [node for item in made for value in expressions(item) for node in walk(value)]
    nodes += [node for piece in found.pieces for node in walk(piece.value)]
    norms = [node for node in nodes if getattr(node, "function", None) == "norm"]
    assert len(norms) == len(set(norms))


def test_zeros_of_either_sign_are_two_numbers():
    one, other = (call("*", call("+", A, B), Number(zero)) for zero in (0.0, -0.0))
    assert shared(one, other) == ([], [one, other])
