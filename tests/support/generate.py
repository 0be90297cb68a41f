"""Random models that follow the types of the language, and damage to their text."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random

from nsode.expr import FUNCTIONS
from nsode.syntax.words import RESERVED

_UNITS = ["", " {1}", " {m}", " {m/s}", " {kg}", " {N/m}", " {deg}"]
_FUNCTIONS = ["sin", "cos", "tan", "exp", "tanh", "atan", "abs", "sqrt", "log", "cosh"]
_RELATIONS = ["<", "<=", ">", ">=", "==", "!="]


@dataclass
class ModelWriter:
    """Writes one model; whatever it writes can be parsed, most of it can be compiled."""

    random: Random
    lines: list[str] = field(default_factory=list)
    scalars: list[str] = field(default_factory=lambda: ["t"])
    nonnegative: list[str] = field(default_factory=list)
    vectors: dict[str, int] = field(default_factory=dict)
    families: list[str] = field(default_factory=list)
    forces: list[tuple[str, str]] = field(default_factory=list)
    count: int = 0
    with_units: bool = False

    def write(self) -> str:
        chance = self.random.random
        self.with_units = chance() < 0.2
        self.lines.append("model fuzz")
        self._repeat(self.parameter, 3)
        if chance() < 0.3:
            self.lines.append(f"constant n = {self.random.randint(0, 5)}")
            self._repeat(self.family, 2)
        if chance() < 0.3:
            self.lines.append(f"input u = {self.number()}{self.unit()}")
            self.scalars.append("u")
        states = [self.state() for _ in range(self.random.randint(1, 4))]
        self._repeat(self.motion, 1)
        self._repeat(self.let, 3)
        self._repeat(self.force, 3)
        for name, size in states:
            self.equation(name, size)
        self._repeat(self.output, 2)
        for name, kind in self.forces:
            self.approximate(name, kind)
        if chance() < 0.5:
            self.lines.append("simulate 1 {s} step 1e-3 {s} method rk4")
        return "\n".join(self.lines) + "\n"

    def _repeat(self, write: Callable[[], object], most: int) -> None:
        for _ in range(self.random.randint(0, most)):
            write()

    def fresh(self, stem: str) -> str:
        self.count += 1
        return f"{stem}{self.count}"

    # declarations

    def parameter(self) -> None:
        name = self.fresh("c")
        bound = self.random.choice(["", " >= 0", " > 0"])
        self.lines.append(f"parameter {name} = {self.number()}{self.unit()}{bound}")
        self.scalars.append(name)
        self.nonnegative.append(name)

    def state(self) -> tuple[str, int]:
        name, size = self.fresh("x"), self.random.choice([1, 1, 1, 2, 3])
        if size == 1:
            self.lines.append(f"state {name} = {self.number()}{self.unit()}")
            self.scalars.append(name)
        else:
            items = ", ".join(self.number() for _ in range(size))
            self.lines.append(f"state {name}[{size}] = [{items}]{self.unit()}")
            self.vectors[name] = size
        return name, size

    def family(self) -> None:
        name = self.fresh("w")
        rate = self.random.choice([f"-{name}[i]", f"(if i > 1 then {name}[i-1] else 0)"])
        self.lines.append(f"state {name}[i in 1..n] = {self.number()}*i")
        self.lines.append(f"for i in 1..n: der({name}[i]) = {rate}")
        if self.random.random() < 0.3:
            self.lines.append(f"for i in 1..n: assume abs({name}[i]) >= {name}[i]")
        self.scalars.append(f"sum(j in 1..n: {name}[j]^2)")

    def let(self) -> None:
        name = self.fresh("y")
        self.lines.append(f"let {name} = {self.scalar(3)}")
        self.scalars.append(name)

    def motion(self) -> None:
        name, known = self.fresh("r"), ModelWriter(self.random)
        self.lines.append(f"let {name} = {known.scalar(2)}")
        self.scalars += [name, f"der({name})", f"der(der({name}))"]

    def force(self) -> None:
        name = self.fresh("F")
        if self.random.random() < 0.5:
            self.lines.append(f"force {name} = dio({self.argument()})")
            self.forces.append((name, "dio"))
            self.nonnegative.append(name)
        else:
            chi = "*".join(self.random.sample(self.nonnegative, min(2, len(self.nonnegative))))
            self.lines.append(f"force {name} = {chi or '1'}*sgn({self.argument()})")
            self.forces.append((name, "sgn"))

    def argument(self) -> str:
        if self.random.random() < 0.2:
            return self.scalar(2)
        return f"{self.leaf()}*{self.number()} - {self.leaf()}"

    def equation(self, name: str, size: int) -> None:
        terms = [f"{self.random.choice(['', '-'])}{force}" for force, _ in self.forces]
        force = f" + ({' + '.join(terms) or '0'})" if self.random.random() < 0.5 else ""
        if size == 1:
            mass = self.random.choice(["", "2*", "1/3*"])
            self.lines.append(f"{mass}der({name}) = {self.scalar(3)}{force}")
        else:
            self.lines.append(f"der({name}) = {self.vector(size, 2)}")

    def output(self) -> None:
        self.lines.append(f"output {self.fresh('o')} = {self.scalar(2)}{self.unit()}")

    def approximate(self, name: str, kind: str) -> None:
        alpha = ", alpha = 2e-3" if kind == "dio" else ""
        self.lines.append(f"approximate {name}: K = 1e5, beta = 4e-3{alpha}")

    # expressions

    def scalar(self, depth: int) -> str:
        if depth == 0 or self.random.random() < 0.2:
            return self.leaf()
        return self.random.choice(self._operations)(self, depth - 1)

    def leaf(self) -> str:
        choices = [*self.scalars, self.number()]
        choices += [f"{name}.x" for name in self.vectors] + [f"{v}[2]" for v in self.vectors]
        return self.random.choice(choices)

    def _binary(self, depth: int) -> str:
        operator = self.random.choice([" + ", " - ", "*", "/"])
        return f"({self.scalar(depth)}{operator}{self.scalar(depth)})"

    def _sum(self, depth: int) -> str:
        return f"({' + '.join(self.scalar(depth) for _ in range(3))})"

    def _power(self, depth: int) -> str:
        return f"({self.scalar(depth)})^{self.random.choice(['2', '3', '-1', '0.5'])}"

    def _negative(self, depth: int) -> str:
        return f"(-{self.scalar(depth)})"

    def _call(self, depth: int) -> str:
        return f"{self.random.choice(_FUNCTIONS)}({self.scalar(depth)})"

    def _two(self, depth: int) -> str:
        function = self.random.choice(["min", "max", "atan2", "mod"])
        return f"{function}({self.scalar(depth)}, {self.scalar(depth)})"

    def _choice(self, depth: int) -> str:
        then, otherwise = self.scalar(depth), self.scalar(depth)
        return f"(if {self.condition(depth)} then {then} else {otherwise})"

    def _norm(self, depth: int) -> str:
        size = self.random.choice([2, 3])
        return f"norm({self.vector(size, depth)})"

    def _dot(self, depth: int) -> str:
        return f"dot({self.vector(3, depth)}, {self.vector(3, depth)})"

    _operations = (_binary, _sum, _power, _negative, _call, _two, _choice, _norm, _dot)

    def condition(self, depth: int) -> str:
        relation = f"{self.scalar(depth)} {self.random.choice(_RELATIONS)} {self.scalar(depth)}"
        if depth and self.random.random() < 0.3:
            word = self.random.choice(["and", "or"])
            return f"{relation} {word} not ({self.condition(depth - 1)})"
        return relation

    def vector(self, size: int, depth: int) -> str:
        fitting = [name for name, known in self.vectors.items() if known == size]
        if fitting and self.random.random() < 0.5:
            return self.random.choice(fitting)
        if depth and self.random.random() < 0.4:
            return f"({self.vector(size, depth - 1)} - {self.vector(size, depth - 1)})"
        return f"[{', '.join(self.scalar(max(0, depth - 1)) for _ in range(size))}]"

    def number(self) -> str:
        return self.random.choice(["0", "1", "2", "0.5", "1e-3", "3.7", "12", "1e5", "9.8"])

    def unit(self) -> str:
        return self.random.choice(_UNITS) if self.with_units else ""


def model(random: Random) -> str:
    """Return the text of a random model."""
    return ModelWriter(random).write()


# damage

_TOKEN = re.compile(r"[A-Za-z_]\w*|[0-9.]+|\s+|.", re.DOTALL)
_SPECIAL = ["1e5", "1e999", "1e-400", "010", "0x1", "9^9^9^9", "1..n", "dio1", "{N/m}", "{}"]
_WORDS = [
    *sorted(RESERVED | set(FUNCTIONS)),
    *("der", "dio", "sgn", "dot", "cross", "transpose", "qmul", "t", "pi", "n", "i", "x", "K"),
    *"()[]{},:.=!;#'|&_012\n",
    *("..", *_SPECIAL),
]
_BYTES = b"\x00\xff\x80\xc3\xe2\x84\xaa\r\n\t (){}[]#.-^=0e1"


def damage_tokens(random: Random, text: str) -> str:
    """Return a text with a few tokens lost, doubled, moved or replaced."""
    tokens = _TOKEN.findall(text)
    for _ in range(random.randint(1, 3)):
        at = random.randrange(len(tokens) + 1)
        match random.randrange(9):
            case 0:
                del tokens[at : at + random.randint(1, 3)]
            case 1:
                tokens[at:at] = [random.choice(_WORDS)]
            case 2:
                tokens[at : at + 1] = [random.choice(_WORDS)]
            case 3:
                tokens[at:at] = tokens[at : at + random.randint(1, 12)]
            case 4:
                tokens[at : at + 1] = tokens[at : at + 1] * random.choice([2, 70, 400])
            case _:
                _replace_by_a_like_one(random, tokens)
    return "".join(tokens)


def _replace_by_a_like_one(random: Random, tokens: list[str]) -> None:
    """Replace a name by a name, a number by a number, a sign by a sign: often still a model."""
    is_kind = random.choice([str.isidentifier, str.isidentifier, str.isdigit, _is_operator])
    places = [i for i, token in enumerate(tokens) if is_kind(token)]
    if places:
        tokens[random.choice(places)] = tokens[random.choice(places)]


def _is_operator(token: str) -> bool:
    return token in tuple("+-*/^<>")


def damage_bytes(random: Random, content: bytes) -> bytes:
    """Return bytes with a few of them changed."""
    changed = bytearray(content)
    for _ in range(random.randint(1, 4)):
        at = random.randrange(len(changed) + 1)
        match random.randrange(4):
            case 0:
                del changed[at : at + random.randint(1, 8)]
            case 1:
                changed[at:at] = bytes([random.choice(_BYTES)])
            case 2:
                changed[at : at + 1] = bytes([random.randrange(256)])
            case 3:
                changed[at:at] = changed[at : at + random.randint(1, 40)]
    return bytes(changed)
