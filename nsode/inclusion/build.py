"""The course of stage 2: declare, hoist, elaborate, share, solve, check, put in order."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from nsode.diagnostics import Diagnostic, refuse
from nsode.expr import Index, Name, names
from nsode.inclusion.declare import Declarations
from nsode.inclusion.definitions import Definitions
from nsode.inclusion.elaborate import condition, elaborate, number
from nsode.inclusion.elements import Elements, distinct, rename, rename_definition
from nsode.inclusion.factors import prove_factor, prover_of
from nsode.inclusion.fitting import declared_shape, fitted
from nsode.inclusion.hypotheses import Hypotheses, base_reads
from nsode.inclusion.indices import index_range
from nsode.inclusion.order import loop, order
from nsode.inclusion.remarks import divided_factors, unused_names
from nsode.inclusion.report import Report
from nsode.inclusion.review import Review
from nsode.inclusion.rows import Rows
from nsode.inclusion.settings import Approximations, run
from nsode.inclusion.sharing import Numbering
from nsode.inclusion.solving import solve
from nsode.inclusion.start import broken_assumptions, moving_starts
from nsode.inclusion.subscripts import Bounds, ranges
from nsode.inclusion.symbols import Scope, Symbols
from nsode.inclusion.units import check_units, in_si
from nsode.inclusion.values import each, scalars, shape, suffixes
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.ode import (
    Check,
    Definition,
    DifferentialInclusion,
    LinearSolve,
    Output,
    Placed,
    Rate,
    Run,
    SetValuedTerm,
    State,
    defined,
    expressions,
)
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
    course = _Course(model, limits)
    course.declare()
    course.define()
    course.equations()
    course.report.raise_errors()
    with course.report.collecting():
        inclusion = course.assemble()
    course.report.raise_errors()
    course.check(inclusion)
    inclusion = replace(inclusion, checks=tuple(course.checks))
    inclusion, misfits = check_units(model, inclusion)
    course.report.found.extend(misfits)
    course.report.raise_errors()
    course.report.found.extend(broken_assumptions(inclusion))
    course.report.raise_errors()
    course.remark(inclusion)
    return inclusion, tuple(course.report.ordered())


@dataclass(slots=True)
class _Course:
    model: ast.Model
    limits: Limits
    symbols: Symbols = field(init=False)
    review: Review = field(init=False)
    report: Report = field(init=False)
    declared: Declarations = field(init=False)
    definitions: Definitions = field(init=False)
    rows: Rows = field(init=False)
    elements: Elements = field(init=False)
    outputs: list[Output] = field(default_factory=list)
    checks: list[Check] = field(default_factory=list)
    hints: Run = field(default_factory=Run)

    def __post_init__(self) -> None:
        self.symbols = Symbols(self.limits)
        self.review = Review(self.limits)
        self.report = Report(self.model.source, self.limits)
        self.declared = Declarations(self.symbols, self.review)
        self.definitions = Definitions(self.symbols, self.review, self.report)

    @property
    def scope(self) -> Scope:
        return Scope(self.symbols)

    def declare(self) -> None:
        """Take every name, then the items that need no other names than constants."""
        accepted: list[ast.Statement] = []
        for statement in self.model.statements:
            with self.report.collecting():
                self._take_name(statement)
                accepted.append(statement)
        self.model = replace(self.model, statements=tuple(accepted))
        constants = [s for s in self.model.statements if isinstance(s, ast.ConstantDeclaration)]
        self.declared.constants(constants, self.report)
        for statement in self.model.statements:
            with self.report.collecting():
                match statement:
                    case ast.ParameterDeclaration():
                        self.declared.parameter(statement)
                    case ast.InputDeclaration():
                        self.declared.input(statement)
                    case ast.StateDeclaration():
                        self.declared.state(statement)

    def _take_name(self, statement: ast.Statement) -> None:
        match statement:
            case ast.ConstantDeclaration(name):
                self.symbols.declare(name.text, name.span)
            case (
                ast.ParameterDeclaration(declarator)
                | ast.InputDeclaration(declarator)
                | ast.StateDeclaration(declarator)
                | ast.LetDeclaration(declarator)
                | ast.ForceDeclaration(declarator)
                | ast.OutputDeclaration(declarator)
            ):
                self.symbols.declare(declarator.name.text, declarator.name.span)

    def define(self) -> None:
        """Lets, forces and inline terms; then which terms are one element."""
        self.rows = Rows(self.symbols, self.review, self.definitions)
        waiting: list[ast.OutputDeclaration] = []
        for statement in self.model.statements:
            with self.report.collecting():
                match statement:
                    case ast.LetDeclaration():
                        self.definitions.let(statement)
                    case ast.ForceDeclaration():
                        self.definitions.force(statement)
                    case ast.Equation():
                        self.rows.hoist(statement)
                    case ast.OutputDeclaration(declarator, value):
                        hoisted = self.definitions.hoister.hoist(value, declarator.range)
                        waiting.append(replace(statement, value=hoisted))
        self.definitions.elaborate()
        for output in waiting:
            with self.report.collecting():
                self._output(output)
        numbering = Numbering()
        for binding in self.definitions.bindings:
            numbering.add(binding)
        found = distinct(self.definitions.terms, self.definitions.inline, numbering)
        self.elements = found
        for note in found.notes:
            self.report.add(note)

    def _output(self, output: ast.OutputDeclaration) -> None:
        over = index_range(output.declarator.range, self.scope)
        value = each(number, elaborate(output.value, self.scope.with_index(over)))
        sizes = declared_shape(output.declarator, self.scope)
        value = fitted(value, over, sizes, output.declarator)
        self.review.check(value)
        name = output.declarator.name
        unit = None if output.unit is None else output.unit.text
        self.outputs.extend(
            Output(name.text + suffix, in_si(part, output.unit), over, unit, span=name.span)
            for suffix, part in zip(suffixes(shape(value)), scalars(value), strict=True)
        )

    def equations(self) -> None:
        """Equations, initial values, assumptions, approximations, runs."""
        self.rows.elaborate(self.report)
        scope = self.scope
        approximations = Approximations(
            self.elements.names, replace(scope, constants=True), self.review
        )
        hints: list[ast.SimulateStatement] = []
        for statement in self.model.statements:
            with self.report.collecting():
                match statement:
                    case ast.StateDeclaration():
                        self.declared.initial(statement, scope)
                    case ast.Assumption(written, syntax):
                        over = index_range(syntax, scope)
                        holds = condition(written, scope.with_index(over))
                        self.review.check(holds)
                        self.checks.append(Check("assume", holds, over, span=written.span))
                    case ast.ApproximateStatement():
                        approximations.add(statement)
                    case ast.SimulateStatement():
                        hints.append(statement)
        self.elements = replace(
            self.elements,
            terms=tuple(
                replace(term, approximation=approximations.of(term)) for term in self.elements.terms
            ),
        )
        with self.report.collecting():
            self.hints, remarks = run(hints, scope, self.review)
            self.report.found.extend(remarks)

    def assemble(self) -> DifferentialInclusion:
        """Put the pieces together, definitions in an order that computes."""
        names_of = self.elements.renamed
        solved, rates = solve(
            self.rows.rows,
            self.declared.states,
            self.declared.parameters,
            self.definitions.bindings,
        )
        bindings: list[Definition] = [*self.definitions.bindings, *self.rows.bindings.values()]
        bindings.extend(solved)
        if names_of:
            bindings = [rename_definition(item, names_of) for item in bindings]
            rates = [replace(rate, value=rename(rate.value, names_of)) for rate in rates]
            self.outputs = [replace(o, value=rename(o.value, names_of)) for o in self.outputs]
            self.checks = [replace(c, condition=rename(c.condition, names_of)) for c in self.checks]
        self.checks = [*self.declared.checks, *self.checks]
        return DifferentialInclusion(
            self.model.name.text,
            self.model.source,
            tuple(self.declared.states),
            tuple(self.declared.inputs),
            tuple(self.declared.parameters),
            tuple(_ordered([*self.elements.terms, *bindings, *self.elements.aliases])),
            tuple(_in_order_of_states(rates, self.declared.states)),
            (*self.outputs, *self._forces()),
            run=self.hints,
        )

    def _forces(self) -> Iterator[Output]:
        """Yield every force as an output, behind the declared ones."""
        for force in self.definitions.forces:
            symbol = self.symbols.known[force]
            at = None if symbol.range is None else Index(symbol.range.variable)
            for suffix in suffixes(symbol.shape):
                name = force + suffix
                value = Name(name, at, span=symbol.span)
                yield Output(name, value, symbol.range, symbol.unit, span=symbol.span)

    def check(self, inclusion: DifferentialInclusion) -> None:
        """Check subscripts, the hypotheses of the method, and the sign of each factor."""
        self._check_subscripts(inclusion)
        self.report.found.extend(moving_starts(inclusion, self.symbols))
        self.report.raise_errors()
        hypotheses = Hypotheses(base_reads(state.name for state in inclusion.states))
        prover = prover_of(inclusion, self.checks)
        for item in inclusion.bindings:
            with self.report.collecting():
                hypotheses.add(item)
                if isinstance(item, SetValuedTerm):
                    self.checks.extend(prove_factor(prover, item, inclusion.source))
        for item in inclusion.bindings:
            if isinstance(item, LinearSolve):
                with self.report.collecting():
                    hypotheses.check_matrix(item)
                for expr in item.right:
                    with self.report.collecting():
                        hypotheses.check_linear(expr)
        for rate in inclusion.rates:
            with self.report.collecting():
                hypotheses.check_linear(rate.value)

    def _check_subscripts(self, inclusion: DifferentialInclusion) -> None:
        items: list[Placed] = [*inclusion.states, *inclusion.inputs, *inclusion.parameters]
        families = ranges(items)
        for item in inclusion.bindings:
            if item.range is not None:
                families |= dict.fromkeys(defined(item), item.range)
        bounds = Bounds(families)
        for definition in inclusion.bindings:
            with self.report.collecting():
                bounds.check(expressions(definition), definition.range)
                if isinstance(definition, SetValuedTerm):
                    bounds.check((value for _, value in definition.approximation.constants), None)
        for rate in inclusion.rates:
            with self.report.collecting():
                bounds.check([rate.value], rate.range)
        for output in inclusion.outputs:
            with self.report.collecting():
                bounds.check([output.value], output.range)
        for state in inclusion.states:
            with self.report.collecting():
                bounds.check([state.initial], state.range)
        for check in self.checks:
            with self.report.collecting():
                bounds.check([check.condition], check.range)

    def remark(self, inclusion: DifferentialInclusion) -> None:
        """Say what is no error and yet worth saying."""
        self.report.found.extend(unused_names(self.symbols))
        parameters = {parameter.name for parameter in inclusion.parameters}
        self.report.found.extend(divided_factors(inclusion.terms, parameters))


def _ordered(items: Sequence[Definition]) -> list[Definition]:
    """Sort definitions so that each stands behind what it reads."""
    owner = {name: k for k, item in enumerate(items) for name in defined(item)}
    keys = sorted(range(len(items)), key=lambda k: items[k].span)
    reads = {
        k: {owner[n.id] for expr in expressions(items[k]) for n in names(expr) if n.id in owner}
        for k in keys
    }
    found = order(keys, reads)
    if len(found) < len(keys):
        first = items[loop(keys, reads)[0]]
        raise refuse(
            "NS106",
            "a derivative depends on itself",
            first.span,
            "in a loop with other definitions",
            help="solve the loop by hand",
        )
    return [items[k] for k in found]


def _in_order_of_states(rates: Sequence[Rate], states: Sequence[State]) -> list[Rate]:
    rank = {state.name: k for k, state in enumerate(states)}
    return sorted(rates, key=lambda r: (rank[r.state], r.range.first if r.range else 0))
