"""What shares a loop, and what is kept in an array."""

from nsode.backends import Options
from nsode.backends.c.plan import Readings, Store, plan
from nsode.backends.c.program import program
from nsode.backends.c.work import rates
from nsode.expr import Index, IndexRange, Name, Sum
from nsode.ode import Binding
from support.hand_built import column, num, plus

OVER = IndexRange("i", 1, 9)


def at(name, offset=0):
    return Name(name, Index("i", offset))


def shape(works):
    """The range of each group with the names that it defines or stores."""
    made = plan(works, Readings())
    return [
        (
            None if group.range is None else (group.range.first, group.range.last),
            [work.place if isinstance(work, Store) else work.name for work in group.works],
        )
        for group in made.groups
    ], set(made.stored)


def test_steps_on_the_way_share_a_loop_and_stay_scalars():
    works = [
        Binding("a", at("x"), OVER),
        Binding("b", plus(at("a"), at("x", 1)), OVER),
        Store("dx", "v", at("b"), OVER, 1),
    ]
    assert shape(works) == ([((1, 9), ["a", "b", "v"])], set())


def test_what_a_neighbor_reads_is_stored_and_read_in_a_later_loop():
    works = [
        Binding("a", at("x"), OVER),
        Binding("b", at("a"), OVER),
        Store("dx", "v", at("a", -1), IndexRange("i", 2, 9), 1),
        Store("dx", "w", at("a", -1), OVER, 1),
    ]
    groups, stored = shape(works)
    assert groups == [((1, 9), ["a", "b"]), ((2, 9), ["v"]), ((1, 9), ["w"])]
    assert stored == {"a"}


def test_a_sum_reads_an_array_even_under_the_same_index_name():
    works = [Binding("a", at("x"), OVER), Store("y", "s", Sum(OVER, at("a")))]
    assert shape(works) == ([((1, 9), ["a"]), (None, ["s"])], {"a"})
    inside = [Binding("a", at("x"), OVER), Store("y", "s", Sum(OVER, at("a")), OVER, 1)]
    assert shape(inside) == ([((1, 9), ["a"]), ((1, 9), ["s"])], {"a"})


def test_scalars_come_before_the_loops_that_read_them():
    works = [
        Binding("a", at("x"), OVER),
        Binding("s", num(1)),
        Store("dx", "v", plus(at("a"), Name("s")), OVER, 1),
    ]
    groups, stored = shape(works)
    assert groups == [((1, 9), ["a"]), (None, ["s"]), ((1, 9), ["v"])]
    assert stored == {"a"}


def test_an_element_by_number_is_read_after_its_loop():
    works = [Binding("a", at("x"), OVER), Binding("s", Name("a", Index(None, 3)))]
    assert shape(works) == ([((1, 9), ["a"]), (None, ["s"])], {"a"})


def test_work_breaks_where_what_it_reads_breaks():
    works = [
        Binding("a", num(0), IndexRange("i", 1, 1)),
        Binding("a", at("x", -1), IndexRange("i", 2, 9)),
        Store("dx", "v", at("a"), OVER, 1),
    ]
    assert shape(works) == ([((1, 1), ["a", "v"]), ((2, 9), ["a", "v"])], set())


def test_two_names_of_one_index_share_a_loop():
    k = Index("k")
    works = [Binding("a", at("x"), OVER), Store("dx", "v", Name("a", k), IndexRange("k", 1, 9), 1)]
    assert shape(works) == ([((1, 9), ["a", "v"])], set())


def test_the_column_is_three_pieces_of_contacts_and_one_loop_of_balls():
    made = plan(rates(program(column(100), Options())), Readings())
    assert [(g.range.first, g.range.last) for g in made.groups] == [
        (0, 0), (1, 99), (100, 100), (1, 100)
    ]  # fmt: skip
    assert made.stored == {"N": IndexRange("", 0, 100)}
