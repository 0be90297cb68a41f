"""The hypotheses of Section 4.4: where a set-valued term may stand, and beside what."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from nsode.diagnostics import Diagnostic, Label, ModelError, refuse
from nsode.expr import Call, Expr, If, Name, names, walk
from nsode.ode import Binding, LinearSolve, SetValuedTerm


class Reads(NamedTuple):
    """What a value depends on, through bindings."""

    state: bool = False
    dio: bool = False
    sgn: bool = False

    def __or__(self, other: Reads) -> Reads:
        return Reads(self.state or other.state, self.dio or other.dio, self.sgn or other.sgn)


_NOTHING = Reads()


@dataclass(slots=True)
class Hypotheses:
    """Checks terms and rates against what is known of the names that they read."""

    reads: dict[str, Reads]
    bindings: dict[str, Binding] = field(default_factory=dict)
    _jump: dict[str, Expr | None] = field(default_factory=dict)
    _degree: dict[str, bool] = field(default_factory=dict)

    def of(self, *exprs: Expr) -> Reads:
        """Return what expressions depend on."""
        found = _NOTHING
        for expr in exprs:
            for name in names(expr):
                found |= self.reads.get(name.id, _NOTHING)
        return found

    def add(self, item: Binding | LinearSolve | SetValuedTerm) -> None:
        """Take in a definition whose names are all known."""
        match item:
            case Binding(name, value):
                self.bindings[name] = item
                self.reads[name] = self.of(value)
            case LinearSolve(unknowns, matrix, right):
                found = self.of(*right, *(entry for row in matrix for entry in row))
                self.reads.update(dict.fromkeys(unknowns, found))
            case SetValuedTerm():
                self.check_argument(item)
                found = Reads(True, item.kind == "dio", item.kind == "sgn")
                if item.factor is not None:
                    self.check_factor(item, item.factor)
                    found |= self.of(item.factor)
                self.reads.update(dict.fromkeys(item.multiplier, found))

    def check_argument(self, term: SetValuedTerm) -> None:
        """Refuse an argument that is no continuous function of the states.

        Raises
        ------
        ModelError
            NS204 if it depends on a set-valued term, NS207 if it jumps.
        """
        for expr in term.argument:
            for name in names(expr):
                found = self.reads.get(name.id, _NOTHING)
                if found.dio or found.sgn:
                    raise refuse(
                        "NS204",
                        f"the argument of `{term.kind}` depends on a set-valued term",
                        name.span,
                        "through this name",
                        help="the gap or the sliding velocity is a function of the states alone",
                    )
            self._check_continuous(expr, "NS207", f"the argument of `{term.kind}` jumps", term)

    def check_factor(self, term: SetValuedTerm, factor: Expr) -> None:
        """Refuse a factor that depends on sgn or jumps with the states.

        Raises
        ------
        ModelError
            NS202.
        """
        for name in names(factor):
            if self.reads.get(name.id, _NOTHING).sgn:
                raise refuse(
                    "NS202",
                    "the factor of `sgn` depends on another `sgn`",
                    name.span,
                    "set valued itself",
                    help="the method allows `dio` in a factor, and nothing else that jumps",
                )
        self._check_continuous(factor, "NS202", "the factor of `sgn` jumps", term)

    def _check_continuous(self, expr: Expr, code: str, message: str, term: SetValuedTerm) -> None:
        jump = self._find_jump(expr)
        if jump is None:
            return
        labels = [Label(jump.span, "it jumps here")]
        if not (term.span.start <= jump.span.start < term.span.end):
            labels.append(Label(term.span, "and is used here"))
        raise ModelError(
            [
                Diagnostic(
                    code,
                    message,
                    tuple(labels),
                    notes=("the approximation needs continuous functions of the states",),
                    help="use `max`, `min` or `abs`, or an `if` on `t` alone",
                )
            ]
        )

    def _find_jump(self, expr: Expr) -> Expr | None:
        for node in walk(expr):
            match node:
                case Call("mod", _):
                    return node
                case If(condition) if self.of(condition).state:
                    return node
                case Name(id) if id in self.bindings:
                    if id not in self._jump:
                        self._jump[id] = self._find_jump(self.bindings[id].value)
                    if self._jump[id] is not None:
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
                    raise _nonlinear(expr, "a product of two set-valued terms")
                return any(found)
            case Call("/", (left, right)):
                if self._linear(right):
                    raise _nonlinear(right, "a set-valued term in a denominator")
                return self._linear(left)
            case If(condition, then, otherwise):
                if self._linear(condition):
                    raise _nonlinear(condition, "a set of values cannot be compared")
                return any([self._linear(then), self._linear(otherwise)])
            case Call(function, args):
                if any([self._linear(arg) for arg in args]):
                    raise _nonlinear(expr, f"`{function}` of a set-valued term")
                return False
        return self.of(expr).sgn

    def _linear_name(self, id: str) -> bool:
        if not self.reads.get(id, _NOTHING).sgn:
            return False
        if id not in self._degree:
            self._degree[id] = True
            if id in self.bindings:
                self._degree[id] = self._linear(self.bindings[id].value)
        return self._degree[id]


def base_reads(states: Iterable[str]) -> dict[str, Reads]:
    """Return what is known before any binding: states are states."""
    return {name: Reads(state=True) for name in states}


def _nonlinear(expr: Expr, label: str) -> ModelError:
    return refuse(
        "NS203",
        "`sgn` must appear linearly",
        expr.span,
        label,
        help="a set-valued term may be added and multiplied by single-valued factors only",
    )
