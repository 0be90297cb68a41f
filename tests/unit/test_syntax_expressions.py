"""Expressions: precedence, association, spans."""

from __future__ import annotations

import ast as python
import math
import operator
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nsode.diagnostics import ModelError
from nsode.expr import Call, Expr, If, Name, Number, walk
from nsode.source import Source
from nsode.syntax import ast, parse


def expression(text: str) -> Expr:
    model = parse(Source("m.di", f"model m\nlet y = {text}\n"))
    (statement,) = model.statements
    assert isinstance(statement, ast.LetDeclaration)
    return statement.value


def refused(text: str) -> set[str]:
    with pytest.raises(ModelError) as caught:
        expression(text)
    return {diagnostic.code for diagnostic in caught.value.diagnostics}


a, b, c, x = map(Name, "abcx")


def call(function: str, *args: Expr) -> Call:
    return Call(function, args)


def n(value: float) -> Number:
    return Number(float(value))


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("-a*b*c", call("neg", call("*", call("*", a, b), c))),
        ("-a^2", call("neg", call("^", a, n(2)))),
        ("2^-3", call("^", n(2), call("neg", n(3)))),
        ("a^b^c", call("^", a, call("^", b, c))),
        ("2^-b^c", call("^", n(2), call("neg", call("^", b, c)))),
        ("a*-b", call("*", a, call("neg", b))),
        ("a*-b*c", call("*", call("*", a, call("neg", b)), c)),
        ("a/b*c", call("*", call("/", a, b), c)),
        ("2--a", call("+", n(2), call("neg", call("neg", a)))),
        ("a - b - c", call("+", a, call("neg", b), call("neg", c))),
        ("a - b*c + x", call("+", a, call("neg", call("*", b, c)), x)),
        ("-a + b", call("+", call("neg", a), b)),
        ("a + (b + c)", call("+", a, ast.Group(call("+", b, c)))),
        ("a < b + c", call("<", a, call("+", b, c))),
        ("not a < b", call("not", call("<", a, b))),
        (
            "a < b and b != c or not x >= a",
            call(
                "or",
                call("and", call("<", a, b), call("!=", b, c)),
                call("not", call(">=", x, a)),
            ),
        ),
        ("if a < b then a else b + c", If(call("<", a, b), a, call("+", b, c))),
        ("if a then b else if b then c else x", If(a, b, If(b, c, x))),
        ("(if a then b else c)*x", call("*", ast.Group(If(a, b, c)), x)),
        ("sgn(a).x", ast.Component(call("sgn", a), "x")),
        ("a[b + 1].y", ast.Component(ast.Subscript(a, call("+", b, n(1))), "y")),
        ("a[1][2]", ast.Subscript(ast.Subscript(a, n(1)), n(2))),
        ("[a, -b]", ast.Bracket((a, call("neg", b)))),
        ("[[a, b], [b, a]][1]", ast.Subscript(
            ast.Bracket((ast.Bracket((a, b)), ast.Bracket((b, a)))), n(1))),
        ("a.K", ast.Component(a, "K")),
        ("a.step", ast.Component(a, "step")),
        ("f()", call("f")),
        ("f(a, b)", call("f", a, b)),
        ("sum(i in 1..n: x[i])", ast.Reduction(
            ast.RangeSyntax(ast.Identifier("i"), n(1), Name("n")), ast.Subscript(x, Name("i")))),
        ("2.*a", call("*", n(2), a)),
        (".5", n(0.5)),
        ("1E-3", n(1e-3)),
        ("1e5", n(1e5)),
        ("lambda*NULL", call("*", Name("lambda"), Name("NULL"))),
    ],
)  # fmt: skip
def test_builds_the_tree(text: str, tree: Expr) -> None:
    assert expression(text) == tree


@pytest.mark.parametrize("text", ["1..n", "1.5..n", "1 ..n", "1. .. n"])
def test_two_dots_make_a_range_whatever_stands_before_them(text: str) -> None:
    first = float(text.rstrip("n").rstrip(" .") or 0)
    tree = expression(f"sum(i in {text}: i)")
    assert isinstance(tree, ast.Reduction)
    assert (tree.range.first, tree.range.last) == (n(first), Name("n"))


# Python has the same precedence, so its parser judges ours; what differs in form
# (where a minus stands, flat sums) is equal in floating point.

_BINARY: dict[str, Callable[[float, float], float]] = {
    "*": operator.mul,
    "/": operator.truediv,
    "^": math.pow,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
    "and": lambda p, q: p and q,
    "or": lambda p, q: p or q,
}
_PYTHON: dict[type, Callable[..., float]] = {
    python.Add: operator.add,
    python.Sub: operator.sub,
    python.Mult: operator.mul,
    python.Div: operator.truediv,
    python.Pow: math.pow,
    python.USub: operator.neg,
    python.Not: operator.not_,
    python.Lt: operator.lt,
    python.LtE: operator.le,
    python.Gt: operator.gt,
    python.GtE: operator.ge,
    python.Eq: operator.eq,
    python.NotEq: operator.ne,
}
_VALUES = {"a": 1.37, "b": -0.61, "c": 2.9}


def ours(tree: Expr) -> float:
    match tree:
        case Number(value):
            return value
        case Name(name):
            return _VALUES[name]
        case ast.Group(inner):
            return ours(inner)
        case If(condition, then, otherwise):
            return ours(then) if ours(condition) else ours(otherwise)
        case Call("+", (first, *rest)):
            total = ours(first)
            for term in rest:
                total += ours(term)
            return total
        case Call("neg", (operand,)):
            return -ours(operand)
        case Call("not", (operand,)):
            return not ours(operand)
        case Call(name, (left, right)):
            return _BINARY[name](ours(left), ours(right))
    raise AssertionError(tree)


def theirs(node: python.expr) -> float:
    match node:
        case python.Constant(value=float() | int() as value):
            return float(value)
        case python.Name(id=name):
            return _VALUES[name]
        case python.UnaryOp(op=op, operand=operand):
            return _PYTHON[type(op)](theirs(operand))
        case python.BinOp(left=left, op=op, right=right):
            return _PYTHON[type(op)](theirs(left), theirs(right))
        case python.Compare(left=left, ops=[op], comparators=[right]):
            return _PYTHON[type(op)](theirs(left), theirs(right))
        case python.BoolOp(op=op, values=values):
            result = theirs(values[0])
            for value in values[1:]:
                is_and = isinstance(op, python.And)
                result = (result and theirs(value)) if is_and else (result or theirs(value))
            return result
    raise AssertionError(python.dump(node))


def value(evaluate: Callable[[], float]) -> object:
    try:
        return repr(float(evaluate()))
    except (ArithmeticError, ValueError) as error:
        return type(error)


_OPERAND = st.sampled_from(["a", "b", "c", "2", "0.5", "3e0"])


def _joined(parts: st.SearchStrategy[str], between: list[str]) -> st.SearchStrategy[str]:
    more = st.tuples(st.sampled_from(between), parts).map("".join)
    return st.tuples(parts, st.lists(more, max_size=4).map("".join)).map("".join)


def _arithmetic(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    grouped = st.one_of(inner, _OPERAND).flatmap(
        lambda text: st.sampled_from([text if text.isalnum() else f"({text})", f"({text})"])
    )
    signed = st.tuples(st.sampled_from(["", "-"]), grouped).map("".join)
    first = st.tuples(st.sampled_from(["", "-"]), grouped).map("".join)
    joined = st.lists(
        st.tuples(st.sampled_from(["+", "-", "*", "/", "^", " - ", " * "]), signed).map("".join),
        max_size=5,
    ).map("".join)
    return st.tuples(first, joined).map("".join)


@given(st.recursive(_OPERAND, _arithmetic, max_leaves=12))
def test_arithmetic_means_what_it_means_in_python(text: str) -> None:
    node = python.parse(text.replace("^", "**"), mode="eval").body
    assert value(lambda: ours(expression(text))) == value(lambda: theirs(node))


_RELATION = st.tuples(_OPERAND, st.sampled_from(["<", "<=", ">", ">=", "==", "!="]), _OPERAND).map(
    " ".join
)
_CONDITION = st.recursive(
    _RELATION,
    lambda inner: _joined(
        st.tuples(st.sampled_from(["", "not "]), inner.map(lambda text: f"({text})") | _RELATION)
        .map("".join),
        [" and ", " or "],
    ),
    max_leaves=8,
)  # fmt: skip


@given(_CONDITION)
def test_conditions_mean_what_they_mean_in_python(text: str) -> None:
    node = python.parse(text, mode="eval").body
    assert value(lambda: ours(expression(text))) == value(lambda: theirs(node))


def test_every_node_knows_the_text_it_came_from() -> None:
    text = "model m\nlet y = -mu*N*sgn(s - [a,\n  b]).x + (if p < 0 then x[i+1] else R^2)/2\n"
    source = Source("m.di", text)
    (statement,) = parse(source).statements
    assert isinstance(statement, ast.LetDeclaration)
    assert source.slice(statement.span) == text[8:-1]
    assert source.slice(statement.value.span) == text[16:-1]
    total = statement.value
    assert isinstance(total, Call)
    first, second = (source.slice(term.span) for term in total.args)
    assert first == "-mu*N*sgn(s - [a,\n  b]).x"
    assert second == "(if p < 0 then x[i+1] else R^2)/2"
    for node in walk(statement.value):
        if isinstance(node, Name):
            assert source.slice(node.span) == node.id


def test_a_sum_of_thousands_of_terms_is_one_flat_node() -> None:
    tree = expression("a" + " - b" * 5000)
    assert isinstance(tree, Call)
    assert len(tree.args) == 5001


@pytest.mark.parametrize(
    "text",
    ["*".join("a" * 66), "^".join("a" * 66), "(" * 65 + "a" + ")" * 65, "-" * 65 + "a",
     "not " * 65 + "a", "if a then b else " * 65 + "c", "a" + "[1]" * 65, "f(" * 65 + ")" * 65,
     "(" * 40 + "a + b" + " + b)" * 40, "a" + ".x" * 65],
)  # fmt: skip
def test_a_deep_tree_is_refused(text: str) -> None:
    assert refused(text) == {"NS011"}


@pytest.mark.parametrize(
    "text",
    ["*".join("a" * 64), "(" * 63 + "a" + ")" * 63, "a" + "[1]" * 63, "-(" * 31 + "a" + ")" * 31],
)
def test_a_tree_at_the_limit_is_accepted(text: str) -> None:
    expression(text)


@pytest.mark.parametrize(
    "text",
    ["a < b < c", "a == b == c", "a if b else c", "a b", "2(a)", "(a)(b)", "a.1", "a + + b", "+a",
     "a**b", "[]", "()", "f(,)", "f(a,)", "a[]", "a[1, 2]", "a {m} + b", "1 +", "if a then b",
     "1 + if a then b else c", "not", "a not b", "a..b", "x[1..2]", "sum(a)", "sum(i: a)"],
)  # fmt: skip
def test_what_is_not_in_the_language_is_a_syntax_error(text: str) -> None:
    assert refused(text) == {"NS001"}


@pytest.mark.parametrize(
    "text", ["010", "00", "00.5", "0x1F", "1.2.3", "1e", "1e+", "2x", "1_000", "1e309", "1e-320",
             "1e1000000000", "0.0001e-400", "2.x", "9" * 400]
)  # fmt: skip
def test_a_malformed_number_is_refused(text: str) -> None:
    assert "NS003" in refused(text)


@pytest.mark.parametrize(
    ("text", "value"), [("0", 0), ("0.0", 0), ("0e9", 0), ("0.5", 0.5), ("1e308", 1e308),
                        ("2.5e-308", 2.5e-308), ("0e-999", 0), ("9" * 300, float("9" * 300))]
)  # fmt: skip
def test_a_sound_number_is_the_nearest_double(text: str, value: float) -> None:
    assert expression(text) == Number(float(value))
