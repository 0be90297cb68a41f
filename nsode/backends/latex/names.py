r"""Names as a paper prints them: ``N.K`` is K_N, ``mu1`` is \mu_1, ``p1.x`` is p_{1x}."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

from nsode.expr import TIME
from nsode.ode import (
    DOT_SUFFIX,
    RATE_SUFFIX,
    Binding,
    LinearSolve,
    Placed,
    SetValuedTerm,
    System,
    defined,
)

_SMALL = (
    *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa"),
    *("lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi"),
    "omega",
)
_CAPITAL = (
    *("Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi"),
    "Omega",
)
_GREEK = frozenset({*_SMALL, *_CAPITAL})
_DERIVED = (DOT_SUFFIX, RATE_SUFFIX)


@dataclass(frozen=True, slots=True)
class Symbol:
    """A letter or word with its subscripts."""

    base: str
    subscripts: tuple[str, ...] = ()

    def __str__(self) -> str:
        if not self.subscripts:
            return self.base
        return f"{self.base}_{{{_join(self.subscripts)}}}"

    def at(self, index: str) -> Symbol:
        """Return the symbol with one more subscript."""
        return replace(self, subscripts=(*self.subscripts, index))

    @property
    def dot(self) -> Symbol:
        """The symbol of its rate."""
        once = self.base.removeprefix(r"\dot")
        return replace(self, base=rf"\dot{{{once}}}" if once == self.base else rf"\ddot{once}")


def _join(subscripts: tuple[str, ...]) -> str:
    text = subscripts[0]
    for before, after in pairwise(subscripts):
        tight = before.isdecimal() and len(after) == 1 and after.isalpha()
        text += after if tight else f",{after}"
    return text


def word(text: str) -> Symbol:
    """Return one word: Greek, a letter with a subscript, or set upright as it is."""
    head, *rest = [part for part in text.split("_") if part] or [text]
    match = re.fullmatch(r"(.*?[A-Za-z])(\d+)", head)
    stem, digits = (match[1], (match[2],)) if match else (head, ())
    subscripts = (*digits, *(_subscript(part) for part in rest))
    if stem in _GREEK:
        return Symbol(rf"\{stem}", subscripts)
    if len(stem) == 2 and stem.isalpha() and stem[1].islower():
        return Symbol(stem[0], (stem[1], *subscripts))
    if len(stem) == 1:
        return Symbol(stem, subscripts)
    return Symbol(rf"\mathit{{{escape(stem)}}}", subscripts)


def _subscript(text: str) -> str:
    if text in _GREEK:
        return rf"\{text}"
    return text if len(text) == 1 or text.isdecimal() else rf"\mathrm{{{escape(text)}}}"


def escape(text: str) -> str:
    """Return text with nothing in it that TeX would act on."""
    return re.sub(r"[^A-Za-z0-9.]", lambda match: _escaped(match[0]), text)


def unit(text: str) -> str:
    """Return a unit such as ``kg*m^2/s`` set upright."""
    parts = re.split(r"(\*|\^-?\d+)", text)  # every second one is an operator
    shown = (_operator(part) if k % 2 else escape(part) for k, part in enumerate(parts))
    return rf"\mathrm{{{''.join(shown)}}}"


def _operator(part: str) -> str:
    return r" \, " if part == "*" else f"^{{{part[1:]}}}"


def _escaped(character: str) -> str:
    if character in "_#$%&{} ":
        return f"\\{character}"
    if character in "\\^~":
        return _SPELT[character]
    return character if " " < character < "\x7f" else "?"


_SPELT = {"\\": r"\textbackslash{}", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}"}


def symbols(*systems: System) -> Mapping[str, Symbol]:
    """Return a symbol for each name of some systems that share names, one to one."""
    attributes = {name for system in systems for name in _attributes(system)}
    found: dict[str, Symbol] = {TIME: Symbol("t")}
    taken = {"t"}
    for name in dict.fromkeys(name for system in systems for name in _names(system)):
        symbol = _attribute(name) if name in attributes else _component(name)
        if str(symbol) in taken:
            symbol = Symbol(rf"\mathtt{{{escape(name)}}}")
        taken.add(str(symbol))
        found[name] = symbol
    return found


def _attribute(name: str) -> Symbol:
    """Return ``F.a.x`` as a_{F,x}: what belongs to a term has the term as a subscript."""
    term, attribute, *components = name.split(".")
    symbol = word(attribute).at(str(word(term)))
    return replace(symbol, subscripts=(*symbol.subscripts, *components))


def _component(name: str) -> Symbol:
    for suffix in _DERIVED:
        if name.endswith(suffix):
            return _component(name.removesuffix(suffix)).dot
    head, *components = re.split(r"\.|\[|\]\.?", name)
    symbol = word(head)
    return replace(symbol, subscripts=(*symbol.subscripts, *filter(None, components)))


def _attributes(system: System) -> Iterable[str]:
    """Yield the names that belong to a set-valued term: its constants, states and parts."""
    yield from (p.name for p in system.parameters if p.constant_of is not None)
    yield from (item.name for item in getattr(system, "auxiliary", ()))
    for item in system.bindings:
        is_part = isinstance(item, Binding) and item.role == "part"
        yield from (n for n in defined(item) if is_part and "." in n and not n.endswith(_DERIVED))


def _names(system: System) -> Iterable[str]:
    placed: list[Placed] = [*system.states, *system.parameters, *system.inputs]
    yield from (item.name for item in placed)
    for definition in system.bindings:
        match definition:
            case Binding(name=name):
                yield name
            case LinearSolve(unknowns=unknowns):
                yield from unknowns
            case SetValuedTerm(multiplier=multiplier):
                yield from multiplier
    yield from (output.name for output in system.outputs)
