import pytest
from hypothesis import given
from hypothesis import strategies as st

from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import AugmentedODE, Binding, Check, LinearSolve, Output, Rate, State
from nsode.passes.split import pieces, settle, split
from nsode.source import Source


def i(offset=0):
    return Index("i", offset)


def n(value):
    return Number(float(value))


def compare(function, left, right):
    return Call(function, (left, right))


X = Name("x", i())
Y = Name("y")
COMPARISONS = ["<", "<=", ">", ">=", "==", "!="]


def test_a_wall_is_a_single_element_and_the_rest():
    wall = If(compare(">", i(), n(0)), Name("x", i(-1)), n(0))
    assert pieces(IndexRange("i", 0, 9), wall) == [
        (IndexRange("i", 0, 0), (n(0),)),
        (IndexRange("i", 1, 9), (Name("x", i(-1)),)),
    ]


def test_two_walls_make_three_pieces_over_all_expressions():
    left = If(compare(">", i(), n(0)), Name("x", i(-1)), n(0))
    right = If(compare("<", i(), n(1000000)), X, Y)
    found = pieces(IndexRange("i", 0, 1000000), left, right)
    assert [(r.first, r.last) for r, _ in found] == [(0, 0), (1, 999999), (1000000, 1000000)]


def test_an_empty_range_has_no_pieces():
    assert pieces(IndexRange("i", 1, 0), X) == []


def test_neighbors_that_read_the_same_are_one_piece():
    same = If(compare("==", i(), n(3)), X, X)
    assert pieces(IndexRange("i", 0, 9), same) == [(IndexRange("i", 0, 9), (X,))]


def test_a_condition_on_a_state_stays():
    expr = If(compare(">", X, n(0)), X, Y)
    assert pieces(IndexRange("i", 0, 9), expr) == [(IndexRange("i", 0, 9), (expr,))]


def test_a_condition_that_is_not_affine_stays():
    even = If(compare("==", Call("mod", (i(), n(2))), n(0)), X, Y)
    assert pieces(IndexRange("i", 0, 9), even) == [(IndexRange("i", 0, 9), (even,))]


def test_what_the_index_leaves_open_of_a_condition_stays():
    expr = If(Call("and", (compare(">", i(), n(4)), compare(">", X, Y))), X, Y)
    assert pieces(IndexRange("i", 0, 9), expr) == [
        (IndexRange("i", 0, 4), (Y,)),
        (IndexRange("i", 5, 9), (If(compare(">", X, Y), X, Y),)),
    ]


def test_conditions_of_a_dead_branch_break_nothing():
    inner = If(compare("<", i(), n(3)), X, Y)
    expr = If(compare(">", i(), n(5)), inner, n(0))
    assert [r.first for r, _ in pieces(IndexRange("i", 0, 9), expr)] == [0, 6]


def test_a_sum_breaks_over_its_own_index_and_adds_in_rising_order():
    j = Index("j")
    body = If(compare("<", j, n(2)), Name("x", j), Name("y", Index("j", -2)))
    assert settle(Sum(IndexRange("j", 0, 5), body)) == Call(
        "+",
        (
            Sum(IndexRange("j", 0, 1), Name("x", j)),
            Sum(IndexRange("j", 2, 5), Name("y", Index("j", -2))),
        ),
    )


def test_the_sum_over_an_empty_range_is_zero():
    assert settle(Sum(IndexRange("j", 1, 0), Name("x", Index("j")))) == n(0)


def test_a_condition_on_two_indices_stays():
    body = If(compare("<", Index("j"), i()), Name("x", Index("j")), n(0))
    total = Sum(IndexRange("j", 0, 9), body)
    assert pieces(IndexRange("i", 0, 9), total) == [(IndexRange("i", 0, 9), (total,))]


def test_the_index_of_a_sum_hides_the_outer_one_of_the_same_name():
    total = Sum(IndexRange("i", 0, 9), If(compare("<", i(), n(3)), X, Y))
    [(over, (found,))] = pieces(IndexRange("i", 0, 9), total)
    assert over == IndexRange("i", 0, 9)
    assert found == Call("+", (Sum(IndexRange("i", 0, 2), X), Sum(IndexRange("i", 3, 9), Y)))


def test_numbers_alone_decide_without_any_range():
    assert settle(If(compare("<", n(1), n(2)), X, Y)) == X


MEANING = {
    "+": lambda *terms: sum(terms),
    "neg": lambda a: -a,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "not": lambda a: not a,
    "and": lambda a, b: a and b,
    "or": lambda a, b: a or b,
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}


def meaning(expr: Expr, at: int) -> float:
    """What an expression of the index ``i`` is, at one element."""
    match expr:
        case Number(value):
            return value
        case Index(variable, offset):
            return offset if variable is None else at + offset
        case Call(function, args):
            return MEANING[function](*(meaning(arg, at) for arg in args))
    raise AssertionError(expr)


quarters = st.integers(-40, 40).map(lambda k: Number(k / 4))
affine = st.recursive(
    st.one_of(quarters, st.builds(Index, st.sampled_from(["i", None]), st.integers(-5, 5))),
    lambda a: st.one_of(
        st.tuples(a, a).map(lambda t: Call("+", t)),
        a.map(lambda e: Call("neg", (e,))),
        st.tuples(quarters, a).map(lambda t: Call("*", t)),
        st.tuples(a, st.sampled_from([n(2), n(-4), n(0.5)])).map(lambda t: Call("/", t)),
    ),
    max_leaves=4,
)
conditions = st.recursive(
    st.builds(lambda op, a, b: Call(op, (a, b)), st.sampled_from(COMPARISONS), affine, affine),
    lambda c: st.one_of(
        st.tuples(c, c).map(lambda t: Call("and", t)),
        st.tuples(c, c).map(lambda t: Call("or", t)),
        c.map(lambda e: Call("not", (e,))),
    ),
    max_leaves=4,
)
trees = st.recursive(
    st.sampled_from([X, Y, n(0), n(1), i(2)]),
    lambda e: st.one_of(
        st.builds(If, conditions, e, e), st.tuples(e, e).map(lambda t: Call("+", t))
    ),
    max_leaves=6,
)


def chosen(expr: Expr, at: int) -> Expr:
    """The tree in which each condition is replaced by its branch at one element."""
    match expr:
        case If(condition, then, otherwise):
            return chosen(then if meaning(condition, at) else otherwise, at)
        case Call(function, args):
            return Call(function, tuple(chosen(arg, at) for arg in args))
        case _:
            return expr


@given(trees, trees, st.integers(-8, 8), st.integers(0, 20))
def test_each_element_reads_what_it_would_read_one_by_one(a, b, first, length):
    over = IndexRange("i", first, first + length - 1)
    elements = []
    for piece, (left, right) in pieces(over, a, b):
        assert len(piece) > 0
        elements += [(k, left, right) for k in range(piece.first, piece.last + 1)]
    assert elements == [(k, chosen(a, k), chosen(b, k)) for k in range(first, first + length)]


def ode(**parts) -> AugmentedODE:
    items = {"states": (), "inputs": (), "parameters": (), "bindings": (), "rates": ()}
    return AugmentedODE(**{"name": "m", "source": Source("m", ""), "outputs": ()} | items | parts)


OVER = IndexRange("i", 0, 9)
WALL = If(compare(">", i(), n(0)), X, n(0))


def test_bindings_rates_and_checks_come_in_pieces():
    done = split(
        ode(
            bindings=(Binding("b", WALL, OVER),),
            rates=(Rate("x", WALL, OVER),),
            checks=(
                Check("assume", Call("or", (compare("==", i(), n(0)), compare(">", X, Y))), OVER),
            ),
        )
    )
    assert [(b.name, b.range, b.value) for b in done.bindings] == [
        ("b", IndexRange("i", 0, 0), n(0)),
        ("b", IndexRange("i", 1, 9), X),
    ]
    assert [r.range for r in done.rates] == [IndexRange("i", 0, 0), IndexRange("i", 1, 9)]
    assert [(c.range, c.condition) for c in done.checks] == [
        (IndexRange("i", 1, 9), compare(">", X, Y))
    ]


def test_the_rows_of_a_solve_break_together():
    solve = LinearSolve(("a", "b"), ((X, n(0)), (WALL, Y)), (n(1), X), OVER)
    first, rest = split(ode(bindings=(solve,))).bindings
    assert (first.range, first.matrix, first.right) == (
        IndexRange("i", 0, 0),
        ((X, n(0)), (n(0), Y)),
        (n(1), X),
    )
    assert (rest.range, rest.matrix) == (IndexRange("i", 1, 9), ((X, n(0)), (X, Y)))


def test_states_and_outputs_keep_their_places():
    inside = If(compare("<", i(), n(100)), X, Y)
    done = split(
        ode(
            states=(State("x", inside, OVER), State("z", WALL, OVER)),
            outputs=(Output("y", inside, OVER), Output("w", WALL, OVER)),
        )
    )
    assert [s.initial for s in done.states] == [X, WALL]
    assert [y.value for y in done.outputs] == [X, WALL]


@pytest.mark.parametrize("last", [9, 10**9])
def test_the_cost_does_not_grow_with_the_number_of_elements(last):
    assert len(pieces(IndexRange("i", 0, last), If(compare("<", i(), n(5)), X, Y))) == 2
