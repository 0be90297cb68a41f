"""The course of stage 2, from the statements of a model to its differential inclusion.

Every name is taken first. Then come declarations, which need constants alone; lets, forces
and the terms in them, each behind what it reads; equations and settings, which may read
anything. What they amount to is put together, checked against the hypotheses of the
method, and for units.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import chain

from nsode.diagnostics import Diagnostic
from nsode.inclusion.assemble import Pieces, assemble
from nsode.inclusion.declare import declare
from nsode.inclusion.definitions import Definitions
from nsode.inclusion.elaborate import condition
from nsode.inclusion.elements import Elements, distinct
from nsode.inclusion.factors import with_proved_factors
from nsode.inclusion.hypotheses import check_hypotheses
from nsode.inclusion.indices import index_range
from nsode.inclusion.names import take_names
from nsode.inclusion.outputs import output
from nsode.inclusion.remarks import divided_factors, unused_names
from nsode.inclusion.report import Report
from nsode.inclusion.review import Review
from nsode.inclusion.rows import Rows
from nsode.inclusion.settings import Approximations, odd_duration, run
from nsode.inclusion.start import broken_assumptions, moving_starts
from nsode.inclusion.subscripts import check_subscripts
from nsode.inclusion.symbols import Scope, Symbols
from nsode.inclusion.units import check_units
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.ode import Check, DifferentialInclusion
from nsode.syntax import ast


def build(
    model: ast.Model, limits: Limits = DEFAULT_LIMITS
) -> tuple[DifferentialInclusion, tuple[Diagnostic, ...]]:
    """Return the differential inclusion of a model, with warnings and notes.

    Raises
    ------
    ModelError
        With every error that was found, in the order of the text.
    """
    symbols, review = Symbols(limits), Review(limits)
    report = Report(model.source, limits)
    model = take_names(model, symbols, report)
    pieces = _read(model, symbols, review, report)
    report.raise_errors()
    inclusion = report.needed(lambda: assemble(model, pieces))
    check_subscripts(inclusion, report)
    report.found.extend(moving_starts(inclusion, symbols))
    report.raise_errors()
    terms = check_hypotheses(inclusion, report)
    inclusion = with_proved_factors(inclusion, terms, report)
    inclusion, misfits = check_units(model, inclusion)
    report.found.extend(misfits)
    report.raise_errors()
    report.found.extend(broken_assumptions(inclusion))
    report.raise_errors()
    report.found.extend(unused_names(symbols))
    report.found.extend(divided_factors(inclusion))
    report.found.extend(odd_duration(inclusion.run))
    return inclusion, tuple(report.ordered())


def _read(model: ast.Model, symbols: Symbols, review: Review, report: Report) -> Pieces:
    """Return what the statements of a model amount to, one kind after the other."""
    declared = declare(model, symbols, review, report)
    definitions = Definitions(symbols, review, report)
    rows = Rows(symbols, review, definitions)
    report.each(definitions.let, model.all(ast.LetDeclaration))
    report.each(definitions.force, model.all(ast.ForceDeclaration))
    report.each(rows.hoist, model.all(ast.Equation))
    asked = report.each(definitions.hoisted, model.all(ast.OutputDeclaration))
    definitions.elaborate()
    scope = definitions.scope
    outputs = report.each(lambda one: output(one, scope, review), asked)
    rows.elaborate(report)
    report.each(lambda state: declared.initial(state, scope), model.all(ast.StateDeclaration))
    assumed = report.each(lambda one: _assumed(one, scope, review), model.all(ast.Assumption))
    elements = _elements(definitions, model, review, report)
    hints = report.each(lambda one: run(one, scope, review), [model.all(ast.SimulateStatement)])
    return Pieces(
        declared,
        definitions,
        rows,
        elements,
        tuple(chain.from_iterable(outputs)),
        (*declared.checks, *assumed),
        *hints,
    )


def _assumed(statement: ast.Assumption, scope: Scope, review: Review) -> Check:
    """``assume a >= b``, or ``for i in 1..n: assume a[i] >= b``."""
    over = index_range(statement.range, scope)
    holds = condition(statement.condition, scope.with_index(over))
    review.check(holds)
    return Check("assume", holds, over, span=statement.condition.span)


def _elements(
    definitions: Definitions, model: ast.Model, review: Review, report: Report
) -> Elements:
    """Return the distinct elements, with what the model says of their approximation."""
    found = distinct(definitions.terms, definitions.inline, definitions.bindings.values())
    report.found.extend(found.notes)
    said = Approximations(found.names, Scope(definitions.symbols, constants=True), review)
    report.each(said.add, model.all(ast.ApproximateStatement))
    terms = (replace(term, approximation=said.of(term)) for term in found.terms)
    return replace(found, terms=tuple(terms))
