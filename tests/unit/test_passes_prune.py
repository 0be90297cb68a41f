"""Only what was asked for is kept, and what is kept does not change."""

import numpy as np
import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.expr import Name
from nsode.ode import Binding, Output, Rate, State
from nsode.passes.prune import prune
from support import MODELS
from support.hand_built import num, ode, plus

SPHERE = next(path for path in MODELS if path.stem == "rolling_sphere")


def named(items):
    return [item.name for item in items]


def test_bindings_that_nothing_reads_go():
    scene = ode(
        states=[State("x", num(0))],
        bindings=[
            Binding("a", num(1)), Binding("dead", Name("a")), Binding("b", Name("a")),
            Binding("deader", Name("dead")),
        ],
        rates=[Rate("x", Name("b"))],
    )  # fmt: skip
    assert named(prune(scene).bindings) == ["a", "b"]


def test_the_sphere_without_its_attitude_has_twelve_states():
    scene = prune(nsode.load(SPHERE).ode, ["p", "v"])
    assert len(scene.states) == 12
    assert not [x for x in named(scene.states) if x.startswith("q")]
    assert [a.name for a in scene.auxiliary] == ["N.e", "F.a.x", "F.a.y"]


def test_a_force_brings_the_states_behind_it():
    scene = prune(nsode.load(SPHERE).ode, ["N"])
    assert set(named(scene.states)) == {"p.z", "v.z", "N.e"}
    assert named(scene.outputs) == ["N"]


def test_what_stays_is_bit_equal(compile_c):
    whole = nsode.load(SPHERE).ode
    part = prune(whole, ["p", "v", "F"])
    kept = [k for k, name in enumerate(named(whole.states)) if name in named(part.states)]
    runs = [compile_c(scene).run(500, 1e-3) for scene in (whole, part)]
    np.testing.assert_array_equal(runs[0][:, kept], runs[1])


def test_a_coupled_state_stays():
    scene = ode(
        states=[State(name, num(0)) for name in "abcd"],
        bindings=[Binding("l", Name("b"))],
        rates=[
            Rate("a", Name("l")), Rate("b", Name("c")), Rate("c", num(1)), Rate("d", Name("a")),
        ],
        outputs=[Output("y", Name("a")), Output("z", Name("d"))],
    )  # fmt: skip
    part = prune(scene, ["y"])
    assert (named(part.states), named(part.outputs)) == (["a", "b", "c"], ["y"])


def test_a_misspelt_name_is_refused():
    scene = ode(states=[State("x", num(0))], outputs=[Output("y", plus(Name("x"), 1))])
    with pytest.raises(ModelError, match="`z` is neither"):
        prune(scene, ["y", "z"])
