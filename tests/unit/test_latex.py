r"""TeX of names, expressions and whole systems; what is recorded stands under ``golden``."""

from __future__ import annotations

import re

import pytest

import nsode
from nsode.backends import Options, emit
from nsode.backends.latex import Environment, lower
from nsode.backends.latex.equations import definitions, environment
from nsode.backends.latex.lower import number
from nsode.backends.latex.names import Symbol, escape, symbols, word
from nsode.expr import Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import Binding, LinearSolve, Parameter, State
from support.golden import assert_recorded
from support.models import MODELS, PATHS
from support.odes import Maker, call, ode

ENV = Environment({name: word(name) for name in ("a", "b", "x", "mu", "slip", "K")})
A, B = Name("a"), Name("b")


@pytest.mark.parametrize(
    ("name", "tex"),
    [
        ("x", "x"),
        ("mu", r"\mu"),
        ("mu1", r"\mu_{1}"),
        ("M2", "M_{2}"),
        ("Ks", "K_{s}"),
        ("fe", "f_{e}"),
        ("k_s", "k_{s}"),
        ("x_rel", r"x_{\mathrm{rel}}"),
        ("slip", r"\mathit{slip}"),
        ("top2", r"\mathit{top}_{2}"),
        ("Omega", r"\Omega"),
        ("lambda", r"\lambda"),
    ],
)
def test_words_look_as_in_a_paper(name, tex):
    assert str(word(name)) == tex


def test_names_of_a_model_look_as_in_the_paper():
    known = symbols(nsode.load(MODELS / "two_blocks_conveyor.di").ode)
    shown = {name: str(known[name]) for name in ("p1.x", "v2.y", "N1.K", "N1.e", "F3.a", "Ks", "u")}
    assert shown == {
        "p1.x": "p_{1x}",
        "v2.y": "v_{2y}",
        "N1.K": "K_{N_{1}}",
        "N1.e": "e_{N_{1}}",
        "F3.a": "a_{F_{3}}",
        "Ks": "K_{s}",
        "u": "u",
    }


def test_no_two_names_look_alike():
    names = ["mu1", "mu_1", "p1.x", "p_1.x", "Ks", "K_s", "q[1]", "q1", "x.y", "x_y", "t", "N.K"]
    made = ode(parameters=[Parameter(name, (0.0,)) for name in names if name != "t"])
    shown = [str(symbol) for symbol in symbols(made).values()]
    assert len(shown) == len(names) == len(set(shown))


@pytest.mark.parametrize(
    ("value", "tex"),
    [
        (0.0, "0"),
        (2.0, "2"),
        (0.1, "0.1"),
        (1e5, "10^{5}"),
        (5e5, r"5 \times 10^{5}"),
        (1.25e-7, r"1.25 \times 10^{-7}"),
        (-1e5, "-10^{5}"),
        (0.0016, "0.0016"),
        (123456.5, r"1.234565 \times 10^{5}"),
    ],
)
def test_numbers_are_short_and_exact(value, tex):
    assert number(value) == tex
    read_back = tex.replace(r" \times 10^", "e").replace("10^", "1e")
    assert float(re.sub("[{}]", "", read_back)) == value


@pytest.mark.parametrize(
    ("expr", "tex"),
    [
        (call("+", A, call("neg", B), 2), "a - b + 2"),
        (call("+", A, call("neg", call("+", B, 2))), r"a - \left(b + 2\right)"),
        (call("neg", call("*", A, B)), "-a b"),
        (call("*", call("neg", A), B), "-a b"),
        (call("*", A, call("neg", B)), r"a \, \left(-b\right)"),
        (call("*", A, call("*", B, 2)), r"a \, \left(b \cdot 2\right)"),
        (call("*", Name("mu"), Name("slip")), r"\mu \, \mathit{slip}"),
        (call("/", call("neg", A), B), r"-\frac{a}{b}"),
        (call("/", call("neg", call("+", A, 1)), B), r"-\frac{a + 1}{b}"),
        (call("+", 1, call("/", call("neg", A), B)), r"1 - \frac{a}{b}"),
        (call("^", call("+", A, 1), 2), r"\left(a + 1\right)^{2}"),
        (call("^", call("/", A, B), 2), r"\left(\frac{a}{b}\right)^{2}"),
        (call("^", call("^", A, 2), 3), r"\left(a^{2}\right)^{3}"),
        (call("neg", call("^", A, 2)), "-a^{2}"),
        (call("^", call("neg", A), 2), r"\left(-a\right)^{2}"),
        (call("max", 0, A), r"\max\left(0, a\right)"),
        (call("sat", A, B), r"\operatorname{sat}\left(a, b\right)"),
        (call("norm", A, B), r"\left\|\left(a, b\right)\right\|"),
        (call("shrink", A, B), r"\min\left(1, \frac{a}{b}\right)"),
        (call("abs", A), r"\left|a\right|"),
        (call("sqrt", A), r"\sqrt{a}"),
        (call("asin", A), r"\arcsin\left(a\right)"),
        (call("mod", A, call("+", B, 1)), r"a \bmod \left(b + 1\right)"),
        (call("and", call("<", A, 1), call("!=", B, 2)), r"a < 1 \wedge b \ne 2"),
        (Name("x", Index("i", -1)), "x_{i-1}"),
        (Name("x", Index(None, 3)), "x_{3}"),
        (Sum(IndexRange("i", 1, 4), Name("x", Index("i"))), r"\sum_{i = 1}^{4} x_{i}"),
        (
            If(call(">", A, 0), A, If(call("<", A, -1), Number(1.0), B)),
            r"\begin{cases} a & \text{if } a > 0 \\ 1 & \text{if } a < -1 \\ "
            r"b & \text{otherwise} \end{cases}",
        ),
    ],
)  # fmt: skip
def test_expressions(expr, tex):
    assert lower(expr, ENV) == tex


def test_the_only_element_of_a_piece_has_its_number():
    made = ode(
        states=[State("x", Number(0.0), IndexRange("i", 1, 3))],
        bindings=[Binding("f", Name("x", Index("i", 1)), IndexRange("i", 2, 2))],
    )
    text = definitions(made.bindings, environment(made))
    assert "f_{2} &= x_{3}" in text


def test_a_linear_system_is_a_matrix_times_its_unknowns():
    solve = LinearSolve(("a", "b"), ((Number(1.0), A), (A, Number(2.0))), (B, Number(0.0)))
    made = ode(parameters=[Parameter("a", (1.0,)), Parameter("b", (1.0,))])
    text = definitions([solve], Environment(symbols(made)))
    expected = (
        r"\begin{aligned} \begin{bmatrix} 1 & a \\ a & 2 \end{bmatrix} "
        r"\begin{bmatrix} a \\ b \end{bmatrix} &= "
        r"\begin{bmatrix} b \\ 0 \end{bmatrix} \end{aligned}"
    )
    assert " ".join(text.split()) == expected


@pytest.mark.parametrize("text", [r"\input{x}", "a_b^c", "100 % $x$ & #1 {~}", "caf\u00e9", "x\ny"])
def test_text_cannot_become_a_command(text):
    escaped = escape(text)
    known = r"\\(textbackslash\{\}|textasciicircum\{\}|textasciitilde\{\}|[_#$%&{} ])"
    rest = re.sub(known, "", escaped)
    assert not set(rest) & set("\\_^#$%&{}~")
    assert rest.isascii()
    assert rest.isprintable()


def balanced(text: str) -> bool:
    """Whether braces, brackets of TeX and environments close in order."""
    stack: list[str] = []
    tokens = r"\\begin\{(\w+\*?)\}|\\end\{(\w+\*?)\}|\\left\\?.|\\right\\?.|\\[{}]|[{}]"
    for match in re.finditer(tokens, text):
        token = match[0]
        if token.startswith(r"\begin"):
            stack.append(match[1])
        elif token.startswith(r"\end"):
            if not stack or stack.pop() != match[2]:
                return False
        elif token.startswith(r"\left"):
            stack.append("left")
        elif token.startswith(r"\right"):
            if not stack or stack.pop() != "left":
                return False
        elif token == "{":
            stack.append("{")
        elif token == "}" and (not stack or stack.pop() != "{"):
            return False
    return not stack


@pytest.mark.parametrize("target", ["latex", "markdown"])
@pytest.mark.parametrize("seed", range(20))
def test_everything_closes(seed, target):
    [text] = emit(target, Maker(seed).make(), Options()).values()
    assert balanced(text)


def test_the_check_for_balance_can_fail():
    assert not balanced(r"\left( {a} ")
    assert not balanced(r"\begin{aligned} \end{bmatrix}")
    assert not balanced("{a}}")


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_an_independent_reader_parses_each_definition(path):
    """Mathtext of matplotlib knows no environments, so cases are left out."""
    mathtext = pytest.importorskip("matplotlib.mathtext")
    made = nsode.load(path).ode
    env = environment(made)
    parser = mathtext.MathTextParser("path")
    for item in made.bindings:
        if isinstance(item, Binding):
            tex = f"{env.symbols[item.name]} = {lower(item.value, env)}"
            if r"\begin" not in tex:
                parser.parse(f"${mathtext_spelling(tex)}$")


def mathtext_spelling(tex: str) -> str:
    """Return TeX with the few commands that matplotlib lacks spelt otherwise."""
    return tex.replace(r"\operatorname", r"\mathrm").replace(r"\left\|", r"\left|").replace(
        r"\right\|", r"\right|"
    )  # fmt: skip


def test_an_expression_that_nobody_knows_is_loud():
    with pytest.raises(NotImplementedError, match="no TeX rule for Expr"):
        lower(Expr(), ENV)


def test_a_symbol_with_subscripts_has_its_dot_on_the_letter():
    assert str(Symbol("e", ("N",)).dot) == r"\dot{e}_{N}"


@pytest.mark.parametrize("target", ["latex", "markdown"])
@pytest.mark.parametrize("model", ["two_blocks_conveyor", "rolling_sphere", "granular_column"])
def test_emits_the_recorded_text(model, target):
    [(name, text)] = nsode.load(MODELS / f"{model}.di").emit(target).items()
    assert_recorded(f"{target}/{name}", text)
