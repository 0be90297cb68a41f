"""Names of a model in C: readable, never two alike, never in anybody's way."""

import json
import subprocess

import pytest
from hypothesis import given
from hypothesis import strategies as st

import nsode
from nsode.backends import Options, emit
from nsode.backends.c.names import Mangler, plain
from nsode.expr import Name
from nsode.ode import Binding, Input, Output, Parameter, Rate, State
from support.hand_built import num, ode, plus
from support.native import have

HOSTILE = [
    "int", "NULL", "errno", "restrict", "INFINITY", "NAN", "y0", "unix", "linux", "I", "main",
    "x", "u", "p", "y", "dx", "h", "k1", "next", "real", "rates", "check", "finish", "status",
    "sat", "max0", "sum1", "i", "j", "class", "template", "this", "and", "or", "double", "fabs",
    "asm", "inline", "EOF", "x_x", "b_x", "_", "__", "__LINE__", "OK", "SINGULAR", "NX",
]  # fmt: skip


def test_a_dot_and_a_bracket_become_an_underscore():
    names = Mangler("x_")
    assert [names["p.x"], names["q[1]"], names["mu_1"]] == ["x_p_x", "x_q_1", "x_mu_1"]


def test_names_that_would_meet_are_numbered():
    names = Mangler("x_")
    assert [names["p.x"], names["p_x"], names["p.x"]] == ["x_p_x", "x_p_x_2", "x_p_x"]


def test_a_number_that_is_taken_is_skipped():
    names = Mangler("x_")
    assert [names["p_x_2"], names["p.x"], names["p_x"]] == ["x_p_x_2", "x_p_x", "x_p_x_3"]


words = st.from_regex(r"\A[A-Za-z_][A-Za-z0-9_]{0,3}\Z")
dotted = st.lists(words, min_size=1, max_size=3).map(".".join)


@given(st.lists(dotted, unique=True, max_size=30))
def test_no_two_names_become_one(many):
    names = Mangler("p_")
    assert len({names[name] for name in many}) == len(many)
    assert all(names[name].isidentifier() for name in many)


@pytest.mark.parametrize("name", ["", "1x", 'a"b', "a\\0b", "a\n", "a b", "a/*b", "naïve", "a;b"])
def test_text_that_is_no_name_never_reaches_c(name):
    with pytest.raises(ValueError, match="no name of a model"):
        plain(name)


@pytest.mark.parametrize("prefix", ["", "1a", "a-b", "a b", "a.b", "a\n", "é", '"'])
def test_a_prefix_is_an_identifier(prefix):
    scene = ode(prefix or "?", states=[State("x", num(0))], rates=[Rate("x", num(0))])
    with pytest.raises(ValueError, match="cannot begin"):
        emit("c", scene, Options(prefix=prefix))


def hostile():
    """Every hostile name in every role at once."""
    total = plus(*(Name(f"{word}.b") for word in HOSTILE))
    return ode(
        "int",
        states=[State(word, num(1)) for word in HOSTILE],
        inputs=[Input(f"{word}.u", 1.0) for word in HOSTILE],
        parameters=[Parameter(f"{word}.p", (1.0,)) for word in HOSTILE],
        bindings=[
            Binding(f"{w}.b", plus(Name(w), Name(f"{w}.u"), Name(f"{w}.p"))) for w in HOSTILE
        ],
        rates=[Rate(word, Name(f"{word}.b")) for word in HOSTILE],
        outputs=[Output(word, total) for word in HOSTILE],
    )


@pytest.mark.parametrize("compiler", ["gcc", "clang", "tcc"])
def test_no_name_of_a_user_clashes_with_anything(compiler, compile_c):
    native = compile_c(hostile(), cc=compiler)
    x = native.init()
    assert list(native.rhs(0.0, x)) == [3.0] * len(HOSTILE)
    assert list(native.out(0.0, x)) == [3.0 * len(HOSTILE)] * len(HOSTILE)


@pytest.mark.parametrize("name", ["math", "string", "stdio", "Time", "sched", "features"])
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_a_model_hides_no_header_of_the_system(name, tmp_path, compiler):
    model = nsode.loads(f"model {name}\nstate x = 1\nder(x) = -sin(x) + min(x, 2)\n")
    header, source, description = model.compile("c", tmp_path)
    assert [path.name for path in (header, source)] == [f"{name}_model.h", f"{name}_model.c"]
    assert json.loads(description.read_text())["prefix"] == f"{name}_model"
    if not have(compiler):
        pytest.skip(f"there is no {compiler}")
    compile_alone = [compiler, "-std=c99", "-Werror", "-I", str(tmp_path), "-c", str(source)]
    subprocess.run([*compile_alone, "-o", str(tmp_path / "out.o")], check=True)


@pytest.mark.parametrize("name", ["maths", "strings_attached", "ball", "stdio_model"])
def test_any_other_name_stays(name, tmp_path):
    paths = nsode.loads(f"model {name}\nstate x = 1\nder(x) = -x\n").compile("c", tmp_path)
    assert paths[0].name == f"{name}.h"
