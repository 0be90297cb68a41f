"""W in symbols, for small scenes, through SymPy (loaded here and nowhere sooner)."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from math import isfinite
from typing import TYPE_CHECKING, Any

from nsode.analysis.mass import EffectiveMass, effective_mass
from nsode.analysis.scene import Scene
from nsode.expr import TIME, Call, Expr, If, Index, Name, Number, Sum
from nsode.ode import Binding, DifferentialInclusion, LinearSolve, Placed

if TYPE_CHECKING:
    import sympy

#: More multipliers than these are shown in numbers only.
MOST = 8

_LONGEST = 200  # operations in an entry that SymPy is asked to simplify

_MATH = {"sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh"}


class _NoFormulaError(Exception):
    """An entry that has no short formula."""


def formulas(scene: Scene, mass: EffectiveMass) -> tuple[tuple[str, ...], ...] | None:
    """Return W as text; None where SymPy is missing, or the scene is large or has kinks."""
    if len(mass.names) > MOST or find_spec("sympy") is None:
        return None
    import sympy

    placed: list[Placed] = [*scene.inclusion.parameters, *scene.inclusion.states]
    names = [TIME, *(item.name for item in placed if item.range is None)]
    found = _matrix(scene, mass, {name: sympy.Symbol(name, real=True) for name in names})
    return found and tuple(tuple(map(str, found.row(k))) for k in range(found.rows))


def symbolic_mass(
    inclusion: DifferentialInclusion, symbols: Mapping[str, sympy.Basic]
) -> tuple[tuple[str, ...], sympy.ImmutableMatrix | None]:
    """Return the names of the multipliers and W in terms of some symbols.

    A parameter without a symbol counts with its value. There is no matrix where the scene
    has families of terms or its W has kinks.
    """
    import sympy

    scene = Scene(inclusion)
    mass = effective_mass(scene, scene.at(scene.start))
    values = {p.name: p.values[0] for p in inclusion.parameters if p.range is None}
    known = {name: sympy.Rational(repr(v)) for name, v in values.items() if isfinite(v)}
    return mass.names, _matrix(scene, mass, {**known, **symbols})


def _matrix(
    scene: Scene, mass: EffectiveMass, symbols: Mapping[str, sympy.Basic]
) -> sympy.ImmutableMatrix | None:
    import sympy

    if not mass.names or any(term.range for term in scene.inclusion.terms):
        return None
    try:
        rows = _Symbols(scene, symbols).matrix(mass)
    except _NoFormulaError:
        return None
    return sympy.ImmutableMatrix(rows).applyfunc(_tidy)


def _tidy(entry: Any) -> Any:  # noqa: ANN401  SymPy has no types
    import sympy

    return entry if entry.count_ops() > _LONGEST else sympy.factor(sympy.trigsimp(entry))


class _Symbols:
    """Values of definitions as SymPy expressions of parameters and states."""

    def __init__(self, scene: Scene, symbols: Mapping[str, Any]) -> None:
        self.scene = scene
        self.known = dict(symbols)
        definitions = (*scene.definitions, *scene.of_rates.definitions)
        self.definitions = {
            item.name: item.value
            for item in definitions
            if isinstance(item, Binding) and item.range is None
        }
        self.solves = {
            unknown: item
            for item in definitions
            if isinstance(item, LinearSolve) and item.range is None
            for unknown in item.unknowns
        }

    def matrix(self, mass: EffectiveMass) -> list[list[Any]]:
        scene, size = self.scene, len(mass.names)
        motion: dict[tuple[int, str], Any] = {}
        w = [[self.number(0.0)] * size for _ in range(size)]
        for entry in scene.of_motions.entries:
            row = scene.multipliers[entry.row.id].offset
            if entry.column.id in scene.multipliers:
                column = scene.multipliers[entry.column.id].offset
                if mass.degrees[row] == 1:
                    w[row][column] += self.value(entry.value)
            elif entry.ranges or entry.column.at is not None:
                raise _NoFormulaError
            else:
                key = (row, entry.column.id)
                motion[key] = motion.get(key, 0) + self.value(entry.value)
        self._through_states(mass, motion, w)
        return w

    def _through_states(
        self, mass: EffectiveMass, motion: dict[tuple[int, str], Any], w: list[list[Any]]
    ) -> None:
        contacts = {row for e in self.scene.elements if e.is_contact for row in e.rows}
        for entry in self.scene.of_rates.entries:
            if entry.column.id not in self.scene.multipliers:
                continue
            if entry.ranges or entry.row.at is not None:
                raise _NoFormulaError
            column = self.scene.multipliers[entry.column.id].offset
            for row in range(len(w)):
                slope = motion.get((row, entry.row.id))
                direct = row in contacts and mass.degrees[row] == 1
                if slope is not None and not direct:
                    sign = 1 if row in contacts else -1
                    w[row][column] += sign * slope * self.value(entry.value)

    def value(self, expr: Expr) -> Any:  # noqa: ANN401  SymPy has no types
        match expr:
            case Number(number):
                return self.number(number)
            case Name(id, None):
                return self._name(id)
            case Call(function, args):
                return self._call(function, [self.value(arg) for arg in args])
            case If() | Sum() | Index() | Name():
                raise _NoFormulaError
            case _:
                raise NotImplementedError(f"no formula of {type(expr).__name__}")

    def number(self, value: float) -> Any:  # noqa: ANN401
        import sympy

        return sympy.Rational(repr(value))

    def _name(self, name: str) -> Any:  # noqa: ANN401
        if name in self.definitions:
            self.known[name] = self.value(self.definitions.pop(name))
        if name in self.solves:
            self._solve(self.solves.pop(name))
        if name not in self.known:
            raise _NoFormulaError
        return self.known[name]

    def _solve(self, item: LinearSolve) -> None:
        import sympy

        matrix = sympy.Matrix([[self.value(entry) for entry in row] for row in item.matrix])
        right = sympy.Matrix([self.value(entry) for entry in item.right])
        self.known |= zip(item.unknowns, matrix.LUsolve(right), strict=True)

    def _call(self, function: str, args: list[Any]) -> Any:  # noqa: ANN401
        import sympy

        match function:
            case "+":
                return sum(args[1:], args[0])
            case "neg":
                return -args[0]
            case "*":
                return args[0] * args[1]
            case "/":
                return args[0] / args[1]
            case "^":
                return args[0] ** args[1]
            case _ if function in _MATH:
                return getattr(sympy, function)(*args)
            case _:
                raise _NoFormulaError
