"""Velocity Verlet: kick, drift, kick; e and a by the exact exponential of their branch.

The rates (24) and (18a) are piecewise linear in e and a. With psi, theta and chi held, the
flow of a branch ``x' = d/tau``, where d falls by one as x rises by one, is

    x + (1 - exp(-h/tau))*d

and (24), the larger of two such rates, becomes the larger of their flows. (18a) is
``(sat(Z, a + beta*theta) - a)/beta``: with ``gain = 1 - exp(-h/beta)`` and ``h/gain`` in the
place of beta inside of ``sat`` it takes ``a + h*theta`` in stick and decays to the level in
slip. A flow is exact as long as it stays in one branch; where the branch changes inside a
step, the value is that of the branch that bounds the flow: e is too small, and a is too
close to its level, by an amount of the order of h^2.

The order is 2. Where forces depend on velocities, as those of friction do while it sticks or
while its direction turns, it is 1: each kick takes the velocity that it finds. A step calls
the rates twice, as Heun's does; a loop that carries them calls them once, where they are the
same at the end of a step and at the start of the next.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from nsode.diagnostics import Diagnostic, Label, ModelError
from nsode.expr import TIME, Call, Expr, Index, Name, Number, add, divide, multiply, negate
from nsode.ode import (
    AugmentedODE,
    AuxiliaryState,
    Binding,
    Definition,
    Rate,
    SetValuedTerm,
    System,
    defined,
    expressions,
)
from nsode.passes.prune import reads

#: The size of the step, in the values that :func:`split` returns.
STEP = Name("verlet.h")


@dataclass(frozen=True, slots=True)
class Verlet:
    """The method; it needs no numbers of its own."""

    name: str = "verlet"
    title: str = "velocity Verlet, e and a by exact exponentials"
    order: int = 2


VERLET = Verlet()


@dataclass(frozen=True, slots=True)
class Parts:
    """What the stages of a step compute, each as an ODE with fewer rates.

    ``drift`` holds the rates of the positions; ``press`` and ``slide`` hold, in the places
    of rates, the values of e and of a one step later. ``kicked`` names the other states.
    """

    drift: AugmentedODE
    press: AugmentedODE
    slide: AugmentedODE
    kicked: frozenset[str]


def split(ode: AugmentedODE) -> Parts:
    """Return the parts of an ODE, told by what its rates read.

    Raises
    ------
    ModelError
        NS501 if a term follows another law than the paper's.
    """
    contacts, frictions = _laws(ode)
    gains = _Gains()
    press = [gains.relaxed(item) for item in contacts]
    slide = [gains.relaxed(item) for item in frictions]
    held = list(_with_long_beta(ode.bindings, frictions, gains))
    kicked = velocities(ode)
    appended = {item.name for item in ode.auxiliary}
    moved = [rate for rate in ode.rates if rate.state not in kicked | appended]
    return Parts(
        replace(ode, rates=tuple(moved)),
        replace(ode, rates=tuple(press), bindings=(*gains.bindings, *ode.bindings)),
        replace(ode, rates=tuple(slide), bindings=(*gains.bindings, *held)),
        frozenset(kicked),
    )


def velocities(system: System) -> set[str]:
    """Return the states that a step kicks, of an inclusion or of the ODE made from it.

    They are the states whose rates read a force of a set-valued term, and those that are
    the rate of a position which their own rate reads: a mass on a spring.
    """
    auxiliary = {item.name for item in system.auxiliary} if isinstance(system, AugmentedODE) else ()
    forces = {name for item in system.bindings for name in _multipliers(item)}.union(auxiliary)
    rests = _rests(system)
    moves: dict[str, set[str]] = {}
    for rate in system.rates:
        if isinstance(rate.value, Name):
            moves.setdefault(rate.value.id, set()).add(rate.state)
    kicked = {state for state, read in rests.items() if read & forces}.difference(auxiliary)
    for state in system.states:
        positions = moves.get(state.name, set()) - {state.name} - kicked
        if rests.get(state.name, set()) & positions:
            kicked.add(state.name)
    return kicked


def carries(ode: AugmentedODE) -> bool:
    """Whether the kicks at the end of a step are those at the start of the next.

    They are where no force reads a velocity, the time or an input.
    """
    kicked, rests = velocities(ode), _rests(ode)
    changing = {TIME, *kicked, *(entry.name for entry in ode.inputs)}
    return all(rests[state].isdisjoint(changing) for state in kicked)


def _rests(system: System) -> dict[str, set[str]]:
    """Return the states, multipliers, inputs and parameters on which each rate rests."""
    behind = _behind(system.bindings)
    rests: dict[str, set[str]] = {}
    for rate in system.rates:
        read = (behind.get(name, {name}) for name in reads(rate.value))
        rests.setdefault(rate.state, set()).update(*read)
    return rests


def _multipliers(item: Definition) -> tuple[str, ...]:
    return item.multiplier if isinstance(item, SetValuedTerm) else ()


def _behind(bindings: Iterable[Definition]) -> dict[str, set[str]]:
    """Return the states, multipliers, inputs and parameters on which each binding rests."""
    behind: dict[str, set[str]] = {}
    for item in bindings:
        found = set(_multipliers(item))
        for name in reads(*expressions(item)):
            found |= behind.get(name, {name})
        for name in defined(item):
            behind.setdefault(name, set()).update(found)
    return behind


@dataclass(slots=True)
class _Gains:
    """The bindings ``1 - exp(-h/tau)``, one for each time constant tau."""

    known: dict[Expr, Binding] = field(default_factory=dict)

    @property
    def bindings(self) -> tuple[Binding, ...]:
        return tuple(self.known.values())

    def of(self, tau: Expr) -> Name:
        if tau not in self.known:
            name = f"verlet.gain{len(self.known) + 1}"
            self.known[tau] = Binding(name, _gain(tau), role="part")
        return Name(self.known[tau].name)

    def relaxed(self, item: AuxiliaryState) -> Rate:
        """Return the value of an auxiliary state one step later, in the place of its rate."""
        value = self._flow(item.rate, _own(item))
        return Rate(item.name, value, item.range, span=item.span)

    def _flow(self, rate: Expr, at: Name) -> Expr:
        match rate:
            case Call("max", (left, right)):
                return Call("max", (self._flow(left, at), self._flow(right, at)))
            case Call("/", (distance, tau)):
                return add(at, multiply(self.of(tau), distance))
            case _:
                raise NotImplementedError(f"no flow for {rate}")


def _gain(tau: Expr) -> Expr:
    """Return ``1 - exp(-h/tau)`` to full relative precision, however small the step is."""
    half = Call("tanh", (divide(STEP, multiply(Number(2.0), tau)),))
    return divide(multiply(Number(2.0), half), add(Number(1.0), half))


def _with_long_beta(
    bindings: Iterable[Definition], frictions: Iterable[AuxiliaryState], gains: _Gains
) -> Iterator[Definition]:
    """Yield the bindings with ``a + h/gain*theta`` for each ``a + beta*theta``."""
    cut_off = {_cut_off(item) for item in frictions}
    for item in bindings:
        match item:
            case Binding(name, Call("+", (a, Call("*", (beta, theta))))) if name in cut_off:
                longer = divide(STEP, gains.of(beta))
                yield replace(item, value=add(a, multiply(longer, theta)))
            case _:
                yield item


def _cut_off(item: AuxiliaryState) -> str:
    """Return the name of what (18) cuts off at the level: ``F.z.x`` for ``F.a.x``."""
    return f"{item.term}.z{item.name.removeprefix(f'{item.term}.a')}"


def _laws(ode: AugmentedODE) -> tuple[list[AuxiliaryState], list[AuxiliaryState]]:
    """Return the states e and the states a; refuse what is neither."""
    values = {item.name: item.value for item in ode.bindings if isinstance(item, Binding)}
    contacts = [item for item in ode.auxiliary if _is_contact(item)]
    frictions = [item for item in ode.auxiliary if _is_friction(item, values)]
    papers = {item.span for item in (*contacts, *frictions)}
    found: list[Binding | AuxiliaryState] = [*ode.auxiliary]
    found += [item for item in ode.bindings if isinstance(item, Binding) and item.role == "term"]
    others = {item.span: _refusal(item) for item in found if item.span not in papers}
    if others:
        raise ModelError(others.values(), ode.source)
    return contacts, frictions


def _refusal(item: Binding | AuxiliaryState) -> Diagnostic:
    name = item.name.partition(".")[0]
    return Diagnostic(
        "NS501",
        f"`{VERLET.name}` steps the paper's law alone, and `{name}` follows another",
        (Label(item.span, "this term"),),
        help="choose another method, such as rk4",
    )


def _is_contact(item: AuxiliaryState) -> bool:
    """Whether a state is the e of (24)."""
    match item.rate:
        case Call("max", (Call("/", (free, _)), Call("/", (Call("neg", (Call("+", _),)), _)))):
            return free == negate(_own(item))
        case _:
            return False


def _is_friction(item: AuxiliaryState, values: Mapping[str, Expr]) -> bool:
    """Whether a state is the a of (18)."""
    match item.rate, values.get(_cut_off(item)):
        case Call("/", (Call("+", (Name(), back)), tau)), Call("+", (a, Call("*", (beta, _)))):
            return a == _own(item) and back == negate(a) and beta == tau
        case _:
            return False


def _own(item: AuxiliaryState) -> Name:
    """Return an auxiliary state as its own rate reads it."""
    return Name(item.name, None if item.range is None else Index(item.range.variable))
