"""The bodies of ``rhs``, ``out`` and ``init`` as lines of Python."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from nsode.backends.numpy.lower import Environment, depends_on_index, lower, may_be_plain
from nsode.expr import Expr, IndexRange, Number
from nsode.ode import (
    AugmentedODE,
    Binding,
    LinearSolve,
    Output,
    Placed,
    Rate,
    Slot,
    State,
    expressions,
    layout,
)
from nsode.passes.prune import needed, reads
from nsode.passes.split import pieces


@dataclass(frozen=True, slots=True)
class Writer:
    """Writes lines for one ODE, whose families have been split."""

    ode: AugmentedODE
    env: Environment

    def rhs(self) -> list[str]:
        """Return the lines that fill ``dx``."""
        slots = layout(self.ode.states)
        return [
            *self.prepare(rate.value for rate in self.ode.rates),
            "dx = np.empty(NX, dtype=real)",
            *(self._place("dx", slots[rate.state], rate) for rate in self.ode.rates),
        ]

    def out(self) -> list[str]:
        """Return the lines that fill ``y``."""
        slots = layout(self.ode.outputs)
        return [
            *self.prepare(output.value for output in self.ode.outputs),
            "y = np.empty(NY, dtype=real)",
            *self._items("y", slots, [(item, item.value) for item in self.ode.outputs]),
        ]

    def init(self) -> list[str]:
        """Return the lines that fill ``x``, zero so far: own states, then appended ones."""
        slots = layout(self.ode.states)
        appended = {item.name for item in self.ode.auxiliary}
        nonzero = [(s, s.initial) for s in self.ode.states if s.initial != Number(0.0)]
        own = [(s, value) for s, value in nonzero if s.name not in appended]
        later = [(s, value) for s, value in nonzero if s.name in appended]
        first = list(self.prepare(value for _, value in own))
        second = self.prepare(value for _, value in later)
        return [
            *first,
            *self._items("x", slots, own),
            *(line for line in second if line not in first),
            *self._items("x", slots, later),
        ]

    def prepare(self, roots: Iterable[Expr]) -> Iterator[str]:
        """Yield the lines for everything that some expressions read."""
        wanted = reads(*roots)
        definitions = needed(self.ode.bindings, wanted)
        for vector, items in (
            ("p", self.ode.parameters),
            ("u", self.ode.inputs),
            ("x", self.ode.states),
        ):
            yield from self._unpack(vector, items, wanted)
        started: set[str] = set()
        for item in definitions:
            match item:
                case Binding():
                    yield from self._binding(item, started)
                case LinearSolve():
                    yield from self._solve(item, started)
                case _:
                    raise NotImplementedError(f"no NumPy rule for {type(item).__name__}")

    def _unpack(self, vector: str, items: Sequence[Placed], wanted: set[str]) -> Iterator[str]:
        for name, (offset, range) in layout(items).items():
            if name in wanted:
                at = f"{offset}" if range is None else f"{offset}:{offset + len(range)}"
                yield f"{self.env.spelling[name]} = {vector}[{at}]"

    def _binding(self, item: Binding, started: set[str]) -> Iterator[str]:
        name, whole = self.env.spelling[item.name], self.env.ranges[item.name]
        if item.range is None or whole is None:
            text = lower(item.value, self.env)
            # a number of Python's would raise where one of NumPy's divides by zero
            yield f"{name} = real({text})" if may_be_plain(item.value) else f"{name} = {text}"
        elif len(item.range) == len(whole):
            yield f"{name} = {self._family(item.value, item.range)}"
        else:
            yield from self._start(item.name, started)
            yield self._piece(name, 0, whole, item.range, item.value)

    def _start(self, name: str, started: set[str]) -> Iterator[str]:
        whole = self.env.ranges[name]
        if whole is not None and name not in started:
            started.add(name)
            yield f"{self.env.spelling[name]} = np.empty({len(whole)}, dtype=real)"

    def _family(self, value: Expr, range: IndexRange) -> str:
        text = lower(value, self.env.inside(range))
        if len(range) > 1 and depends_on_index(value, range.variable):
            return text
        return f"np.full({len(range)}, {text}, dtype=real)"

    def _piece(
        self, target: str, offset: int, whole: IndexRange, range: IndexRange, value: Expr
    ) -> str:
        start = offset + range.first - whole.first
        at = f"{start}" if len(range) == 1 else f"{start}:{start + len(range)}"
        return f"{target}[{at}] = {lower(value, self.env.inside(range))}"

    def _place(self, target: str, slot: Slot, rate: Rate) -> str:
        if slot.range is None or rate.range is None:
            return f"{target}[{slot.offset}] = {lower(rate.value, self.env)}"
        return self._piece(target, slot.offset, slot.range, rate.range, rate.value)

    def _items(
        self,
        target: str,
        slots: dict[str, Slot],
        items: Iterable[tuple[State | Output, Expr]],
    ) -> Iterator[str]:
        for item, value in items:
            slot = slots[item.name]
            if item.range is None:
                yield f"{target}[{slot.offset}] = {lower(value, self.env)}"
                continue
            for range, (piece,) in pieces(item.range, value):
                yield self._piece(target, slot.offset, item.range, range, piece)

    def _solve(self, item: LinearSolve, started: set[str]) -> Iterator[str]:
        """Yield a call of ``solve``; the entries of a family are arrays over its index."""
        env = self.env if item.range is None else self.env.inside(item.range)
        rows = ", ".join(f"[{', '.join(lower(e, env) for e in row)}]" for row in item.matrix)
        right = ", ".join(lower(e, env) for e in item.right)
        targets = [self.env.spelling[unknown] for unknown in item.unknowns]
        if item.range is not None and not self._is_whole(item):
            for unknown in item.unknowns:
                yield from self._start(unknown, started)
            targets = [f"{t}[{self._part(item.unknowns[0], item.range)}]" for t in targets]
        comma = "," if len(targets) == 1 else ""
        yield f"{', '.join(targets)}{comma} = solve([{rows}], [{right}])"

    def _is_whole(self, item: LinearSolve) -> bool:
        """Whether one call gives all elements, as arrays."""
        whole = self.env.ranges[item.unknowns[0]]
        over = item.range
        if over is None or whole is None or len(over) < max(2, len(whole)):
            return False
        return any(depends_on_index(entry, over.variable) for entry in expressions(item))

    def _part(self, name: str, range: IndexRange) -> str:
        whole = self.env.ranges[name] or range
        return f"{range.first - whole.first}:{range.last - whole.first + 1}"
