"""What every part of the generated C knows: names, places and the type of a number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from nsode.backends import Options
from nsode.backends.c.jacobian import Arranged, arranged
from nsode.backends.c.names import Mangler, identifier, mangled
from nsode.backends.jacobian import sparse_jacobian
from nsode.expr import Expr
from nsode.ode import AugmentedODE, Check, Placed, Slot, layout, size
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
    """A value as C, and the loads that it needs; it holds on to the value for its id."""

    value: Expr
    text: str
    loads: dict[tuple[int, int], str]


@dataclass(frozen=True, slots=True)
class Program:
    """One model on its way to C; ``ode`` is in pieces.

    ``checks`` pairs each piece of a check with the number of the check in the model.
    ``used`` collects the helpers and library functions that the text calls, ``texts`` what
    several functions compute alike.
    """

    ode: AugmentedODE
    prefix: str
    single: bool
    x: Vector
    u: Vector
    p: Vector
    y: Vector
    bindings: Mangler
    checks: tuple[tuple[int, Check], ...]
    jacobian: Arranged
    used: set[str] = field(default_factory=set)
    texts: dict[int, Text] = field(default_factory=dict)

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """The vectors that have a layout, in the order of the header."""
        return (self.x, self.u, self.p, self.y)

    def enumerator(self, vector: Vector, name: str) -> str:
        """Return the constant of the header that says where a name stands."""
        return f"{self.prefix}_{vector.letter.upper()}_{vector.names[name][2:]}"


def program(ode: AugmentedODE, options: Options) -> Program:
    """Prepare a model for C."""

    def vector(letter: str, items: Sequence[Placed]) -> Vector:
        names = mangled(f"{letter}_", (item.name for item in items))
        return Vector(letter, items, layout(items), names)

    sparse = sparse_jacobian(multiply_by_reciprocals(ode))
    return Program(
        ode=split(sparse.ode),
        prefix=identifier(options.prefix or ode.name),
        single=options.real == "float",
        x=vector("x", ode.states),
        u=vector("u", ode.inputs),
        p=vector("p", ode.parameters),
        y=vector("y", ode.outputs),
        bindings=Mangler("b_"),
        checks=_numbered_checks(ode),
        jacobian=arranged(sparse),
    )


def _numbered_checks(ode: AugmentedODE) -> tuple[tuple[int, Check], ...]:
    return tuple(
        (number, piece) for number, check in enumerate(ode.checks) for piece in split_check(check)
    )
