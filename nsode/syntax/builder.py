"""What each rule of the grammar becomes; the methods are named like the rules."""

# ruff: noqa: D102 (the grammar says what each rule is)

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Transformer, v_args

from nsode.diagnostics import refuse
from nsode.expr import Call, Expr, If, Name, Number
from nsode.source import NOWHERE, Span
from nsode.syntax import ast
from nsode.syntax.tokens import Token
from nsode.syntax.words import RESERVED


def _identifier(token: Token) -> ast.Identifier:
    return ast.Identifier(token.text, span=token.span)


def _declared(token: Token) -> ast.Identifier:
    if token.text in RESERVED:
        message = f"`{token.text}` is a word of the language and cannot name anything else"
        way_out = f"for instance `{token.text}1`"
        raise refuse("NS103", message, token.span, "choose another name", help=way_out)
    return _identifier(token)


def _unit(token: Token | None) -> ast.Unit | None:
    return None if token is None else ast.Unit(token.text[1:-1].strip(), span=token.span)


def _from_to(first: Token | Expr, last: Token | Expr) -> Span:
    start = first.start if isinstance(first, Token) else first.span.start
    return Span(start, last.end if isinstance(last, Token) else last.span.end)


def _binary(function: str, left: Expr, right: Expr) -> Call:
    return Call(function, (left, right), span=Span(left.span.start, right.span.end))


@v_args(inline=True)
class Builder(Transformer[Any, Any]):
    """Builds the tree of one statement; ``statement`` is set to its span beforehand."""

    statement: Span = NOWHERE

    # declarations

    def model(self, name: Token) -> ast.Identifier:
        return _declared(name)

    def parameter(
        self, declarator: ast.Declarator, value: Expr, unit: Token | None, *bounds: ast.Bound
    ) -> ast.ParameterDeclaration:
        return ast.ParameterDeclaration(declarator, value, _unit(unit), bounds, span=self.statement)

    def constant(self, name: Token, value: Expr) -> ast.ConstantDeclaration:
        return ast.ConstantDeclaration(_declared(name), value, span=self.statement)

    def input(
        self,
        declarator: ast.Declarator,
        default: Expr | None,
        unit: Token | None,
        *bounds: ast.Bound,
    ) -> ast.InputDeclaration:
        return ast.InputDeclaration(declarator, default, _unit(unit), bounds, span=self.statement)

    def state(
        self, declarator: ast.Declarator, initial: Expr, unit: Token | None
    ) -> ast.StateDeclaration:
        return ast.StateDeclaration(declarator, initial, _unit(unit), span=self.statement)

    def let(
        self, declarator: ast.Declarator, value: Expr, unit: Token | None
    ) -> ast.LetDeclaration:
        return ast.LetDeclaration(declarator, value, _unit(unit), span=self.statement)

    def force(
        self, declarator: ast.Declarator, value: Expr, unit: Token | None
    ) -> ast.ForceDeclaration:
        return ast.ForceDeclaration(declarator, value, _unit(unit), span=self.statement)

    def output(
        self, declarator: ast.Declarator, value: Expr, unit: Token | None
    ) -> ast.OutputDeclaration:
        return ast.OutputDeclaration(declarator, value, _unit(unit), span=self.statement)

    def assume(self, condition: Expr) -> ast.Assumption:
        return ast.Assumption(condition, None, span=self.statement)

    def declarator(
        self,
        name: Token,
        family: tuple[ast.RangeSyntax, Token] | None,
        *sizes: tuple[Expr, Token],
    ) -> ast.Declarator:
        range_, end = family or (None, name)
        if sizes:
            end = sizes[-1][1]
        declared = _declared(name)
        span = name.span.to(end.span)
        return ast.Declarator(declared, range_, tuple(size for size, _ in sizes), span=span)

    def family(self, range_: ast.RangeSyntax, end: Token) -> tuple[ast.RangeSyntax, Token]:
        return range_, end

    def size(self, size: Expr, end: Token) -> tuple[Expr, Token]:
        return size, end

    def range(self, variable: Token, first: Expr, last: Expr) -> ast.RangeSyntax:
        return ast.RangeSyntax(
            _declared(variable),
            first,
            last,
            span=Span(variable.start, last.span.end),
        )

    def bound(self, relation: Token, value: Expr) -> ast.Bound:
        return ast.Bound(relation.text, value, span=_from_to(relation, value))

    # equations

    def equation(self, left: Expr, right: Expr) -> ast.Equation:
        return ast.Equation(left, right, None, span=self.statement)

    def for_each(
        self, range_: ast.RangeSyntax, each: ast.Equation | ast.Assumption
    ) -> ast.Equation | ast.Assumption:
        return replace(each, range=range_)

    # approximation and run

    def approximate(
        self,
        target: tuple[ast.Identifier, ...] | str,
        law: ast.Identifier | None,
        settings: tuple[ast.Setting | None, ...] | None,
    ) -> ast.ApproximateStatement:
        settings = settings or ()
        return ast.ApproximateStatement(
            () if isinstance(target, str) else target,
            target if isinstance(target, str) else None,
            law,
            tuple(s for s in settings if s is not None),
            None in settings,
            span=self.statement,
        )

    def elements(self, *names: Token) -> tuple[ast.Identifier, ...]:
        return tuple(map(_identifier, names))

    def default(self, kind: Token) -> str:
        if kind.text not in ("dio", "sgn"):
            message = f"`{kind.text}` is no kind of set-valued term"
            raise refuse("NS001", message, kind.span, "expected `dio` or `sgn`")
        return kind.text

    def law(self, name: Token) -> ast.Identifier:
        return _identifier(name)

    def settings(self, *settings: ast.Setting | None) -> tuple[ast.Setting | None, ...]:
        return settings

    def setting(self, name: Token, value: Expr, unit: Token | None) -> ast.Setting:
        end = value.span.end if unit is None else unit.end
        return ast.Setting(
            _identifier(name),
            value,
            _unit(unit),
            span=Span(name.start, end),
        )

    def equilibrium(self) -> None:
        return None

    def simulate(self, *settings: ast.Setting) -> ast.SimulateStatement:
        return ast.SimulateStatement(settings, span=self.statement)

    def duration(self, value: Expr, unit: Token | None) -> ast.Setting:
        end = value.span.end if unit is None else unit.end
        span = Span(value.span.start, end)
        return ast.Setting(
            ast.Identifier("duration", span=value.span), value, _unit(unit), span=span
        )

    def time_option(self, word: Token, value: Expr, unit: Token | None) -> ast.Setting:
        return self.setting(word, value, unit)

    def method(self, word: Token, name: Token) -> ast.Setting:
        return ast.Setting(_identifier(word), _identifier(name), None, span=_from_to(word, name))

    # expressions

    def conditional(self, if_: Token, condition: Expr, then: Expr, otherwise: Expr) -> If:
        return If(condition, then, otherwise, span=_from_to(if_, otherwise))

    def or_(self, left: Expr, right: Expr) -> Call:
        return _binary("or", left, right)

    def and_(self, left: Expr, right: Expr) -> Call:
        return _binary("and", left, right)

    def not_(self, word: Token, operand: Expr) -> Call:
        return Call("not", (operand,), span=_from_to(word, operand))

    def compare(self, left: Expr, relation: Token, right: Expr) -> Call:
        return _binary(relation.text, left, right)

    def addition(self, *terms: Expr) -> Call:
        return Call("+", terms, span=Span(terms[0].span.start, terms[-1].span.end))

    def plus(self, term: Expr) -> Expr:
        return term

    def negative(self, sign: Token, operand: Expr) -> Call:
        return Call("neg", (operand,), span=_from_to(sign, operand))

    minus = negative

    def multiply(self, left: Expr, right: Expr) -> Call:
        return _binary("*", left, right)

    def divide(self, left: Expr, right: Expr) -> Call:
        return _binary("/", left, right)

    def power_(self, base: Expr, exponent: Expr) -> Call:
        return _binary("^", base, exponent)

    def number(self, literal: Token) -> Number:
        return Number(float(literal.text), span=literal.span)

    def name(self, name: Token) -> Name:
        return Name(name.text, span=name.span)

    def call(self, function: Token, args: tuple[Expr, ...] | None, end: Token) -> Call:
        return Call(function.text, args or (), span=Span(function.start, end.end))

    def items(self, *items: Expr) -> tuple[Expr, ...]:
        return items

    def reduction(self, word: Token, range_: ast.RangeSyntax, body: Expr, end: Token) -> Expr:
        return ast.Reduction(range_, body, span=_from_to(word, end))

    def group(self, start: Token, inner: Expr, end: Token) -> ast.Group:
        return ast.Group(inner, span=_from_to(start, end))

    def bracket(self, start: Token, items: tuple[Expr, ...], end: Token) -> ast.Bracket:
        return ast.Bracket(items, span=Span(start.start, end.end))

    def subscript(self, base: Expr, index: Expr, end: Token) -> ast.Subscript:
        return ast.Subscript(base, index, span=_from_to(base, end))

    def component(self, base: Expr, field: Token) -> ast.Component:
        return ast.Component(base, field.text, span=_from_to(base, field))
