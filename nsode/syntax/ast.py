"""The tree of a model as it was written: statements in order, each with its span.

Expressions are those of :mod:`nsode.expr` and four kinds that only stand here,
since stage 2 removes them: brackets, subscripts, components and grouping.
``dio``, ``sgn``, ``der``, ``dot``, ``cross``, ``transpose`` and ``qmul`` are
:class:`~nsode.expr.Call` nodes like any other; ``-a`` is ``neg``, ``a - b - c`` is
``+(a, neg(b), neg(c))``, products and quotients are binary and lean left.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar

from nsode.expr import Expr
from nsode.source import NOWHERE, Source, Span


@dataclass(frozen=True, slots=True)
class Group(Expr):
    """An expression in parentheses; chi ends there."""

    inner: Expr


@dataclass(frozen=True, slots=True)
class Bracket(Expr):
    """``[a, b, c]``."""

    items: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Subscript(Expr):
    """``base[index]``."""

    base: Expr
    index: Expr


@dataclass(frozen=True, slots=True)
class Component(Expr):
    """``base.x``: ``field`` is the name behind the dot."""

    base: Expr
    field: str


@dataclass(frozen=True, slots=True)
class Reduction(Expr):
    """``sum(variable in first..last: body)``."""

    range: RangeSyntax
    body: Expr


@dataclass(frozen=True, slots=True)
class Identifier:
    """A name where it is declared or referred to."""

    text: str
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit as written, without its braces; checked in stage 2."""

    text: str
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class RangeSyntax:
    """``variable in first..last``."""

    variable: Identifier
    first: Expr
    last: Expr
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Declarator:
    """``x``, ``p[3]``, ``x[i in 1..n]`` or ``p[i in 1..n][2]``."""

    name: Identifier
    range: RangeSyntax | None
    sizes: tuple[Expr, ...]
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Bound:
    """``>= 0`` behind a declaration: ``relation`` is one of ``< <= > >=``."""

    relation: str
    value: Expr
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Statement:
    """One statement."""

    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


Kind = TypeVar("Kind", bound=Statement)


@dataclass(frozen=True, slots=True)
class ParameterDeclaration(Statement):
    """``parameter mu = 0.3 {1} >= 0``."""

    declarator: Declarator
    value: Expr
    unit: Unit | None
    bounds: tuple[Bound, ...]


@dataclass(frozen=True, slots=True)
class ConstantDeclaration(Statement):
    """``constant n = 10``."""

    name: Identifier
    value: Expr


@dataclass(frozen=True, slots=True)
class InputDeclaration(Statement):
    """``input fe = 0 {N}``; ``default`` None demands data."""

    declarator: Declarator
    default: Expr | None
    unit: Unit | None
    bounds: tuple[Bound, ...]


@dataclass(frozen=True, slots=True)
class StateDeclaration(Statement):
    """``state p[3] = [0, 0, 2*R] {m}``."""

    declarator: Declarator
    initial: Expr
    unit: Unit | None


@dataclass(frozen=True, slots=True)
class LetDeclaration(Statement):
    """``let slip = [v.x - R*w.y, v.y + R*w.x] {m/s}``."""

    declarator: Declarator
    value: Expr
    unit: Unit | None


@dataclass(frozen=True, slots=True)
class ForceDeclaration(Statement):
    """``force F = mu*N*sgn(slip) {N}``."""

    declarator: Declarator
    value: Expr
    unit: Unit | None


@dataclass(frozen=True, slots=True)
class OutputDeclaration(Statement):
    """``output depth = max(0, R - p.z) {m}``."""

    declarator: Declarator
    value: Expr
    unit: Unit | None


@dataclass(frozen=True, slots=True)
class Assumption(Statement):
    """``assume a >= b``, or ``for i in 1..n: assume a[i] >= b``."""

    condition: Expr
    range: RangeSyntax | None


@dataclass(frozen=True, slots=True)
class Equation(Statement):
    """``M*der(v) = f``, or ``for i in 1..n: m*der(v[i]) = f[i]``."""

    left: Expr
    right: Expr
    range: RangeSyntax | None


@dataclass(frozen=True, slots=True)
class Setting:
    """``K = 1e5 {N/m}``; ``value`` is an Identifier for ``method rk4``."""

    name: Identifier
    value: Expr | Identifier
    unit: Unit | None
    span: Span = field(default=NOWHERE, compare=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class ApproximateStatement(Statement):
    """``approximate N, F with lugre: K = 1e5, at equilibrium``.

    ``elements`` is empty for ``approximate default dio``, where ``default`` is the kind.
    """

    elements: tuple[Identifier, ...]
    default: str | None
    law: Identifier | None
    settings: tuple[Setting, ...]
    at_equilibrium: bool


@dataclass(frozen=True, slots=True)
class SimulateStatement(Statement):
    """``simulate 4 {s} step 1e-3 {s} every 0.01 {s} method rk4``.

    The settings are named ``duration``, ``step``, ``every`` and ``method``.
    """

    settings: tuple[Setting, ...]


@dataclass(frozen=True, slots=True)
class Model:
    """A whole model file."""

    name: Identifier
    statements: tuple[Statement, ...]
    source: Source

    def all(self, kind: type[Kind]) -> list[Kind]:
        """Return the statements of one kind, in order."""
        return [statement for statement in self.statements if isinstance(statement, kind)]
