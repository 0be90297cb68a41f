"""What must not matter does not: names, order, frames, units, signs and layout of a text.

The oracle is the model as it was. ``NSODE_SEEDS=1000`` changes that many random models.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

import nsode
from nsode.diagnostics import ModelError
from nsode.ode import AugmentedODE, Input, Parameter, State, element_names, size
from support.generate import model
from support.models import MODELS, PATHS
from support.modules import load_module
from support.quantities import Scene
from support.running import Tracer
from support.twins import Twins

EPS = np.finfo(float).eps
SEEDS = int(os.environ.get("NSODE_SEEDS", "10"))
NAME = re.compile(  # past units, ranges, components and numbers
    r"\{[^}]*\}|\.\.|\.\w+|\d+(?:\.(?!\.)\d*)?(?:e[-+]?\d+)?|[A-Za-z_]\w*"
)
DECLARED = re.compile(
    r"^(?:parameter|constant|input|state|let|force|output) (\w+)|(\w+) in ", re.MULTILINE
)
HOSTILE = ["lambda", "int", "np", "dx", "real", "e", "K", "x", "u", "p", "class", "rhs", "inf"]


def texts(seed: int) -> list[str]:
    """Return random models that are not refused: one with families, and a wild one."""
    wild = model(Random(seed))
    try:
        nsode.loads(wild)
    except ModelError:
        return [Twins(seed).texts[0]]
    return [Twins(seed).texts[0], wild]


everywhere = pytest.mark.parametrize(
    "subject", [*PATHS, *range(SEEDS)], ids=lambda s: s.stem if isinstance(s, Path) else str(s)
)


def subjects(subject: Path | int) -> Iterator[tuple[str, Random]]:
    """Yield the texts of a case, comments left out, with what is random about their change."""
    written = [subject.read_text()] if isinstance(subject, Path) else texts(subject)
    seed = subject.stem if isinstance(subject, Path) else subject
    for text in written:
        yield re.sub(r" *#.*", "", text), Random(f"change {seed}")


class Sampled:
    """The rates of a model at named values, through NumPy."""

    def __init__(self, text: str) -> None:
        compiled = nsode.loads(text)
        self.ode: AugmentedODE = compiled.ode
        own = {auxiliary.term for auxiliary in self.ode.auxiliary}
        # A state that several terms share has the name of the first.
        self.has_shared_states = {term.name for term in compiled.inclusion.terms} != own
        self.module = load_module(self.ode)
        self.states = element_names(self.ode.states)

    def points(self, count: int = 3) -> Iterator[tuple[float, NDArray, NDArray, NDArray]]:
        rng = np.random.default_rng(5)
        start, u, p = self.module.init(), np.nan_to_num(self.module.u0), self.module.p0
        yield 0.0, start, u, p
        for k in range(count):
            off = rng.normal(size=start.size) * 10.0 ** rng.integers(-6, 1)
            yield 0.3 * k, start + off, u, p * rng.uniform(0.9, 1.1, size=p.size)

    def rhs(self, t: float, x: NDArray, u: NDArray, p: NDArray) -> NDArray:
        return self.module.rhs(t, x, u, p)


def assert_close(found: NDArray, expected: NDArray, scale: NDArray) -> None:
    fine = np.isfinite(expected) & (scale < 1e200)
    assert np.all(np.abs(found[fine] - expected[fine]) <= 4 * EPS * scale[fine])


# names


def renamed(text: str, random: Random) -> str:
    """Return the text with another name for everything that has one."""
    old = list(dict.fromkeys(a or b for a, b in DECLARED.findall(text)))
    new = list(dict.fromkeys([*old, *HOSTILE, *(f"n{k}" for k in range(len(old)))]))
    chosen = dict(zip(old, random.sample(new, len(old)), strict=True))
    return "\n".join(_renamed_line(line, chosen) for line in text.splitlines()) + "\n"


def _renamed_line(line: str, chosen: dict[str, str]) -> str:
    def swap(match: re.Match[str]) -> str:
        word, behind = match.group(), line[match.end() :]
        is_setting = line.startswith("approximate") and behind.startswith(" =")
        return word if is_setting else chosen.get(word, word)

    return NAME.sub(swap, line)


@everywhere
def test_names_do_not_matter(subject):
    for text, random in subjects(subject):
        before, after = Sampled(text), Sampled(renamed(text, random))
        assert before.ode != after.ode
        np.testing.assert_array_equal(after.module.init(), before.module.init())
        np.testing.assert_array_equal(after.module.p0, before.module.p0)
        for point in before.points():
            np.testing.assert_array_equal(after.rhs(*point), before.rhs(*point))


# order


def shuffled(text: str, random: Random, but_forces: bool) -> str:
    """Return the statements in another order."""
    first, *lines = [line for line in text.splitlines() if line.strip()]
    random.shuffle(lines)
    if but_forces:
        forces = iter([line for line in text.splitlines() if line.startswith("force")])
        lines = [next(forces) if line.startswith("force") else line for line in lines]
    return "\n".join([first, *lines]) + "\n"


def places(names: list[str], before: list[str]) -> list[int]:
    assert sorted(names) == sorted(before)
    return [before.index(name) for name in names]


@everywhere
def test_the_order_of_statements_does_not_matter(subject):
    for text, random in subjects(subject):
        before = Sampled(text)
        after = Sampled(shuffled(text, random, but_forces=before.has_shared_states))
        x_at = places(after.states, before.states)
        p_at = places(*(element_names(m.ode.parameters) for m in (after, before)))
        u_at = places(*(element_names(m.ode.inputs) for m in (after, before)))
        for t, x, u, p in before.points():
            expected, scale = Tracer(before.ode, t, x, u, p).rhs()
            found = after.rhs(t, x[x_at], u[u_at], p[p_at])
            assert_close(found, expected[x_at], scale[x_at])


# signs


def with_signs_turned(text: str) -> str:
    """Return the text with ``-(...sgn(-(theta))...)`` for each force that is a sgn."""
    lines = []
    for line in text.splitlines():
        head, _, value = line.partition(" = ")
        if line.startswith("force") and "sgn(" in value:
            value, brace, unit = value.partition("{")
            line = f"{head} = -({_argument_turned(value)}){brace}{unit}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def _argument_turned(value: str) -> str:
    start = value.index("sgn(") + len("sgn(")
    end, depth = start, 1
    while depth:
        depth += {"(": 1, ")": -1}.get(value[end], 0)
        end += 1
    return f"{value[:start]}-({value[start : end - 1]}){value[end - 1 :]}"


@everywhere
def test_the_sign_of_a_sliding_velocity_does_not_matter(subject):
    for text, _ in subjects(subject):
        before, after = Sampled(text), Sampled(with_signs_turned(text))
        assert after.states == before.states
        turned = [".a" in name for name in before.states]
        sign = np.where(turned, -1.0, 1.0)
        for t, x, u, p in before.points():
            found = sign * after.rhs(t, sign * x, u, p)
            np.testing.assert_array_equal(found, before.rhs(t, x, u, p))


# layout


def _crlf(text: str, random: Random) -> str:
    return text.replace("\n", "\r\n")


def _with_comments(text: str, random: Random) -> str:
    notes = [" # a note", "", "   ", "\n", "\n# model [ ( {", "  # sgn(v)\n\n"]
    return "".join(line + random.choice(notes) + "\n" for line in text.splitlines())


def _with_comments_in_brackets(text: str, random: Random) -> str:
    def broken(match: re.Match[str]) -> str:
        opened = match.group()
        return opened + random.choice(["", "\n", " # ) ]\n   "]) if len(opened) == 1 else opened

    return re.sub(r"\{[^}]*\}|[(\[]", broken, text)


def _spread(text: str, random: Random) -> str:
    return re.sub(r"(\{[^}]*\})| ", lambda m: m.group(1) or random.choice([" ", "  ", "\t"]), text)


LAYOUTS = [_crlf, _with_comments, _with_comments_in_brackets, _spread]


@everywhere
def test_the_layout_of_a_text_does_not_reach_the_c(subject):
    for text, random in subjects(subject):
        expected = code(text)
        for change in LAYOUTS:
            changed = change(text, random)
            assert changed != text
            assert code(changed) == expected, changed


def code(text: str) -> list[str]:
    files = nsode.loads(text).emit("c")
    return [content for name, content in files.items() if not name.endswith(".json")]


# units

SCALES = {
    "m": ("mm", "1000*"),
    "kg": ("g", "1000*"),
    "s": ("ms", "1000*"),
    "m/s": ("km/h", "3.6*"),
    "N": ("kN", "1e-3*"),
    "N/m": ("N/mm", "1e-3*"),
    "m/s^2": ("mm/s^2", "1000*"),
    "rad/s": ("deg/s", "57.29577951308232*"),
    "deg": ("rad", "0.017453292519943295*"),
    "ohm": ("kohm", "1e-3*"),
    "A": ("mA", "1000*"),
}
QUANTITY = re.compile(r"= ([-\d.e]+|\[[-\d.e, ]+\]) +\{([^}]*)\}")


def in_other_units(text: str) -> str:
    def converted(match: re.Match[str]) -> str:
        value, unit = match.groups()
        other, factor = SCALES.get(unit, (unit, ""))
        return f"= {factor}{value} {{{other}}}"

    return QUANTITY.sub(converted, text)


@everywhere
def test_the_units_of_the_numbers_do_not_matter(subject):
    if isinstance(subject, Path):
        text = subject.read_text()
        changed = in_other_units(text)
    else:
        text, changed = Scene(subject).texts
    assert changed != text
    before, after = Sampled(text), Sampled(changed)
    for value in ("p0", "u0"):
        expected = getattr(before.module, value)
        np.testing.assert_allclose(getattr(after.module, value), expected, rtol=4 * EPS)
    start = before.module.init()
    np.testing.assert_allclose(after.module.init(), start, rtol=8 * EPS)
    for point in before.points():
        np.testing.assert_array_equal(after.rhs(*point), before.rhs(*point))


@pytest.mark.parametrize("seed", range(SEEDS))
def test_the_system_of_units_does_not_matter(seed):
    scene, random = Scene(seed), Random(seed)
    system = [2.0 ** random.randint(-3, 3) for _ in range(3)]  # so that no number is rounded
    sampled = Sampled(scene.texts[0])

    def scale(items: Sequence[State | Input | Parameter], extra: int = 0) -> NDArray:
        exponents = [scene.dimension(item.name) for item in items]
        return np.array([np.prod(np.power(system, e)) for e in exponents]) / system[2] ** extra

    ode = sampled.ode
    x_scale, u_scale, p_scale = map(scale, (ode.states, ode.inputs, ode.parameters))
    for t, x, u, p in sampled.points(20):
        found = sampled.rhs(t * system[2], x * x_scale, u * u_scale, p * p_scale)
        np.testing.assert_array_equal(found, scale(ode.states, 1) * sampled.rhs(t, x, u, p))


# frames

STATE = re.compile(
    r"^state (\w+)(\[\w+ in [^\]]*\])?(?:\[(\d)\])? += ([^{\n]*?) *(\{.*\})?$", re.MULTILINE
)


def in_another_frame(text: str, random: Random) -> tuple[str, list[int]]:
    """Return the text with some axes the other way, and the sign of each state's component.

    The state ``p`` is ``p_`` in the other frame, and a ``let`` turns it back for what reads it.
    """
    ways: list[int] = []
    turns: dict[str, str] = {}

    def declared(match: re.Match[str]) -> str:
        name, family, size, value, unit = (group or "" for group in match.groups())
        ways.extend(own := random.choices([-1, 1], k=int(size or 1)))
        turns[name] = turn = _diagonal(own) if size else str(own[0])
        shape = family + (f"[{size}]" if size else "")
        element = f"[{family[1:].split()[0]}]" if family else ""
        return (
            f"state {name}_{shape} = {turn}*({value}) {unit}\n"
            f"let {name}{shape} = {turn}*{name}_{element}"
        )

    def derived(match: re.Match[str]) -> str:
        name, element = match.groups()
        if name not in turns:  # a function of time
            return match[0]
        return f"({turns[name]}*der({name}_{element}))"

    return re.sub(r"der\((\w+)([^)]*)\)", derived, STATE.sub(declared, text)), ways


def _diagonal(entries: list[int]) -> str:
    columns = range(len(entries))
    rows = [[entry if k == j else 0 for j in columns] for k, entry in enumerate(entries)]
    return str(rows)


@everywhere
def test_the_direction_of_axes_does_not_matter(subject):
    for text, random in subjects(subject):
        before = Sampled(text)
        changed, ways = in_another_frame(text, random)
        after = Sampled(changed)
        ways += [1] * len(before.ode.auxiliary)
        sign = np.repeat(ways, [size(state) for state in before.ode.states])
        np.testing.assert_array_equal(sign * after.module.init(), before.module.init())
        for t, x, u, p in before.points():
            found = sign * after.rhs(t, sign * x, u, p)
            np.testing.assert_array_equal(found, before.rhs(t, x, u, p))


def mirrored_blocks(text: str) -> str:
    """Return two_blocks_conveyor with x to the left."""
    for old, new in [
        ("dio(p1.x)", "dio(-p1.x)"),
        ("dio(p2.x - p1.x)", "dio(p1.x - p2.x)"),
        ("sgn(v2.x + u)", "sgn(v2.x - u)"),
        ("[N1 - N2, ", "[N2 - N1, "),
        ("[N2 - F3, ", "[-N2 - F3, "),
    ]:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return text


def unchanged(text: str) -> str:
    return text


#: The change of the text, and the states whose sign changes in the mirror. An angular velocity
#: across the mirror keeps its sign, one along it does not.
MIRRORS: dict[str, tuple[Callable[[str], str], list[str]]] = {
    "frictional_contact": (unchanged, ["p.x", "v.x", "F.a.x"]),
    "rolling_sphere": (unchanged, ["p.x", "v.x", "w.y", "w.z", "q[3]", "q[4]", "F.a.x"]),
    "two_blocks_conveyor": (mirrored_blocks, ["p1.x", "p2.x", "v1.x", "v2.x", "F3.a"]),
    "dry_friction": (lambda text: text.replace("fe - F", "-fe - F"), ["p", "v", "F.a"]),
}


@pytest.mark.parametrize("name", MIRRORS)
def test_a_mirrored_scene_moves_as_the_mirror_shows(name):
    change, flipped = MIRRORS[name]
    text = (MODELS / f"{name}.di").read_text()
    before, after = Sampled(text), Sampled(change(text))
    assert set(flipped) <= set(before.states), before.states
    sign = np.where([state in flipped for state in before.states], -1.0, 1.0)
    for t, x, u, p in before.points(20):
        found = sign * after.rhs(t, sign * x, u, p)
        np.testing.assert_array_equal(found, before.rhs(t, x, u, p))


def test_these_comparisons_can_fail():
    text = (MODELS / "frictional_contact.di").read_text()
    before, after = Sampled(text), Sampled(text.replace("mu*N*sgn", "1.000001*mu*N*sgn"))
    moved = [np.array_equal(before.rhs(*q), after.rhs(*q)) for q in before.points(20)]
    assert not all(moved)
