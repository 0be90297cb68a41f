"""Statements: what each becomes, where it ends, and how the text is read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from nsode.diagnostics import ModelError
from nsode.expr import Call, Name, Number
from nsode.limits import Limits
from nsode.source import Source
from nsode.syntax import ast, decode, parse, read


def statement(text: str) -> ast.Statement:
    (only,) = parse(Source("m.di", f"model m\n{text}\n")).statements
    return only


def codes(text: str, limits: Limits | None = None) -> list[str]:
    with pytest.raises(ModelError) as caught:
        parse(Source("m.di", text), limits or Limits())
    assert caught.value.source is not None
    return [diagnostic.code for diagnostic in caught.value.diagnostics]


def declarator(
    name: str, range: ast.RangeSyntax | None = None, *sizes: float | Name
) -> ast.Declarator:
    return ast.Declarator(
        ast.Identifier(name),
        range,
        tuple(s if isinstance(s, Name) else Number(float(s)) for s in sizes),
    )


ONE, TWO, N = Number(1.0), Number(2.0), Name("n")
I_TO_N = ast.RangeSyntax(ast.Identifier("i"), ONE, N)
DER = Call("der", (Name("x"),))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("parameter M = 1", ast.ParameterDeclaration(declarator("M"), ONE, None, ())),
        (
            "parameter mu = 1 {m/s} >= 0 < 2",
            ast.ParameterDeclaration(
                declarator("mu"),
                ONE,
                ast.Unit("m/s"),
                (ast.Bound(">=", Number(0.0)), ast.Bound("<", TWO)),
            ),
        ),
        ("constant n = 2", ast.ConstantDeclaration(ast.Identifier("n"), TWO)),
        ("input u", ast.InputDeclaration(declarator("u"), None, None, ())),
        (
            "input u[2] = 1 { N } > 1",
            ast.InputDeclaration(
                declarator("u", None, 2), ONE, ast.Unit("N"), (ast.Bound(">", ONE),)
            ),
        ),
        (
            "state p[i in 1..n][2] = 1",
            ast.StateDeclaration(declarator("p", I_TO_N, 2), ONE, None),
        ),
        ("state R[2][n] = 1", ast.StateDeclaration(declarator("R", None, 2, N), ONE, None)),
        ("let y[i in 1..n] = 2", ast.LetDeclaration(declarator("y", I_TO_N), TWO, None)),
        ("force F = 2 {N}", ast.ForceDeclaration(declarator("F"), TWO, ast.Unit("N"))),
        ("output d = 2", ast.OutputDeclaration(declarator("d"), TWO, None)),
        ("assume x >= n", ast.Assumption(Call(">=", (Name("x"), N)), None)),
        ("for i in 1..n: assume x >= n", ast.Assumption(Call(">=", (Name("x"), N)), I_TO_N)),
        ("der(x) = 1", ast.Equation(DER, ONE, None)),
        ("for i in 1..n: der(x) = 1", ast.Equation(DER, ONE, I_TO_N)),
        (
            "approximate A, B with lugre: K = 1 {N/m}, step = 2, at equilibrium",
            ast.ApproximateStatement(
                (ast.Identifier("A"), ast.Identifier("B")),
                None,
                ast.Identifier("lugre"),
                (
                    ast.Setting(ast.Identifier("K"), ONE, ast.Unit("N/m")),
                    ast.Setting(ast.Identifier("step"), TWO, None),
                ),
                True,
            ),
        ),
        (
            "approximate default dio: K = 2",
            ast.ApproximateStatement(
                (), "dio", None, (ast.Setting(ast.Identifier("K"), TWO, None),), False
            ),
        ),
        (
            "approximate A with lugre",
            ast.ApproximateStatement(
                (ast.Identifier("A"),), None, ast.Identifier("lugre"), (), False
            ),
        ),
        (
            "simulate 2 {s} method rk4 step 1 every n {s}",
            ast.SimulateStatement(
                (
                    ast.Setting(ast.Identifier("duration"), TWO, ast.Unit("s")),
                    ast.Setting(ast.Identifier("method"), ast.Identifier("rk4"), None),
                    ast.Setting(ast.Identifier("step"), ONE, None),
                    ast.Setting(ast.Identifier("every"), N, ast.Unit("s")),
                )
            ),
        ),
    ],
)
def test_builds_the_statement(text: str, expected: ast.Statement) -> None:
    assert statement(text) == expected


def test_the_span_of_a_declarator_ends_with_its_last_bracket() -> None:
    source = Source("m.di", "model m\nstate p[ i in 1..n ] [ 2 ] = 0 # c\nlet q [i in 1 ..n ]=1")
    first, second = parse(source).statements
    assert isinstance(first, ast.StateDeclaration)
    assert isinstance(second, ast.LetDeclaration)
    assert source.slice(first.declarator.span) == "p[ i in 1..n ] [ 2 ]"
    assert source.slice(first.span) == "state p[ i in 1..n ] [ 2 ] = 0"
    assert source.slice(second.declarator.span) == "q [i in 1 ..n ]"


def test_every_model_in_the_house_parses() -> None:
    for path in (Path(__file__).parents[2] / "models").glob("*.di"):
        assert parse(read(path)).name.text == path.stem


def test_a_newline_ends_a_statement_except_inside_brackets() -> None:
    text = "model m # one\n\n  let a = f(1,   # two\r\n\n  2)\r\nlet b = [1,\n2]\nlet c = 3"
    assert len(parse(Source("m.di", text)).statements) == 3


def test_comments_hold_any_text() -> None:
    text = "model m # ∀ε>0 ∃δ שלום \x00 ( [ {\n# 'x\nlet a = 1 #"
    assert len(parse(Source("m.di", text)).statements) == 1


def test_all_errors_of_a_text_come_at_once_in_order_of_place() -> None:
    text = (
        "model m\nlet = 1\nlet b = 2x\nlet c = (1\nlet d = )\nlet e = ž\nlet f = {m}\nlet g = 1\n"
    )
    assert codes(text) == ["NS001", "NS003", "NS004", "NS004", "NS002", "NS001"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "NS005"),
        (" \n\t\n", "NS005"),
        ("# c", "NS005"),
        ("let a = 1", "NS005"),
        ("let a = 1\nmodel m", "NS005"),
        ("model m\nmodel n", "NS102"),
        ("model", "NS006"),
        ("model 2m", "NS006"),
        ("model m n", "NS006"),
        ("model m(", "NS006"),
        ("model _m", "NS006"),
        ("model state", "NS103"),
        ("model " + "m" * 65, "NS010"),
        ('model m\ninclude "f"', "NS007"),
        ("model m\nimport f(", "NS007"),
        ("model m\nuse 'f", "NS007"),
        ("model m\nlet use = 1", "NS103"),
        ("model m\nlet if = 1", "NS103"),
        ("model m\nfor in in 1..2: der(x) = 1", "NS103"),
        ("model m\nlet a = sum(step in 1..2: 1)", "NS103"),
        ("model m\nlet _a = 1", "NS006"),
        ("model m\nlet a = (1]", "NS004"),
        ("model m\nlet a = 1 {m", "NS004"),
        ("model m\nlet a = 1 {m;}", "NS008"),
        ("model m\nlet a = 1 {}", "NS008"),
        ("model m\nlet a = 1 {m.s}", "NS008"),
        ("model m\rlet a = 1", "NS002"),
        ("model m\nlet a =\f1", "NS002"),
        ("model m\nlet a = 1;", "NS001"),
        ("model m\nlet " + "a" * 65 + " = 1", "NS010"),
    ],
)
def test_refuses_with_one_error(text: str, code: str) -> None:
    assert codes(text) == [code]


@pytest.mark.parametrize("unit", ["N/m", "kg*m/s^2", "1", "rad/s", "m^-2", "(N*s)/m", "0.5 kg"])
def test_accepts_a_unit(unit: str) -> None:
    tree = statement(f"let a = 1 {{ {unit} }}")
    assert isinstance(tree, ast.LetDeclaration)
    assert tree.unit == ast.Unit(unit)


def test_each_limit_can_be_raised() -> None:
    name, deep = "a" * 100, "(" * 99 + "1" + ")" * 99
    text = f"model m\nlet {name} = {deep}\n"
    assert set(codes(text)) == {"NS010", "NS011"}
    assert codes(text, Limits(size=len(text) - 1)) == ["NS012"]
    parse(Source("m.di", text), Limits(name=100, depth=100))


# reading


def problem(path: Path | str, limits: Limits | None = None) -> str:
    with pytest.raises(ModelError) as caught:
        read(path, limits or Limits())
    (diagnostic,) = caught.value.diagnostics
    return diagnostic.code


def test_reads_a_file_with_or_without_a_byte_order_mark(tmp_path: Path) -> None:
    for mark in (b"", b"\xef\xbb\xbf"):
        path = tmp_path / "m.di"
        path.write_bytes(mark + "model m # é\r\n".encode())
        assert read(path) == Source(str(path), "model m # é\r\n")


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_names_the_byte_that_is_not_utf8(mark: bytes) -> None:
    with pytest.raises(ModelError, match=rf"byte {11 + len(mark)} \(0xe9\)") as caught:
        decode("m.di", mark + b"model m\n# x\xe9")
    assert "m.di:2:4" in str(caught.value)


def test_refuses_what_is_no_readable_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    assert problem(tmp_path / "missing.di") == "NS601"
    assert problem(tmp_path) == "NS601"
    assert problem(tmp_path / "pipe") == "NS601"
    assert problem("/dev/zero") == "NS601"
    assert problem("a\0b") == "NS601"
    assert problem("x" * 5000) == "NS601"


def test_refuses_a_large_file_without_reading_it_all(tmp_path: Path) -> None:
    path = tmp_path / "large.di"
    with path.open("wb") as file:
        file.truncate(1 << 40)
    assert problem(path) == "NS012"
