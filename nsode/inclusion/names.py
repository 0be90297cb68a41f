"""Every name of a model is taken before anything is read, so that order does not matter."""

from __future__ import annotations

from dataclasses import replace

from nsode.inclusion.report import Report
from nsode.inclusion.symbols import Symbols
from nsode.syntax import ast


def take_names(model: ast.Model, symbols: Symbols, report: Report) -> ast.Model:
    """Return the model without the statements that declare a name reserved or given twice."""

    def taken(statement: ast.Statement) -> ast.Statement:
        name = _declared(statement)
        if name is not None:
            symbols.declare(name.text, name.span)
        return statement

    return replace(model, statements=tuple(report.each(taken, model.statements)))


def _declared(statement: ast.Statement) -> ast.Identifier | None:
    match statement:
        case ast.ConstantDeclaration(name):
            return name
        case (
            ast.ParameterDeclaration(declarator)
            | ast.InputDeclaration(declarator)
            | ast.StateDeclaration(declarator)
            | ast.LetDeclaration(declarator)
            | ast.ForceDeclaration(declarator)
            | ast.OutputDeclaration(declarator)
        ):
            return declarator.name
    return None
