"""Loops compute what the elements written out one by one compute."""

import numpy as np
import pytest

from nsode.backends import Options, emit
from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import Binding, Input, LinearSolve, Output, Parameter, Rate, State
from support.hand_built import call, column, minus, num, ode, plus
from support.native import StatusError, build

RNG = np.random.default_rng(20)


def contact(e, psi, K, alpha, beta):
    force = K * max(0.0, e - beta * (psi + e) * (1 / alpha))
    return force, max(-e * (1 / beta), -(psi + e) * (1 / alpha))


def column_by_hand(n, state, L, d, m, g, *constants):
    """The rates and forces of the column: (24), (25) and Newton, with the reciprocals of the C."""
    x, v, e = state[:n], state[n : 2 * n], state[2 * n :]
    gaps = [(x[i] if i < n else L) - (x[i - 1] if i > 0 else 0.0) - d for i in range(n + 1)]
    forces, rates = zip(*(contact(e[i], gaps[i], *constants) for i in range(n + 1)), strict=True)
    accelerations = [(forces[i] - forces[i + 1]) * (1 / m) - g for i in range(n)]
    total = 0.0
    for i, force in enumerate(forces):
        total += force * i
    return [*v, *accelerations, *rates], [*forces, total]


@pytest.mark.parametrize("n", [1, 2, 3, 10, 100])
def test_a_column_of_balls_is_its_equations_bit_for_bit(n, compile_c):
    native = compile_c(column(n))
    for _ in range(5):
        state = RNG.normal(scale=0.02, size=3 * n + 1)
        rates, outputs = column_by_hand(n, state, *native.p0)
        np.testing.assert_array_equal(native.rhs(0.0, state), rates)
        np.testing.assert_array_equal(native.out(0.0, state), outputs)


def test_a_column_starts_from_its_gaps(compile_c):
    x = compile_c(column(4)).init()
    position = 0.021 * np.arange(1, 5)
    gaps = np.diff([0.0, *position, 0.1]) - 0.02
    np.testing.assert_allclose(x, [*position, 0, 0, 0, 0, *np.maximum(0, -gaps)], atol=1e-16)


def test_only_tables_grow_with_the_number_of_elements():
    def code(n):
        files = emit("c", column(n), Options())
        return files["column.c"].partition("const column_real column_p0")[0].count(";")

    assert code(10) == code(10_000)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_names_beyond_the_portable_length_draw_no_warning(compiler, compile_c):
    native = compile_c(column(5000), cc=compiler)
    assert len(native.init()) == 15001


def test_family_parameters_inputs_and_offsets_find_their_elements(compile_c):
    i, over = Index("i"), IndexRange("i", -2, 3)
    scene = ode(
        states=[State("lead", num(7)), State("x", call("*", 2, i), over)],
        inputs=[Input("s", 5.0), Input("u", 1.0, over)],
        parameters=[Parameter("q", (9.0,)), Parameter("k", (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), over)],
        rates=[
            Rate("lead", plus(Name("k", Index(None, 3)), Name("u", Index(None, -2)), Name("s"))),
            Rate("x", num(0), IndexRange("i", -2, -2)),
            Rate("x", plus(Name("x", Index("i", -1)), Name("k", i), Name("u", i)),
                 IndexRange("i", -1, 3)),
        ],
        outputs=[Output("y", call("*", Name("q"), Name("x", i)), over), Output("z", Name("q"))],
    )  # fmt: skip
    native = compile_c(scene)
    x = native.init()
    np.testing.assert_array_equal(x, [7, -4, -2, 0, 2, 4, 6])
    u = np.array([100.0, 10, 20, 30, 40, 50, 60])
    np.testing.assert_array_equal(
        native.rhs(0.0, x, u), [6 + 10 + 100, 0, -4 + 2 + 20, -2 + 3 + 30, 4 + 40, 7 + 50, 10 + 60]
    )
    np.testing.assert_array_equal(native.out(0.0, x, u), [*(9 * x[1:]), 9])


def test_a_condition_that_is_left_to_the_run_is_kept(compile_c):
    i, over = Index("i"), IndexRange("i", 0, 5)
    even = call("==", call("mod", i, 2), 0)
    scene = ode(outputs=[Output("y", If(even, num(1), num(-1)), over)])
    np.testing.assert_array_equal(compile_c(scene).out(0.0, []), [1, -1, 1, -1, 1, -1])


def test_sums_add_in_rising_order(compile_c):
    j, over = Index("j"), IndexRange("j", 1, 4)
    values = (1e16, 1.0, 1.0, -1e16)
    scene = ode(
        parameters=[Parameter("k", values, IndexRange("i", 1, 4))],
        outputs=[Output("up", Sum(over, Name("k", j)))],
    )
    assert compile_c(scene).out(0.0, []) == [((1e16 + 1.0) + 1.0) - 1e16]


def test_sums_nest_and_stand_inside_loops(compile_c):
    i, j, k = Index("i"), Index("j"), Index("k")
    inner = Sum(IndexRange("k", 1, 3), call("*", plus(i, j), k))
    scene = ode(
        outputs=[Output("y", Sum(IndexRange("j", 1, 2), inner), IndexRange("i", 0, 3))],
    )
    expected = [
        sum((a + b) * c for b in range(1, 3) for c in range(1, 4)) for a in range(4)
    ]  # fmt: skip
    assert i != j
    np.testing.assert_array_equal(compile_c(scene).out(0.0, []), expected)


def test_empty_ranges_are_empty(compile_c):
    i, none = Index("i"), IndexRange("i", 1, 0)
    scene = ode(
        states=[State("x", num(1), none), State("y", num(2))],
        parameters=[Parameter("k", (), none)],
        bindings=[Binding("b", Name("x", i), none)],
        rates=[Rate("x", Name("b", i), none), Rate("y", Sum(none, Name("b", i)))],
    )
    native = compile_c(scene)
    assert list(native.init()) == [2]
    assert list(native.rhs(0.0, [2.0])) == [0]


def test_a_scene_without_anything_compiles(compile_c):
    native = compile_c(ode())
    assert list(native.step(0.0, 1.0, [])) == []


def test_one_small_system_for_each_element(compile_c):
    i, over = Index("i"), IndexRange("i", 1, 50)

    def at(name):
        return Name(name, i)

    matrix = ((plus(2, at("x")), num(0.5)), (num(0.5), num(1)))
    solve = LinearSolve(("a", "b"), matrix, (at("x"), num(1)), over)
    scene = ode(
        states=[State("x", call("/", i, 10), over)],
        bindings=[solve],
        rates=[Rate("x", at("a"), over)],
        outputs=[Output("b", at("b"), over), Output("far", Name("b", Index("i", 0)), over)],
    )
    native = compile_c(scene)
    x = native.init()
    solutions = [np.linalg.solve([[2 + value, 0.5], [0.5, 1]], [value, 1]) for value in x]
    np.testing.assert_allclose(native.rhs(0.0, x), [s[0] for s in solutions], rtol=1e-14)
    np.testing.assert_allclose(native.out(0.0, x)[:50], [s[1] for s in solutions], rtol=1e-14)


def test_a_broken_assumption_of_one_element_is_told(tmp_path):
    native = build(column(5), tmp_path, flags=("-O1", "-Dcolumn_CHECKS"))
    x = native.init()
    native.rhs(0.0, x)
    x[3] = -1.0
    with pytest.raises(StatusError) as told:
        native.rhs(0.0, x)
    assert told.value.status == 16


def written_out(expr: Expr, at: int | None = None) -> Expr:
    """The tree of one element, with names of families made names of elements."""
    match expr:
        case Name(id, Index(variable, offset)):
            return Name(f"{id}_{offset + (at if variable else 0)}")
        case Index(variable, offset):
            return Number(float(offset + (at if variable else 0)))
        case Call(function, args):
            return Call(function, tuple(written_out(arg, at) for arg in args))
        case _:
            return expr


def test_a_loop_is_its_elements_under_every_optimization(tmp_path):
    i, over = Index("i"), IndexRange("i", 0, 32)
    inner = IndexRange("i", 1, 31)
    spring = minus(Name("x", Index("i", 1)), Name("x", i))
    pulled = minus(Name("s", i), Name("s", Index("i", -1)))
    family = ode(
        "family",
        states=[State("x", call("/", 1, plus(i, 1)), over)],
        bindings=[Binding("s", call("*", 3.7, spring), IndexRange("i", 0, 31))],
        rates=[Rate("x", num(0), IndexRange("i", 0, 0)), Rate("x", num(0), IndexRange("i", 32, 32)),
               Rate("x", pulled, inner)],
    )  # fmt: skip
    scalar = ode(
        "scalar",
        states=[State(f"x_{k}", written_out(call("/", 1, plus(i, 1)), k)) for k in range(33)],
        bindings=[
            Binding(f"s_{k}", written_out(call("*", 3.7, spring), k)) for k in range(32)
        ],
        rates=[
            Rate(f"x_{k}", written_out(pulled, k) if 0 < k < 32 else num(0)) for k in range(33)
        ],
    )  # fmt: skip
    runs = []
    for scene in (family, scalar):
        for level in ("-O0", "-O3"):
            folder = tmp_path / f"{scene.name}{level}"
            native = build(scene, folder, flags=(level, "-ffp-contract=off"))
            runs.append(native.run(20, 0.05))
    for run in runs[1:]:
        np.testing.assert_array_equal(run, runs[0])
