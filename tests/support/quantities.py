"""Random scenes in which every quantity has a unit, each written in SI and in other units.

The writer knows the dimension of what it writes: only like is added to like, and only a
number enters a sine. So a scene means the same in every system of units.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

#: Exponents of kg, m and s.
Dimension = tuple[int, int, int]

NUMBER, MASS, LENGTH, TIME = (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)
SPEED, FORCE, STIFFNESS, ENERGY = (0, 1, -1), (1, 1, -2), (1, 0, -2), (1, 2, -2)
_APPENDED = {"K": STIFFNESS, "beta": TIME, "alpha": TIME, "e": LENGTH, "a": LENGTH}
_SOME = (NUMBER, MASS, LENGTH, TIME, SPEED)
_SI = ({"kg": 1.0}, {"m": 1.0}, {"s": 1.0})
_OTHERS = ({"g": 1e-3, "kg": 1.0}, {"mm": 1e-3, "km": 1e3}, {"ms": 1e-3, "min": 60.0})


@dataclass(frozen=True)
class Quantity:
    """A number with a dimension, to be written in one unit or another."""

    value: float
    dimension: Dimension

    def written(self, units: tuple[dict[str, float], ...], random: Random) -> str:
        """Return ``value {unit}``, with a random one of the units of each kind."""
        value, factors = self.value, []
        for exponent, choice in zip(self.dimension, units, strict=True):
            name = random.choice(list(choice))
            value /= choice[name] ** exponent
            factors += [f"{name}^{exponent}"] if exponent else []
        return f"{value!r} {{{'*'.join(factors) or '1'}}}"


@dataclass
class Scene:
    """One scene, with the dimension of each name that stands in it."""

    seed: int
    lines: list[tuple[str | Quantity, ...]] = field(default_factory=list)
    dimensions: dict[str, Dimension] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.random = Random(self.seed)
        self._write()

    @property
    def texts(self) -> tuple[str, str]:
        """The scene in SI, and in a mixture of other units."""
        return self._text(_SI), self._text(_OTHERS)

    def dimension(self, name: str) -> Dimension:
        """Return the dimension of what is declared, or of what an approximation appends."""
        _, dot, last = name.partition(".")
        return _APPENDED[last] if dot else self.dimensions[name]

    def _text(self, units: tuple[dict[str, float], ...]) -> str:
        random = Random(self.seed)
        return "".join(
            part if isinstance(part, str) else part.written(units, random)
            for line in self.lines
            for part in (*line, "\n")
        )

    # statements

    def _write(self) -> None:
        self._line("model scene")
        for name, dimension in {"m0": MASS, "l0": LENGTH, "t0": TIME}.items():
            self._declare("parameter", name, dimension, " > 0")
        for name, dimension in {"k": STIFFNESS, "f0": FORCE, "mu": NUMBER}.items():
            self._declare("parameter", name, dimension, " >= 0")
        self._declare("input", "fe", FORCE)
        bodies = range(1, self.random.randint(1, 3) + 1)
        for n in bodies:
            self._declare("state", f"p{n}", LENGTH)
            self._declare("state", f"v{n}", SPEED)
        for n in range(self.random.randint(0, 3)):
            dimension = self.random.choice([NUMBER, LENGTH, SPEED, FORCE])
            self._line(f"let y{n} = {self._expression(dimension, 3)}")
            self.dimensions[f"y{n}"] = dimension
        for n in bodies:
            factor = self.random.choice(["f0", f"mu*N{n}", f"abs({self._expression(FORCE, 1)})"])
            self._line(f"force N{n} = dio(p{n} - {self._expression(LENGTH, 2)})")
            self._line(f"force F{n} = {factor}*sgn(v{n} - {self._expression(SPEED, 2)})")
        for n in bodies:
            self._line(f"der(p{n}) = {self._expression(SPEED, 2)}")
            self._line(f"m0*der(v{n}) = N{n} - F{n} + {self._expression(FORCE, 3)}")
        self._line(f"output energy = {self._expression(ENERGY, 2)} {{J}}")
        stiffness, damping = Quantity(900.0, STIFFNESS), Quantity(3e-2, TIME)
        both = ("K = ", stiffness, ", beta = ", damping)
        self._line("approximate default dio: ", *both, ", alpha = ", Quantity(2e-2, TIME))
        self._line("approximate default sgn: ", *both)
        self._line("simulate ", Quantity(2.0, TIME), " step ", Quantity(1e-3, TIME))

    def _line(self, *parts: str | Quantity) -> None:
        self.lines.append(parts)

    def _declare(self, keyword: str, name: str, dimension: Dimension, bound: str = "") -> None:
        value = Quantity(self.random.uniform(0.5, 2.0), dimension)
        self._line(f"{keyword} {name} = ", value, bound)
        self.dimensions[name] = dimension

    # expressions: continuous, as the arguments of terms must be

    def _expression(self, dimension: Dimension, depth: int) -> str:
        if depth == 0:
            return self._leaf(dimension)
        a = self._expression(dimension, depth - 1)
        match self.random.randrange(6):
            case 0:
                return f"({a} {self.random.choice('+-')} {self._expression(dimension, depth - 1)})"
            case 1:
                function = self.random.choice(["min", "max"])
                return f"{function}({a}, {self._expression(dimension, depth - 1)})"
            case 2:
                return f"norm([{a}, {self._expression(dimension, depth - 1)}])"
            case 3:
                other = self.random.choice(_SOME)
                rest = tuple(d - o for d, o in zip(dimension, other, strict=True))
                return f"{self._expression(other, depth - 1)}*{self._expression(rest, depth - 1)}"
            case 4:
                other = self.random.choice(_SOME)
                all_of = tuple(d + o for d, o in zip(dimension, other, strict=True))
                divisor = f"({self._base(other)} + abs({self._expression(other, depth - 1)}))"
                return f"{self._expression(all_of, depth - 1)}/{divisor}"
        function = self.random.choice(["sin", "tanh", "exp", "abs"])
        number = f"{function}({self._expression(NUMBER, depth - 1)})"
        return f"{number}*{a}"

    def _leaf(self, dimension: Dimension) -> str:
        fitting = [name for name, known in self.dimensions.items() if known == dimension]
        return self.random.choice([*fitting, *fitting, self._base(dimension)])

    def _base(self, dimension: Dimension) -> str:
        """Write a product of parameters without a power, which libm may round."""
        text = "1.5"
        for name, exponent in zip(("m0", "l0", "t0"), dimension, strict=True):
            text += f"{'*' if exponent > 0 else '/'}{name}" * abs(exponent)
        return text
