"""``approximate`` and ``simulate``: constants of the laws and defaults of a run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from nsode.diagnostics import Diagnostic, Label, ModelError, quoted, refuse, suggest
from nsode.evaluate import evaluate
from nsode.expr import Expr, Number, names
from nsode.inclusion.definitions import written_names
from nsode.inclusion.elaborate import scalar
from nsode.inclusion.report import PoisonedError, each
from nsode.inclusion.review import Review
from nsode.inclusion.symbols import Scope
from nsode.inclusion.units import in_si
from nsode.ode import Approximation, Run, SetValuedTerm
from nsode.source import Span
from nsode.syntax.ast import ApproximateStatement, Identifier, Setting, SimulateStatement

#: Wishes, as opposed to constants of a law.
TARGETS = (
    "restitution",
    "impact_speed",
    "penetration",
    "effective_mass",
    "presliding",
    "damping_ratio",
)


@dataclass(slots=True)
class Approximations:
    """What the model says of each element; ``elements`` maps every name of one to its own."""

    elements: Mapping[str, SetValuedTerm]
    scope: Scope
    review: Review
    _own: dict[str, tuple[Approximation, Identifier]] = field(default_factory=dict)
    _defaults: dict[str, tuple[Approximation, Span]] = field(default_factory=dict)

    def add(self, statement: ApproximateStatement) -> None:
        """Take in one statement.

        Raises
        ------
        ModelError
            NS304 for a name that is no element, NS305 for an element approximated twice.
        """
        approximation = self._approximation(statement)
        if statement.default is not None:
            known = self._defaults.setdefault(statement.default, (approximation, statement.span))
            if known[0] is not approximation:
                message = f"the default of `{statement.default}` is given twice"
                raise _twice(message, statement.span, known[1])
        each(lambda name: self._store(name, approximation), statement.elements)

    def of(self, term: SetValuedTerm) -> Approximation:
        """Return the approximation of an element: its own, its kind's, or the default."""
        if term.name in self._own:
            return self._own[term.name][0]
        return self._defaults[term.kind][0] if term.kind in self._defaults else Approximation()

    def _store(self, name: Identifier, new: Approximation) -> None:
        known, first = self._own.setdefault(self._element(name).name, (new, name))
        if known is new and (first is name or first.text != name.text):
            return
        message = f"`{name.text}` is approximated twice"
        if first.text != name.text:
            message = f"`{name.text}` and `{first.text}` are one element, approximated twice"
        raise _twice(message, name.span, first.span)

    def _element(self, name: Identifier) -> SetValuedTerm:
        if name.text in self.elements:
            return self.elements[name.text]
        symbols = self.scope.symbols
        if name.text in symbols.declared and name.text not in symbols.known:
            raise PoisonedError
        raise ModelError(
            [
                Diagnostic(
                    "NS304",
                    f"`{name.text}` is no set-valued term",
                    (Label(name.span, "nothing to approximate"),),
                    notes=(
                        f"the set-valued terms of this model are {quoted(self.elements)}"
                        if self.elements
                        else "this model has no set-valued term",
                    ),
                    help=suggest(name.text, self.elements),
                )
            ]
        )

    def _approximation(self, statement: ApproximateStatement) -> Approximation:
        seen: dict[str, Setting] = {}
        terms = [self.elements[n.text] for n in statement.elements if n.text in self.elements]
        indices = {term.range.variable for term in terms if term.range is not None}

        def value(setting: Setting) -> tuple[str, Expr]:
            _check_new(setting, seen)
            self._check_one_for_all(setting, indices)
            return self._setting(setting)

        found = each(value, statement.settings)
        return Approximation(
            "xiong2013" if statement.law is None else statement.law.text,
            tuple(item for item in found if item[0] not in TARGETS),
            tuple(item for item in found if item[0] in TARGETS),
            statement.at_equilibrium,
            span=statement.span,
        )

    def _check_one_for_all(self, setting: Setting, indices: set[str]) -> None:
        """Refuse a constant that varies over a family."""
        assert isinstance(setting.value, Expr)
        read = indices.intersection(written_names(setting.value))
        for index in read.difference(self.scope.symbols.declared):
            raise refuse(
                "NS111",
                f"`{setting.name.text}` is one number for the whole family",
                setting.value.span,
                f"depends on the index `{index}`",
                help="read one element, such as `k[1]`, or write the elements as separate forces",
            )

    def _setting(self, setting: Setting) -> tuple[str, Expr]:
        assert isinstance(setting.value, Expr)
        value = scalar(setting.value, self.scope, f"`{setting.name.text}`")
        self.review.check(value)
        return setting.name.text, in_si(value, setting.unit)


def _twice(message: str, span: Span, first: Span) -> ModelError:
    labels = (Label(span, "again here"), Label(first, "first here"))
    way_out = "one element has one set of constants: remove one of the two"
    return ModelError([Diagnostic("NS305", message, labels, help=way_out)])


def _check_new(setting: Setting, seen: dict[str, Setting]) -> None:
    first = seen.setdefault(setting.name.text, setting)
    if first is not setting:
        raise ModelError(
            [
                Diagnostic(
                    "NS102",
                    f"`{setting.name.text}` is given twice",
                    (Label(setting.span, "again here"), Label(first.span, "first here")),
                    help="remove one of them",
                )
            ]
        )


def run(statements: Sequence[SimulateStatement], scope: Scope, review: Review) -> Run:
    """Return the defaults of a run.

    Raises
    ------
    ModelError
        NS102 for a second statement or setting, NS501 for values out of range.
    """
    if not statements:
        return Run()
    if len(statements) > 1:
        raise refuse("NS102", "`simulate` stands twice", statements[1].span, help="keep one")
    statement = statements[0]
    seen: dict[str, Setting] = {}

    def value(setting: Setting) -> float | str:
        _check_new(setting, seen)
        match setting.value:
            case Identifier(method):
                return method
            case Expr() as written:
                return _positive(setting, written, scope, review)

    given = dict(zip(seen, each(value, statement.settings), strict=True))
    method = given.pop("method", None)
    times = {name: float(number) for name, number in given.items()}
    return Run(**times, method=None if method is None else str(method), span=statement.span)


def _positive(setting: Setting, value: Expr, scope: Scope, review: Review) -> float:
    what = "the duration" if setting.name.text == "duration" else f"`{setting.name.text}`"
    written = scalar(value, scope, what)
    review.check(written)
    found = constant(in_si(written, setting.unit), what)
    if not 0 < found < math.inf:
        raise refuse(
            "NS501",
            f"{what} must be a finite number greater than 0",
            setting.span,
            f"this is {found:g}",
        )
    return found


def constant(value: Expr, what: str) -> float:
    """Return the value of an expression made of numbers alone.

    Raises
    ------
    ModelError
        NS111 if it reads a name.
    """
    for name in names(value):
        raise refuse(
            "NS111",
            f"{what} must be made of numbers alone",
            name.span,
            "this is a name",
            help="write the number",
        )
    if isinstance(value, Number):
        return value.value
    return evaluate(value, _no_names)


def _no_names(name: str, at: int | None) -> float:
    raise AssertionError(name)


def odd_duration(hints: Run) -> Iterator[Diagnostic]:
    """Note a duration that is no multiple of the step."""
    if hints.duration is None or hints.step is None:
        return
    steps = hints.duration / hints.step
    if abs(steps - round(steps)) > 1e-9 * steps:
        yield Diagnostic(
            "NS404",
            f"the duration is {steps:.6g} steps long; a run takes {round(steps)}",
            (Label(hints.span),),
            help="choose a duration that is a multiple of the step",
            severity="note",
        )
