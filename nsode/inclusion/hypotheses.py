"""The hypotheses of Section 4.4: where a set-valued term may stand, and beside what.

Definitions are taken in order, so what is asked of a name is known when it is read:
nothing recurses through names, and the cost stays linear.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import chain
from typing import NamedTuple

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import Call, Expr, If, Name, names, walk
from nsode.inclusion.report import Report
from nsode.ode import Binding, DifferentialInclusion, LinearSolve, SetValuedTerm
from nsode.source import Span


class Reads(NamedTuple):
    """What a value depends on, through bindings; for terms, the place of one of them."""

    state: bool = False
    dio: Span | None = None
    sgn: Span | None = None

    def __or__(self, other: Reads) -> Reads:
        return Reads(self.state or other.state, self.dio or other.dio, self.sgn or other.sgn)


_NOTHING = Reads()


@dataclass(slots=True)
class Hypotheses:
    """Checks terms and rates against what is known of the names that they read."""

    reads: dict[str, Reads]
    _jump: dict[str, Expr | None] = field(default_factory=dict)
    _linear_in: dict[str, bool | ModelError] = field(default_factory=dict)

    def of(self, *exprs: Expr) -> Reads:
        """Return what expressions depend on."""
        found = _NOTHING
        for expr in exprs:
            for name in names(expr):
                found |= self.reads.get(name.id, _NOTHING)
        return found

    def add(self, item: Binding | LinearSolve | SetValuedTerm) -> None:
        """Take in a definition whose names are all known.

        Raises
        ------
        ModelError
            NS202, NS204 or NS207 for a set-valued term that the method cannot replace.
        """
        match item:
            case Binding(name, value):
                self.reads[name] = self.of(value)
                self._jump[name] = self._find_jump(value)
                self._linear_in[name] = self._try_linear(value)
            case LinearSolve(unknowns, matrix, right):
                found = self.of(*right, *(entry for row in matrix for entry in row))
                self.reads.update(dict.fromkeys(unknowns, found))
            case SetValuedTerm():
                place = item.span
                own = Reads(True, place) if item.kind == "dio" else Reads(True, None, place)
                if item.factor is not None:
                    own |= self.of(item.factor)
                self.reads.update(dict.fromkeys(item.multiplier, own))
                self._check_argument(item)
                if item.factor is not None:
                    self._check_factor(item, item.factor)

    def _check_argument(self, term: SetValuedTerm) -> None:
        for expr in term.argument:
            for name in names(expr):
                found = self.reads.get(name.id, _NOTHING)
                origin = found.sgn or found.dio
                if origin is not None:
                    raise _refused(
                        "NS204",
                        f"the argument of `{term.kind}` depends on a set-valued term",
                        _places(name.span, "through this name", origin, "the term"),
                        "the gap or the sliding velocity is a function of the states alone",
                    )
            self._check_continuous(expr, "NS207", f"the argument of `{term.kind}` jumps", term)

    def _check_factor(self, term: SetValuedTerm, factor: Expr) -> None:
        for name in names(factor):
            origin = self.reads.get(name.id, _NOTHING).sgn
            if origin is not None:
                raise _refused(
                    "NS202",
                    "the factor of `sgn` depends on another `sgn`",
                    _places(name.span, "set valued itself", origin, "by this `sgn`"),
                    "the method allows `dio` in a factor, and nothing else that jumps",
                )
        self._check_continuous(factor, "NS202", "the factor of `sgn` jumps", term)

    def _check_continuous(self, expr: Expr, code: str, message: str, term: SetValuedTerm) -> None:
        jump = self._find_jump(expr)
        if jump is None:
            return
        raise _refused(
            code,
            message,
            _places(jump.span, "it jumps here", term.span, "in this term"),
            "use `max`, `min` or `abs`, or an `if` on `t` alone",
            "the approximation needs continuous functions of the states",
        )

    def _find_jump(self, expr: Expr) -> Expr | None:
        for node in walk(expr):
            match node:
                case Call("mod", _):
                    return node
                case If(condition) if self.of(condition).state:
                    return node
                case Name(id) if self._jump.get(id) is not None:
                    return self._jump[id]
        return None

    def check_linear(self, expr: Expr) -> None:
        """Refuse a rate that is nonlinear in sgn.

        Raises
        ------
        ModelError
            NS203.
        """
        self._linear(expr)

    def check_matrix(self, solve: LinearSolve) -> None:
        """Refuse a mass matrix that depends on sgn.

        Raises
        ------
        ModelError
            NS203.
        """
        for entry in (entry for row in solve.matrix for entry in row):
            origin = self.of(entry).sgn
            if origin is not None:
                raise _nonlinear(entry, "a set-valued term multiplies a derivative", origin)

    def _try_linear(self, expr: Expr) -> bool | ModelError:
        """Keep a refusal until a rate reads the name: an output may be nonlinear in sgn."""
        try:
            return self._linear(expr)
        except ModelError as error:
            return error

    def _linear(self, expr: Expr) -> bool:
        """Return whether sgn stands in ``expr``, linearly."""
        match expr:
            case Name(id):
                return self._linear_name(id)
            case Call("+", terms):
                return any([self._linear(term) for term in terms])
            case Call("neg", (inner,)):
                return self._linear(inner)
            case Call("*", (left, right)):
                found = [self._linear(left), self._linear(right)]
                if all(found):
                    raise self._refuse(expr, "a product of two set-valued terms")
                return any(found)
            case Call("/", (left, right)):
                if self._linear(right):
                    raise self._refuse(right, "a set-valued term in a denominator")
                return self._linear(left)
            case If(condition, then, otherwise):
                if self._linear(condition):
                    raise self._refuse(condition, "a set of values cannot be compared")
                return any([self._linear(then), self._linear(otherwise)])
            case Call(function, args):
                if any([self._linear(arg) for arg in args]):
                    raise self._refuse(expr, f"`{function}` of a set-valued term")
                return False
        return self.of(expr).sgn is not None

    def _linear_name(self, id: str) -> bool:
        found = self._linear_in.get(id, self.reads.get(id, _NOTHING).sgn is not None)
        if isinstance(found, ModelError):
            raise found
        return found

    def _refuse(self, expr: Expr, label: str) -> ModelError:
        origin = self.of(expr).sgn
        assert origin is not None
        return _nonlinear(expr, label, origin)


def check_hypotheses(inclusion: DifferentialInclusion, report: Report) -> list[SetValuedTerm]:
    """Report every term that the method cannot replace, and every rate it cannot take.

    Returns
    -------
    list of SetValuedTerm
        The terms that it can replace if their factors are nonnegative.
    """
    hypotheses = Hypotheses({state.name: Reads(state=True) for state in inclusion.states})
    sound: list[SetValuedTerm] = []
    for item in inclusion.bindings:
        with report.collecting():
            hypotheses.add(item)
            if isinstance(item, SetValuedTerm):
                sound.append(item)
    solves = [item for item in inclusion.bindings if isinstance(item, LinearSolve)]
    report.each(hypotheses.check_matrix, solves)
    rights = chain.from_iterable(solve.right for solve in solves)
    report.each(hypotheses.check_linear, [*rights, *(rate.value for rate in inclusion.rates)])
    return sound


def _nonlinear(expr: Expr, label: str, origin: Span) -> ModelError:
    way_out = "a set-valued term may be added and multiplied by single-valued factors only"
    places = _places(expr.span, label, origin, "and the term is here")
    return _refused("NS203", "`sgn` must appear linearly", places, way_out)


def _places(span: Span, text: str, other: Span, other_text: str) -> list[Label]:
    """Return one place, and another unless the two overlap."""
    apart = span.end <= other.start or other.end <= span.start
    return [Label(span, text), *([Label(other, other_text)] if apart else [])]


def _refused(code: str, message: str, labels: list[Label], way_out: str, *notes: str) -> ModelError:
    return ModelError([Diagnostic(code, message, tuple(labels), notes, way_out)])
