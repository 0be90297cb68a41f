"""A look at the start of a run: what is undefined there should be said before it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.evaluate import evaluate
from nsode.expr import TIME, Call, Expr, IndexRange, Name, Sum, children, names
from nsode.ode import AugmentedODE, Binding, Placed, Rate, SetValuedTerm, State

#: Families that read each other deeper than this, and sums longer, are not looked into.
_DEPTH, _LENGTH = 50, 1000

_LOOKS = 1000  # elements of a contact whose gap is looked at
_ROUNDING = 1e-12  # of the size of its terms: what a gap of zero may differ from zero by


class _GiveUpError(Exception):
    """Finding out would cost too much, or wants what only a run brings."""


@dataclass(frozen=True, slots=True)
class Beginning:
    """The time at which a run starts, and the states, inputs and parameters there.

    ``chosen`` tells whether a person chose some of the states.
    """

    time: float
    x: Sequence[float]
    u: Sequence[float]
    p: Sequence[float]
    chosen: bool

    def values(self, ode: AugmentedODE) -> Iterator[tuple[tuple[str, int | None], float]]:
        """Yield each value with its name and its place in a family."""
        yield (TIME, None), self.time
        for items, vector in ((ode.states, self.x), (ode.inputs, self.u), (ode.parameters, self.p)):
            yield from zip(_places(items), vector, strict=False)  # books follow the states


def _places(items: Iterable[Placed]) -> Iterator[tuple[str, int | None]]:
    for item in items:
        if item.range is None:
            yield item.name, None
        else:
            yield from ((item.name, at) for at in range(item.range.first, item.range.last + 1))


def at_start(ode: AugmentedODE) -> tuple[Diagnostic, ...]:
    """Return warnings for rates that are undefined at the start.

    Constants that nobody gave count as 1. Of a family, the first and the last element
    of each piece are looked at.

    Raises
    ------
    ModelError
        NS116 where the parameters alone make a rate undefined.
    """
    start = _Start.of(ode, missing=1.0)
    found: dict[Diagnostic, None] = dict.fromkeys(_undefined_starts(ode, start))
    for rate in ode.rates:
        for indices in _ends(rate):
            try:
                culprit = start.culprit(rate.value, indices)
            except _GiveUpError:
                continue
            if culprit is not None:
                found[start.diagnosis(culprit, rate)] = None
    errors = [d for d in found if d.severity == "error"]
    if errors:
        raise ModelError(errors, ode.source)
    return tuple(found)


def pressed_at_start(
    terms: Sequence[SetValuedTerm], ode: AugmentedODE, run: Beginning | None = None
) -> tuple[Diagnostic, ...]:
    """Return a warning for each contact that is closed at the start and stores energy there.

    Of a family, the element that is pressed in most is named.

    Parameters
    ----------
    run
        The start of a run, where it is not the model's.
    """
    loads = {state.name for state in ode.auxiliary}
    contacts = [
        term
        for term in terms
        if term.kind == "dio" and (f"{term.name}.e" in loads or not _may_rest(term, run))
    ]
    if not contacts or (run is None and _lacks_values(ode)):
        return ()
    start = _Start.of(ode, missing=math.nan, run=run)
    found = (start.deepest(term) for term in contacts)
    return tuple(
        _pressed(term, *deepest)
        for term, deepest in zip(contacts, found, strict=True)
        if deepest is not None
    )


def _may_rest(term: SetValuedTerm, run: Beginning | None) -> bool:
    """Whether a contact without a state of its own, pressed in, may be at rest there."""
    return term.approximation.at_equilibrium or (run is not None and run.chosen)


def _lacks_values(ode: AugmentedODE) -> bool:
    return any(math.isnan(value) for item in ode.parameters for value in item.values)


def _pressed(term: SetValuedTerm, gap: float, at: int | None) -> Diagnostic:
    name = term.name if at is None else f"{term.name}[{at}]"
    return Diagnostic(
        "NS411",
        f"the scene starts inside the contact `{name}`, whose gap is {gap:.3g}",
        (Label(term.argument[0].span, "negative at the start"),),
        notes=("the approximation throws it out, as a compressed spring does",),
        help="start where no gap is negative; `at equilibrium` holds what rests on a contact",
        severity="warning",
    )


def _undefined_starts(ode: AugmentedODE, start: _Start) -> Iterator[Diagnostic]:
    """Yield an error for each state that the parameters give no value at the start."""
    if _lacks_values(ode):
        return
    for state in ode.states:
        for indices in _ends(state):
            try:
                culprit = start.culprit(state.initial, indices)
            except _GiveUpError:
                continue
            if culprit is not None:
                yield Diagnostic(
                    "NS116",
                    f"`{state.name}` has no value at the start",
                    (Label(culprit.span, "undefined with these parameters"),),
                    help="check the parameters that it reads",
                )


def initial_state(ode: AugmentedODE) -> list[float]:
    """Return x at the start, as NAME_init of the generated C does; NaN where unknown."""
    start = _Start.of(ode, missing=math.nan)
    found: list[float] = []
    for state in ode.states:
        over = state.range
        for at in [None] if over is None else range(over.first, over.last + 1):
            try:
                found.append(start.lookup(state.name, at))
            except _GiveUpError:
                found.append(math.nan)
    return found


def _ends(item: Rate | State) -> Iterator[dict[str, int]]:
    if item.range is None:
        yield {}
    elif len(item.range):
        yield {item.range.variable: item.range.first}
        yield {item.range.variable: item.range.last}


def _terms(expr: Expr) -> int:
    """Return how often the innermost part of sums inside each other is computed."""
    inner = 1
    for child in children(expr):
        inner = max(inner, _terms(child))
    return inner * len(expr.range) if isinstance(expr, Sum) else inner


@dataclass(slots=True)
class _Start:
    """Values at t = 0; ``formulas`` has what each name is, piece by piece."""

    formulas: dict[str, list[tuple[Expr, IndexRange | None]]]
    parameters: set[str]
    known: dict[tuple[str, int | None], float] = field(default_factory=dict)
    depth: int = 0
    long: dict[int, bool] = field(default_factory=dict)

    @classmethod
    def of(cls, ode: AugmentedODE, missing: float, run: Beginning | None = None) -> _Start:
        formulas: dict[str, list[tuple[Expr, IndexRange | None]]] = {}
        for state in ode.states:
            formulas[state.name] = [(state.initial, state.range)]
        bindings = [item for item in ode.bindings if isinstance(item, Binding)]
        for binding in bindings:
            formulas.setdefault(binding.name, []).append((binding.value, binding.range))
        start = cls(formulas, {parameter.name for parameter in ode.parameters})
        own = [value for parameter in ode.parameters for value in parameter.values]
        given = (missing if math.isnan(value) else value for value in own)
        start.known[TIME, None] = 0.0
        start.known |= zip(_places(ode.parameters), given, strict=True)
        if run is not None:
            start.known |= run.values(ode)
        for binding in bindings:  # in order, so that long chains need no recursion
            if binding.range is None:
                try:
                    start.lookup(binding.name, None)
                except _GiveUpError:
                    continue
        return start

    def lookup(self, name: str, at: int | None) -> float:
        if (name, at) not in self.known:
            if self.depth >= _DEPTH:
                raise _GiveUpError
            self.depth += 1
            try:
                self.known[name, at] = self._value(name, at)
            finally:
                self.depth -= 1
        return self.known[name, at]

    def _value(self, name: str, at: int | None) -> float:
        for expr, over in self.formulas.get(name, ()):
            if over is None:
                return self.value(expr, {})
            if at is not None and over.first <= at <= over.last:
                return self.value(expr, {over.variable: at})
        raise _GiveUpError

    def value(self, expr: Expr, indices: dict[str, int]) -> float:
        if self._is_long(expr):
            raise _GiveUpError
        return evaluate(expr, self.lookup, indices)

    def _is_long(self, expr: Expr) -> bool:
        if id(expr) not in self.long:
            self.long[id(expr)] = _terms(expr) > _LENGTH
        return self.long[id(expr)]

    def deepest(self, term: SetValuedTerm) -> tuple[float, int | None] | None:
        """Return the most negative gap of a contact beyond rounding, and its element."""
        (gap,), over = term.argument, term.range
        found: tuple[float, int | None] = 0.0, None
        for at in [None] if over is None else range(over.first, over.last + 1)[:_LOOKS]:
            indices = {} if over is None or at is None else {over.variable: at}
            try:
                if self._is_held(term, at):
                    continue
                value = self.value(gap, indices)
                if value < min(found[0], -_ROUNDING * self._size(gap, indices)):
                    found = value, at
            except _GiveUpError:
                continue
        return found if found[0] < 0 else None

    def _is_held(self, term: SetValuedTerm, at: int | None) -> bool:
        """Whether a contact starts with a load, of its weight or of an earlier run."""
        load = f"{term.name}.e"
        return load in self.formulas and self.lookup(load, at) > 0

    def _size(self, expr: Expr, indices: dict[str, int]) -> float:
        """Return the size of what a value is the sum of, looking through one name."""
        match expr:
            case Name(id, None) if len(self.formulas.get(id, ())) == 1:
                ((expr, _),) = self.formulas[id]
        terms = expr.args if isinstance(expr, Call) and expr.function == "+" else (expr,)
        return sum(abs(self.value(term, indices)) for term in terms)

    def culprit(self, expr: Expr, indices: dict[str, int]) -> Expr | None:
        """Return the innermost part that is not finite though what it reads is."""
        if self._is_fine(expr, indices):
            return None
        inner: tuple[Expr, dict[str, int]] | None = (expr, indices)
        while inner is not None:
            expr, indices = inner
            inner = self._inner(expr, indices)
        return expr

    def _is_fine(self, expr: Expr, indices: dict[str, int]) -> bool:
        return isinstance(expr, Sum) or math.isfinite(self.value(expr, indices))

    def _inner(self, expr: Expr, indices: dict[str, int]) -> tuple[Expr, dict[str, int]] | None:
        """Return what makes an expression that is not finite so, None if it is itself."""
        if isinstance(expr, Name):
            for formula, over in self.formulas.get(expr.id, ()):
                if over is None and not self._is_fine(formula, {}):
                    return formula, {}
            raise _GiveUpError
        for child in children(expr):
            if not self._is_fine(child, indices):
                return child, indices
        return None

    def diagnosis(self, culprit: Expr, rate: Rate) -> Diagnostic:
        labels = [Label(culprit.span, "undefined at the start")]
        if not rate.span.start <= culprit.span.start < rate.span.end:
            labels.append(Label(rate.span, f"so is the rate of `{rate.state}`"))
        match culprit:
            case Call("/", (_, divisor)) if self._fixed(divisor):
                return Diagnostic(
                    "NS116",
                    "division by zero",
                    (Label(divisor.span, "this is 0"), *labels[1:]),
                    help="give the parameters a value that makes it nonzero",
                )
            case Call("/", (_, divisor)):
                labels[0] = Label(culprit.span, "divides by zero at the start")
        return Diagnostic(
            "NS406",
            f"the rate of `{rate.state}` is undefined at the start",
            tuple(labels),
            help="start elsewhere, or write the expression so that it is defined there",
            severity="warning",
        )

    def _fixed(self, expr: Expr) -> bool:
        """Tell whether an expression reads parameters alone."""
        return all(name.id in self.parameters for name in names(expr))
