"""Random models that are valid, each written twice: with families, and element by element.

The two must have equal right-hand sides, which is the oracle. The writer is typed: it
knows what a name is and over which range, keeps divisors away from zero and factors
nonnegative, and gives each argument of a term a number of its own, so that no two
elements of the written-out model happen to be one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random

#: Writes an expression: for the whole family (None), or for one element.
Written = Callable[[int | None], str]


@dataclass
class Twins:
    """One model as two texts; with ``libm`` off it calls no function that compilers round."""

    seed: int
    depth: int = 3
    libm: bool = True
    family: list[str] = field(default_factory=list)
    elements: list[str] = field(default_factory=list)
    scalars: list[str] = field(default_factory=list)
    families: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.random = Random(self.seed)
        self.first = self.random.choice([0, 1, 1, 2])
        self.last = self.first + self.random.randint(0, 4)
        self.offset = 0
        self.sliding: Written = lambda k: "0"
        self._write()

    @property
    def texts(self) -> tuple[str, str]:
        """The model with families, and the same element by element."""
        return "\n".join(self.family) + "\n", "\n".join(self.elements) + "\n"

    def name(self, whole: str) -> str:
        """Return what an element, as ``x[3].y``, is called where it is written out."""
        head, bracket, tail = whole.partition("[")
        index, _, suffix = tail.partition("]")
        return f"{head}_{index}{suffix}" if bracket else whole

    # statements

    def _write(self) -> None:
        self._both(f"model twins{self.seed}")
        self._parameters()
        self._motions()
        self._states()
        for k in range(self.random.randint(1, 4)):
            self._let(f"c{k}")
        self._contacts()
        self._frictions()
        self._equations()
        self._both("output total = " + "{0}", self._total())
        self._both("approximate default dio: K = 900, alpha = 2e-2, beta = 3e-2")
        self._both("approximate default sgn: K = 800, beta = 4e-2")

    def _both(self, line: str, value: Written | None = None) -> None:
        for lines in (self.family, self.elements):
            shown = value(None if lines is self.family else self.first) if value else ""
            lines.append(line.format(shown) if value else line)

    def _each(self, declaration: str, value: Written) -> None:
        """Write ``declaration = value``, where ``{}`` stands for the subscript."""
        over = f"[i in {self.first}..{self.last}]"
        self.family.append(f"{declaration.format(over)} = {value(None)}")
        for k in self._range():
            self.elements.append(f"{declaration.format(f'_{k}')} = {value(k)}")

    def _row(self, left: Written, right: Written) -> None:
        self.family.append(f"for i in {self.first}..{self.last}: {left(None)} = {right(None)}")
        self.elements.extend(f"{left(k)} = {right(k)}" for k in self._range())

    def _range(self) -> range:
        return range(self.first, self.last + 1)

    def _parameters(self) -> None:
        self._both(f"parameter m = {self._number(0.5, 2)} > 0")
        self._both(f"parameter mu = {self._number(0, 1)}")
        self.scalars += ["m", "mu"]
        values = [self._number(-1, 1) for _ in self._range()]
        if self.random.random() < 0.5:
            listed = ", ".join(values)
            self._each(
                "parameter k{}", lambda k: f"[{listed}]" if k is None else values[k - self.first]
            )
        else:
            self._each("parameter k{}", lambda k: f"0.3*{'i' if k is None else k} - 1")
        self.families.append("k")

    def _motions(self) -> None:
        """Write functions of time and their derivatives, while nothing else has a name."""
        first, second = self._expression(2), self._expression(2)
        self._each("let r{}", lambda k: f"t*{first(k)} + t^2*{second(k)}")
        self._each("let d{}", lambda k: f"der({_element('r', k)})")
        self.families += ["r", "d"]

    def _states(self) -> None:
        for name in ("u", "w"):
            self._both(f"state {name} = {self._number(-1, 1)}")
            self.scalars.append(name)
        for name in ("x", "y", "v"):
            self._each(f"state {name}{{}}", lambda k: f"0.1*{'i' if k is None else k}")
            self.families.append(name)
        self._each("state p{}[2]", lambda k: "[0, 1]")

    def _let(self, name: str) -> None:
        if self.random.random() < 0.4:
            self._both(f"let {name} = {{0}}", self._expression(self.depth, indexed=False))
            self.scalars.append(name)
        else:
            self._each(f"let {name}{{}}", self._expression(self.depth))
            self.families.append(name)

    def _contacts(self) -> None:
        gap, apart = self._expression(1), self._apart()
        self.sliding = self._expression(1)  # before any name holds a term
        self._each("force N{}", lambda k: f"dio({_element('x', k)} + {apart} + 0.1*{gap(k)})")
        self.families.append("N")
        other = self._apart()
        self._both(f"force floor = dio(u + {other})")
        self.scalars.append("floor")

    def _frictions(self) -> None:
        factor, apart = self._nonnegative(self.depth), self._apart()
        self._each(
            "force F{}",
            lambda k: f"{factor(k)}*sgn({_element('v', k)} + {apart} + 0.1*{self.sliding(k)})/m",
        )
        planar, other = self._nonnegative(1), self._apart()
        self._each(
            "force G{}",
            lambda k: f"-{planar(k)}*sgn([{_element('p', k)}.y + {other}, {_element('p', k)}.x])",
        )

    def _equations(self) -> None:
        plain = self._expression(self.depth)
        self._row(
            lambda k: f"der({_element('x', k)})", lambda k: f"{plain(k)} + {_element('F', k)}"
        )
        coupling, right, left = (self._expression(1) for _ in range(3))
        small = self._bounded(coupling)
        self._row(
            lambda k: f"(m + 2)*der({_element('y', k)}) + {small(k)}*der({_element('v', k)})",
            lambda k: f"{left(k)} - {_element('N', k)}",
        )
        self._row(
            lambda k: f"{small(k)}*der({_element('y', k)}) + 3*der({_element('v', k)})",
            lambda k: f"{right(k)} - {_element('F', k)}",
        )
        self._row(lambda k: f"m*der({_element('p', k)})", lambda k: f"{_element('G', k)} + [u, w]")
        some = self.random.choice(list(self._range()))
        self._both("der(u) = w - {0}", self._expression(2, indexed=False))
        self.family.append(f"der(w) = -floor - der(x[{some}])*mu")
        self.elements.append(f"der(w) = -floor - der(x_{some})*mu")

    def _total(self) -> Written:
        return self._sum(self._expression(1))

    # expressions

    def _number(self, low: float, high: float) -> str:
        return f"{self.random.uniform(low, high):.3f}"

    def _apart(self) -> str:
        self.offset += 1
        return f"{0.0137 * self.offset:.4f}"

    def _expression(self, depth: int, indexed: bool = True) -> Written:
        if depth == 0 or self.random.random() < 0.15:
            return self._leaf(indexed)
        kind = self.random.randrange(7)
        a = self._expression(depth - 1, indexed)
        if kind == 0:
            name = self.random.choice(["sin", "cos", "tanh", "atan", "abs"]) if self.libm else "abs"
            return lambda k: f"{name}({a(k)})"
        if kind == 1:
            return lambda k: f"(-{a(k)})"
        if kind == 2 and not indexed:
            return self._sum(self._expression(depth - 1))
        b = self._expression(depth - 1, indexed)
        if kind == 3:
            return lambda k: f"{a(k)}/(1.5 + abs({b(k)}))"
        if kind == 4:
            name = self.random.choice(["max", "min"])
            return lambda k: f"{name}({a(k)}, {b(k)})"
        if kind == 5 and indexed:
            edge = self.random.choice(list(self._range()))
            return lambda k: f"(if {'i' if k is None else k} > {edge} then {a(k)} else {b(k)})"
        operator = self.random.choice(["+", "-", "*"])
        return lambda k: f"({a(k)} {operator} {b(k)})"

    def _nonnegative(self, depth: int) -> Written:
        a = self._expression(1)
        match self.random.randrange(6):
            case 0:
                return lambda k: f"mu*abs({a(k)})"
            case 1:
                return lambda k: f"(mu + ({a(k)})^2)"
            case 2:
                return lambda k: f"mu*{_element('N', k)}"
            case 3 if depth:
                b = self._nonnegative(depth - 1)
                grown = "exp(tanh({}))" if self.libm else "(1 + abs({}))"
                return lambda k: f"{b(k)}*{grown.format(a(k))}"
            case 5:
                return self._assumed(a)
        return lambda k: f"max(0, {a(k)})/(m + 1)"

    def _assumed(self, a: Written) -> Written:
        """Write a factor that is never negative, which only an assumption tells."""

        def factor(k: int | None) -> str:
            return f"(abs({a(k)}) - {a(k)})"

        self.family.append(f"for i in {self.first}..{self.last}: assume {factor(None)} >= 0")
        self.elements.extend(f"assume {factor(k)} >= 0" for k in self._range())
        return factor

    def _bounded(self, a: Written) -> Written:
        return lambda k: f"tanh({a(k)})" if self.libm else f"max(-1, min(1, {a(k)}))"

    def _sum(self, body: Written) -> Written:
        def written(k: int | None) -> str:
            if k is None:
                return f"sum(i in {self.first}..{self.last}: {body(None)})"
            return "(" + " + ".join(body(j) for j in self._range()) + ")"

        return written

    def _leaf(self, indexed: bool) -> Written:
        kind = self.random.randrange(5)
        if kind == 0:
            number = self._number(-2, 2)
            return lambda k: number if number[0] != "-" else f"({number})"
        if not indexed or kind == 1:
            name = self.random.choice([*self.scalars, "t"])
            if kind == 2 and self.families:
                return self._fixed_element()
            return lambda k: name
        if kind == 2:
            return lambda k: "i" if k is None else str(k)
        family = self.random.choice(self.families)
        if kind == 3:
            return self._neighbor(family)
        return lambda k: _element(family, k)

    def _fixed_element(self) -> Written:
        family, at = self.random.choice(self.families), self.random.choice(list(self._range()))
        return lambda k: f"{family}[{at}]" if k is None else f"{family}_{at}"

    def _neighbor(self, family: str) -> Written:
        """Write the element before or behind, and a number where there is a wall."""
        by, wall = self.random.choice([-1, 1]), self._number(0, 1)
        inside = f"i > {self.first}" if by < 0 else f"i < {self.last}"

        def written(k: int | None) -> str:
            if k is None:
                return f"(if {inside} then {family}[i{by:+d}] else {wall})"
            return f"{family}_{k + by}" if k + by in self._range() else wall

        return written


def _element(family: str, k: int | None) -> str:
    return f"{family}[i]" if k is None else f"{family}_{k}"
