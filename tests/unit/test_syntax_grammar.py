"""The grammar file, the scanner and the builder say the same language."""

from __future__ import annotations

from pathlib import Path

import pytest
from lark import Lark

from nsode.limits import DEFAULT_LIMITS
from nsode.source import Source
from nsode.syntax.builder import Builder
from nsode.syntax.parser import Parser, grammar, parser
from nsode.syntax.scanner import scan
from nsode.syntax.words import KEYWORDS, STATEMENT_KEYWORDS

MODELS = sorted((Path(__file__).parents[2] / "models").glob("*.di"))

MORE = """model m
constant n = 10
parameter mu = .3 {1} >= 0 < 1.
parameter c[3] = [1, 2e3, 3.5E-2]
input u[2] = [0, 0] {N/m^2} >= 0
input w
state x[i in 1..n] = 0.02*i
state p[i in 1..n][2] = [0, 1]
let f = if t < 2 and not (t == 1 or t != 0) then -2^-3 else 1/2*sum(i in 1..n: x[i + 1])
force N[i in 0..n] = dio((if i < n then x[i+1] else 1) - (if i > 0 then x[i] else 0) - 2--p.x)
for i in 1..n-1: 2*der(x[i]) = R[1][2]*sgn(s).x - cross([0, 0, 1],
    [1, 2, 3])  # and so on
assume x >= mod(w, 2)
for assumed in 1..n: assume x[assumed] > 0 and not x[assumed] < w
approximate N, F with lugre: K = 1e5 {N/m}, step = 2, at equilibrium
approximate default sgn: beta = 4e-3
simulate 4 {s} every 0.01 step 1e-3 {s} method rk4
"""


def test_is_lalr_without_any_conflict() -> None:
    pytest.importorskip("interegular")
    Lark(grammar(), start="statement", parser="lalr", lexer="contextual", strict=True)


def test_every_rule_has_a_builder_and_every_builder_a_rule() -> None:
    callbacks = {
        rule.alias or rule.origin.name
        for rule in Lark(grammar(), start="statement", parser="lalr").rules
        if not rule.origin.name.startswith("_") and (rule.alias or not rule.options.expand1)
    }
    methods = {name for name in vars(Builder) if not name.startswith("_") and name != "statement"}
    assert methods == {name for name in callbacks if not name.startswith("_")}


def test_the_reserved_words_are_those_of_the_grammar() -> None:
    assert set(Parser().vocabulary.keywords) == KEYWORDS


def test_the_words_that_begin_a_statement_are_those_of_the_grammar() -> None:
    texts = parser().vocabulary.texts
    choices = parser().lark.parse_interactive().choices()
    words = {texts[name] for name in choices if name in texts and texts[name].isalpha()}
    assert words - {"sum"} == set(STATEMENT_KEYWORDS)


@pytest.mark.parametrize("text", [*(m.read_text() for m in MODELS), MORE])
def test_cuts_a_text_like_larks_own_contextual_lexer(text: str) -> None:
    """Lark reads the terminals of the grammar by itself, and has its own idea of keywords."""
    oracle = Lark(grammar(), start="statement", parser="lalr", lexer="contextual")
    for statement in scan(Source("m.di", text), parser().vocabulary, DEFAULT_LIMITS):
        span = statement.span
        lexed = oracle.parse_interactive(text[span.start : span.end])
        theirs = [(token.type, str(token)) for token in lexed.exhaust_lexer()]
        state = parser().lark.parse_interactive()
        ours = []
        for token in statement.tokens:
            token = parser().as_keyword(token, state)
            state.feed_token(token)
            ours.append((token.type, token.text))
        assert ours == theirs
