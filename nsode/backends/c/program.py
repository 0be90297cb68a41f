"""What every part of the generated C knows: names, places and the type of a number."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from nsode.backends import Options
from nsode.backends.c.jacobian import Arranged, arranged
from nsode.backends.c.names import Mangler, identifier, mangled
from nsode.backends.c.plan import Readings
from nsode.backends.jacobian import sparse_jacobian
from nsode.expr import TIME, Expr
from nsode.integrators import REGISTRY, Scheme
from nsode.integrators.splittings import Verlet
from nsode.ode import (
    AugmentedODE,
    Binding,
    Check,
    Definition,
    LinearSolve,
    Placed,
    Slot,
    layout,
    size,
)
from nsode.passes.reciprocal import multiply_by_reciprocals
from nsode.passes.split import split, split_check


class Vector(NamedTuple):
    """One of the vectors x, u, p and y: its letter, its items, and where each stands."""

    letter: str
    items: Sequence[Placed]
    slots: dict[str, Slot]
    names: Mangler

    @property
    def size(self) -> int:
        """The number of places."""
        return sum(map(size, self.items))


class Text(NamedTuple):
    """A value as C; it holds on to the value for its id."""

    value: Expr
    text: str


@dataclass(frozen=True, slots=True)
class Program:
    """One model on its way to C; ``ode`` is in pieces, ``whole`` as it came.

    ``locals`` has what holds each named value inside a function. ``checks`` pairs each
    piece of a check with the number of the check in the model. ``used`` collects the helpers
    and library functions that the text calls; ``texts`` and ``readings`` hold what several
    functions need to know of one expression.
    """

    ode: AugmentedODE
    whole: AugmentedODE
    methods: Mapping[str, Scheme | Verlet]
    prefix: str
    single: bool
    x: Vector
    u: Vector
    p: Vector
    y: Vector
    bindings: tuple[Binding | LinearSolve, ...]
    locals: Mangler
    checks: tuple[tuple[int, Check], ...]
    jacobian: Arranged
    used: set[str] = field(default_factory=set)
    texts: dict[int, Text] = field(default_factory=dict)
    readings: Readings = field(default_factory=Readings)

    @property
    def loaded(self) -> tuple[Vector, ...]:
        """The vectors that a function reads."""
        return (self.x, self.u, self.p)

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """The vectors that have a layout, in the order of the header."""
        return (self.x, self.u, self.p, self.y)

    def enumerator(self, vector: Vector, name: str) -> str:
        """Return the constant of the header that says where a name stands."""
        return f"{self.prefix}_{vector.letter.upper()}_{vector.names[name][2:]}"


def program(ode: AugmentedODE, options: Options, splittings: Iterable[Verlet] = ()) -> Program:
    """Prepare a model for C, with the registered methods and some splittings."""

    def vector(letter: str, items: Sequence[Placed]) -> Vector:
        names = mangled(f"{letter}_", (item.name for item in items))
        return Vector(letter, items, layout(items), names)

    x, u, p = vector("x", ode.states), vector("u", ode.inputs), vector("p", ode.parameters)
    sparse = sparse_jacobian(multiply_by_reciprocals(ode))
    in_pieces = split(sparse.ode)
    return Program(
        ode=in_pieces,
        whole=ode,
        methods={**REGISTRY, **{method.name: method for method in splittings}},
        prefix=identifier(options.prefix or ode.name),
        single=options.real == "float",
        x=x,
        u=u,
        p=p,
        y=vector("y", ode.outputs),
        bindings=definitions(in_pieces),
        locals=_locals(x, u, p),
        checks=_numbered_checks(ode),
        jacobian=arranged(sparse),
    )


def _locals(*vectors: Vector) -> Mangler:
    """Return the names of what a function loads; those of bindings are added when asked for."""
    names = Mangler("b_")
    names[TIME] = TIME
    for vector in vectors:
        names.update(vector.names)
    return names


def definitions(ode: AugmentedODE) -> tuple[Binding | LinearSolve, ...]:
    """Return the bindings of an ODE."""
    return tuple(map(_single_valued, ode.bindings))


def _single_valued(item: Definition) -> Binding | LinearSolve:
    if isinstance(item, Binding | LinearSolve):
        return item
    raise NotImplementedError(f"no C for {type(item).__name__}")


def _numbered_checks(ode: AugmentedODE) -> tuple[tuple[int, Check], ...]:
    return tuple(
        (number, piece) for number, check in enumerate(ode.checks) for piece in split_check(check)
    )
