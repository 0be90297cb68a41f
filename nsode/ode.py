"""What stages 2, 3 and 4 hand on: systems of equations as plain data.

:class:`System` is what a differential inclusion and its augmented ODE share.
Small vectors are scalarised: a state ``p[3]`` is the three states ``p.x``, ``p.y``
and ``p.z``. A declaration with an index range is a family; it stays one item, with
the range, and takes ``len(range)`` consecutive places in the vectors x, u, p and y.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal, NamedTuple, Protocol

from nsode.dimension import Dimension
from nsode.expr import Expr, IndexRange
from nsode.source import NOWHERE, Source, Span

#: What the name of a state ends with where it stands for the rate of that state.
RATE_SUFFIX = ".rate"
#: What the derivative in time of any other name ends with.
DOT_SUFFIX = ".dot"


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter or an approximation constant, with the value it has in p0.

    ``values`` has one number, or one for each element of a family; NaN where the
    model gives none. ``formula`` is set where the value is computed from other
    parameters when a run starts.
    """

    name: str
    values: tuple[float, ...]
    range: IndexRange | None = None
    unit: str | None = None
    formula: Expr | None = None
    constant_of: str | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Input:
    """A value from outside, held over a step; ``default`` None demands data."""

    name: str
    default: float | None = None
    range: IndexRange | None = None
    unit: str | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class State:
    """A state and its value at the start, an expression of parameters.

    The initial value of an auxiliary state may also read the model's own states and
    the bindings, all at the start.
    """

    name: str
    initial: Expr
    range: IndexRange | None = None
    unit: str | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


Role = Literal["let", "force", "term", "part"]


@dataclass(frozen=True, slots=True)
class Binding:
    """A named value; reads only bindings that stand before it.

    ``role`` tells a person why it is there: ``let`` and ``force`` were declared,
    ``term`` is the value of a set-valued term, ``part`` a step on the way to one.
    """

    name: str
    value: Expr
    range: IndexRange | None = None
    role: Role = "let"
    unit: str | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class LinearSolve:
    """``matrix @ unknowns = right``, solved where it stands; defines ``unknowns``.

    With a range, one small system for each index.
    """

    unknowns: tuple[str, ...]
    matrix: tuple[tuple[Expr, ...], ...]
    right: tuple[Expr, ...]
    range: IndexRange | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Approximation:
    """The law and the constants that approximate one element.

    ``constants`` maps ``K``, ``alpha``, ``beta`` and the like to expressions of
    parameters; ``targets`` are wishes that tuning turns into constants.
    """

    law: str = "xiong2013"
    constants: tuple[tuple[str, Expr], ...] = ()
    targets: tuple[tuple[str, Expr], ...] = ()
    at_equilibrium: bool = False
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class SetValuedTerm:
    """``dio(argument)`` or ``factor*sgn(argument)``, hoisted to a term of its own.

    It stands among the bindings, where its argument and factor are known, and
    defines ``multiplier``: one name for each of the ``r = len(argument)`` components.
    ``factor`` is chi as the author wrote it, None for dio; ``written`` is where, left and right
    of sgn. ``dimensions`` are those of the multiplier and of the argument, as far as the units
    of the model tell.
    """

    name: str
    kind: Literal["dio", "sgn"]
    argument: tuple[Expr, ...]
    factor: Expr | None
    multiplier: tuple[str, ...]
    range: IndexRange | None = None
    approximation: Approximation = Approximation()
    dimensions: tuple[Dimension | None, Dimension | None] = (None, None)
    written: tuple[Span, ...] = field(default=(), compare=False, kw_only=True)
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)

    @property
    def suffixes(self) -> tuple[str, ...]:
        """What stands behind a name for each component: nothing for a scalar."""
        return ("",) if len(self.argument) == 1 else (".x", ".y", ".z")[: len(self.argument)]


@dataclass(frozen=True, slots=True)
class Rate:
    """``der(state) = value``; the rates of a family may come in pieces."""

    state: str
    value: Expr
    range: IndexRange | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Output:
    """A value that somebody asked for."""

    name: str
    value: Expr
    range: IndexRange | None = None
    unit: str | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Check:
    """A condition that must hold: what was assumed, or what a proof used.

    ``kind`` is ``bound`` (declared, or lent by a parameter's value; reads parameters
    only), ``assume`` or ``factor`` (chi >= 0).
    """

    kind: Literal["bound", "assume", "factor"]
    condition: Expr
    range: IndexRange | None = None
    reason: str = ""
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Run:
    """Defaults of a run, in seconds; None where the model says nothing."""

    duration: float | None = None
    step: float | None = None
    every: float | None = None
    method: str | None = None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class AuxiliaryState:
    """A state that the rewrite appends: (24) for dio, (18a) for sgn.

    ``term`` is the set-valued term that it belongs to, ``replaces`` that term's text, and
    ``law`` the law that asks for the state.
    """

    name: str
    rate: Expr
    initial: Expr
    term: str
    replaces: str
    range: IndexRange | None = None
    unit: str | None = None
    law: str = Approximation().law
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


Definition = Binding | LinearSolve | SetValuedTerm


def defined(item: Definition) -> tuple[str, ...]:
    """Return the names that a definition defines."""
    match item:
        case Binding():
            return (item.name,)
        case LinearSolve():
            return item.unknowns
        case SetValuedTerm():
            return item.multiplier


def expressions(item: Definition) -> tuple[Expr, ...]:
    """Return every expression that a definition reads."""
    match item:
        case Binding():
            return (item.value,)
        case LinearSolve():
            return (*(entry for row in item.matrix for entry in row), *item.right)
        case SetValuedTerm():
            return item.argument if item.factor is None else (*item.argument, item.factor)


@dataclass(frozen=True, slots=True)
class System:
    """x' = f(t, x, u, p, bindings) with outputs; bindings in an order that computes.

    ``outputs`` are the declared ones, then every force.
    """

    name: str
    source: Source
    states: tuple[State, ...]
    inputs: tuple[Input, ...]
    parameters: tuple[Parameter, ...]
    bindings: tuple[Definition, ...]
    rates: tuple[Rate, ...]
    outputs: tuple[Output, ...]
    checks: tuple[Check, ...] = ()
    run: Run = Run()


@dataclass(frozen=True, slots=True)
class DifferentialInclusion(System):
    """x' = f(t, x, u, p, lambda) with each multiplier lambda in its law.

    The laws are the set-valued terms among ``bindings``.
    """

    @property
    def terms(self) -> tuple[SetValuedTerm, ...]:
        """The set-valued terms, in the order of the bindings."""
        return tuple(item for item in self.bindings if isinstance(item, SetValuedTerm))


@dataclass(frozen=True, slots=True)
class AugmentedODE(System):
    """The paper's (32): single valued, with the auxiliary states e and a appended.

    ``states`` and ``rates`` hold the auxiliary ones too, last: first e's, then a's.
    """

    auxiliary: tuple[AuxiliaryState, ...] = ()


class Placed(Protocol):
    """Anything that takes places in x, u, p or y."""

    @property
    def name(self) -> str:
        """Its name."""
        ...

    @property
    def range(self) -> IndexRange | None:
        """Its index range, None for a single place."""
        ...


class Slot(NamedTuple):
    """Where a name stands in its vector: ``offset`` of its first element."""

    offset: int
    range: IndexRange | None


def size(item: Placed) -> int:
    """Return how many places an item takes."""
    return 1 if item.range is None else len(item.range)


def layout(items: Iterable[Placed]) -> dict[str, Slot]:
    """Return the place of each name, in order."""
    slots: dict[str, Slot] = {}
    offset = 0
    for item in items:
        slots[item.name] = Slot(offset, item.range)
        offset += size(item)
    return slots


def element(name: str, index: int) -> str:
    """Return the name of one element of a family.

    ``p.x`` at 3 is ``p[3].x``, ``q[2]`` is ``q[3][2]``.
    """
    head = name.partition(".")[0].partition("[")[0]
    return f"{head}[{index}]{name[len(head) :]}"


def element_names(items: Iterable[Placed]) -> list[str]:
    """Return the name of every place, in order."""
    return [
        name
        for item in items
        for name in (
            [item.name]
            if item.range is None
            else [element(item.name, k) for k in range(item.range.first, item.range.last + 1)]
        )
    ]
