"""Augmented ODEs made at random: scalars, families, sums, conditions, both laws, solves.

The generator is typed: it knows which names exist and over which ranges, so what it
makes is always well formed. Divisors, roots and logarithms are kept away from their
singularities, since what is compared there is IEEE lore and tested by hand.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, field

from nsode.expr import Call, Expr, If, Index, IndexRange, Name, Number, Sum
from nsode.ode import (
    AugmentedODE,
    AuxiliaryState,
    Binding,
    Input,
    LinearSolve,
    Output,
    Parameter,
    Rate,
    State,
)
from nsode.source import Source


def call(function: str, *args: Expr | float) -> Expr:
    """Return a call; plain numbers become literals."""
    return Call(function, tuple(a if isinstance(a, Expr) else Number(float(a)) for a in args))


def ode(name: str = "made", **parts: Sequence) -> AugmentedODE:
    """Return an ODE of which only some parts are given."""
    kinds = ("states", "inputs", "parameters", "bindings", "rates", "outputs", "auxiliary")
    given = {kind: tuple(parts.pop(kind, ())) for kind in kinds}
    assert not parts
    return AugmentedODE(name, Source("made.di", ""), **given)


def of_rates(**rates: Expr) -> AugmentedODE:
    """Return an ODE of scalar states, each with the rate of its keyword."""
    return ode(
        states=[State(name, Number(0.0)) for name in rates],
        rates=[Rate(name, value) for name, value in rates.items()],
    )


@dataclass
class Maker:
    """Makes one random ODE from a seed."""

    seed: int
    depth: int = 4
    scalars: list[str] = field(default_factory=list)
    families: dict[str, IndexRange] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.pick = random.Random(self.seed)

    def make(self) -> AugmentedODE:
        pick = self.pick
        parameters = [Parameter(f"k{i}", (self.value(),)) for i in range(3)]
        parameters += [Parameter(f"N.{c}", (pick.uniform(0.5, 2.0),)) for c in ("K", "beta")]
        states = [State(name, Number(self.value())) for name in ("p.x", "p.y", "p_x", "lambda")]
        inputs = [Input("u", self.value())]
        self.scalars = [item.name for item in (*parameters, *states, *inputs)] + ["t"]
        n = pick.randint(1, 6)
        first = pick.randint(0, 2)
        rows = IndexRange("i", first, first + n - 1)
        parameters.append(Parameter("m", tuple(pick.uniform(0.5, 2) for _ in range(n)), rows))
        states += [State("q", Index("i"), rows), State("w.x", self.element_free(rows), rows)]
        self.families = {"m": rows, "q": rows, "w.x": rows}
        bindings = [self.binding(k, rows) for k in range(8)]
        bindings.append(self.solve(None, "s"))
        self.scalars += ["s.x", "s.y"]
        bindings.append(self.solve(rows, "d"))
        self.families |= {"d.x": rows, "d.y": rows}
        e = AuxiliaryState("N.e", self.expr(), Number(0.0), "N", "dio(p)")
        states.append(State(e.name, e.initial))
        rates = [Rate(s.name, self.expr(s.range), s.range) for s in states if s.name != e.name] + [
            Rate(e.name, e.rate)
        ]
        outputs = [Output("y", self.expr()), Output("z", self.expr(rows), rows)]
        return ode(
            f"made{self.seed}",
            states=states,
            inputs=inputs,
            parameters=parameters,
            bindings=bindings,
            rates=rates,
            outputs=outputs,
            auxiliary=[e],
        )

    def value(self) -> float:
        return round(self.pick.uniform(-2.0, 2.0), 3)

    def element_free(self, rows: IndexRange) -> Expr:
        return call("*", 0.25, Index(rows.variable, 1))

    def binding(self, k: int, rows: IndexRange) -> Binding:
        if self.pick.random() < 0.5:
            made = Binding(f"b{k}", self.expr())
            self.scalars.append(made.name)
        else:
            made = Binding(f"f{k}.y", self.expr(rows), rows)
            self.families[made.name] = rows
        return made

    def solve(self, rows: IndexRange | None, name: str) -> LinearSolve:
        """Return a 2 by 2 system that dominates on its diagonal."""

        def small() -> Expr:
            return call("sat", 0.5, self.expr(rows, 2))

        matrix = ((call("+", 3.0, small()), small()), (small(), call("+", 4.0, small())))
        right = (self.expr(rows, 2), self.expr(rows, 2))
        return LinearSolve((f"{name}.x", f"{name}.y"), matrix, right, rows)

    def expr(self, over: IndexRange | None = None, depth: int | None = None) -> Expr:
        """Return an expression, of elements of families where a range is open."""
        return self._expr(() if over is None else (over,), self.depth if depth is None else depth)

    def _expr(self, axes: tuple[IndexRange, ...], depth: int) -> Expr:
        if depth == 0 or self.pick.random() < 0.12:
            return self._leaf(axes)
        kinds = [self._arithmetic, self._arithmetic, self._kink, self._function]
        if self.families and len(axes) < 2:
            kinds.append(self._sum)
        return self.pick.choice(kinds)(axes, depth)

    def _positive(self, axes: tuple[IndexRange, ...], depth: int) -> Expr:
        return call("+", 0.5, call("abs", self._expr(axes, depth)))

    def _arithmetic(self, axes: tuple[IndexRange, ...], depth: int) -> Expr:
        a, b, c = (self._expr(axes, depth - 1) for _ in range(3))
        match self.pick.randrange(6):
            case 0:
                return call("+", a, b, c)
            case 1:
                return call("+", a, call("neg", b))
            case 2:
                return call("*", a, b)
            case 3:
                return call("*", call("neg", a), call("*", b, c))
            case 4:
                return call("/", a, self._positive(axes, depth - 1))
            case _:
                return call("^", call("sin", a), float(self.pick.choice([2, 3])))

    def _kink(self, axes: tuple[IndexRange, ...], depth: int) -> Expr:
        a, b = (self._expr(axes, depth - 1) for _ in range(2))
        match self.pick.randrange(4):
            case 0:
                return call(self.pick.choice(["max", "min"]), a, b)
            case 1:
                return call("sat", self._positive(axes, depth - 1), a)
            case 2:
                return call("shrink", self._positive(axes, depth - 1), call("norm", a, b))
            case _:
                condition = call(self.pick.choice(["<", "<=", ">", ">="]), a, b)
                return If(condition, self._expr(axes, depth - 1), self._expr(axes, depth - 1))

    def _function(self, axes: tuple[IndexRange, ...], depth: int) -> Expr:
        match self.pick.randrange(3):
            case 0:
                name = self.pick.choice(["sin", "cos", "tanh", "atan", "neg"])
                return call(name, self._expr(axes, depth - 1))
            case 1:
                name = self.pick.choice(["sqrt", "log"])
                return call(name, self._positive(axes, depth - 1))
            case _:
                return call("exp", call("sat", 1.0, self._expr(axes, depth - 1)))

    def _sum(self, axes: tuple[IndexRange, ...], depth: int) -> Expr:
        rows = next(iter(self.families.values()))
        inner = IndexRange("j" if axes else "k", rows.first, rows.last)
        return Sum(inner, self._expr((*axes, inner), min(depth - 1, 2)))

    def _leaf(self, axes: tuple[IndexRange, ...]) -> Expr:
        pick = self.pick
        kind = pick.randrange(4)
        if kind == 0:
            return Number(self.value())
        if kind == 1 and axes and self.families:
            over = pick.choice(axes)
            if pick.random() < 0.2:
                return Index(over.variable, pick.randint(-1, 1))
            return Name(pick.choice(list(self.families)), Index(over.variable))
        if kind == 2 and self.families:
            name = pick.choice(list(self.families))
            rows = self.families[name]
            return Name(name, Index(None, pick.randint(rows.first, rows.last)))
        return Name(pick.choice(self.scalars))
