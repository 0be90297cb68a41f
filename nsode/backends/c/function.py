"""The body of one generated function, from the work it has to do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import starmap

from nsode.backends.c import jacobian, solve
from nsode.backends.c.expressions import condition, lower
from nsode.backends.c.plan import Group, Plan, Require, Scatter, Store, Work, plan
from nsode.backends.c.program import Program, Text, Vector
from nsode.expr import Expr, Index, IndexRange, Name, Sum, walk
from nsode.ode import Binding, LinearSolve

_LOOP_VARIABLES = "ijk"
_WIDEST = 100


def body(program: Program, works: Iterable[Work]) -> list[str]:
    """Return the lines of a function that does some work, indented once.

    The function has ``t``, ``x``, ``u`` and ``p``; values over ranges are in pieces.
    """
    writer = Writer(program, plan(works, program.readings))
    for group in writer.plan.groups:
        writer.group(group)
    return [*writer.preamble(), *writer.lines]


@dataclass(slots=True)
class Writer:
    """Lines under way; the scope in which expressions are lowered."""

    program: Program
    plan: Plan
    lines: list[str] = field(default_factory=list)
    indices: dict[str, str | int] = field(default_factory=dict)
    depth: int = 1
    loops: int = 0
    count: int = 0

    @property
    def single(self) -> bool:
        """Whether real is float."""
        return self.program.single

    def preamble(self) -> list[str]:
        """Return what stands at the top: values read, then arrays of the function."""
        names = self.program.locals
        arrays = [f"    real {names[b]}[{len(over)}];" for b, over in self.plan.stored.items()]
        return [*starmap(self._load, self._loaded()), *arrays]

    def _loaded(self) -> Iterator[tuple[Vector, str]]:
        """Yield what the function reads of x, u and p."""
        for vector in self.program.loaded:
            for name in vector.slots:
                if name in self.plan.read:
                    yield vector, name

    def _load(self, vector: Vector, name: str) -> str:
        place, local = self.program.enumerator(vector, name), self.program.locals[name]
        if vector.slots[name].range is None:
            return f"    const real {local} = {vector.letter}[{place}];"
        return f"    const real *const {local} = {vector.letter} + {place};"

    def line(self, text: str) -> None:
        """Add a line at the indentation at hand."""
        self.lines += wrapped("    " * self.depth + text)

    def group(self, group: Group) -> None:
        """Write the work of a group, in its loop if it has one."""
        match group.range:
            case None:
                for work in group.works:
                    self._work(work)
            case IndexRange(_, first, last) if first == last:
                with self._block(group):
                    self._works(group.works, first)
            case over:
                with self.loop(over) as variable:
                    self._works(group.works, variable)

    def _works(self, works: Iterable[Work], at: str | int) -> None:
        for work in works:
            with self.inside(work.range, at):
                self._work(work)

    @contextmanager
    def inside(self, over: IndexRange | None, at: str | int) -> Iterator[None]:
        """Give the index of a range its text."""
        outer = dict(self.indices)
        if over is not None:
            self.indices[over.variable] = at
        yield
        self.indices = outer

    @contextmanager
    def _block(self, group: Group) -> Iterator[None]:
        """Open a block around locals of a single element, which may come again."""
        if not any(map(self._has_locals, group.works)):
            yield
            return
        self.line("{")
        self.depth += 1
        yield
        self.depth -= 1
        self.line("}")

    def _has_locals(self, work: Work) -> bool:
        match work:
            case Binding(name=name):
                return name not in self.plan.stored
            case LinearSolve():
                return True
            case _:
                return False

    @contextmanager
    def loop(self, over: IndexRange) -> Iterator[str]:
        """Open a loop over a range; gives the name of its variable."""
        variable = (
            _LOOP_VARIABLES[self.loops] if self.loops < len(_LOOP_VARIABLES) else f"i{self.loops}"
        )
        self.line(
            f"for (int {variable} = {over.first}; {variable} <= {over.last}; ++{variable}) {{"
        )
        self.depth += 1
        self.loops += 1
        yield variable
        self.loops -= 1
        self.depth -= 1
        self.line("}")

    def _work(self, work: Work) -> None:
        match work:
            case Binding(name=name, value=value, range=over):
                self.define(name, over, self._text(value))
            case LinearSolve():
                solve.write(work, self)
            case Store(array, place, value, over, first):
                text = self._text(value)
                where = place if over is None else self._added(place, Index(over.variable), first)
                self.line(f"{array}[{where}] = {text};")
            case Require(test, status, _):
                text = condition(test, self)
                self.line(f"if (!{text}) {{")
                self.line(f"    return {status};")
                self.line("}")
            case Scatter():
                jacobian.write(work, self)

    def _text(self, value: Expr) -> str:
        """Return the C of a value; what is the same in every function is lowered once."""
        known = self.program.texts.get(id(value))
        if known is not None:
            return known.text
        text = lower(value, self)
        if _is_scalar(value):
            self.program.texts[id(value)] = Text(value, text)
        return text

    def define(self, name: str, over: IndexRange | None, text: str) -> None:
        """Write the value of a binding where readers look for it."""
        local = self.program.locals[name]
        if over is not None and name in self.plan.stored:
            place = self._place(Index(over.variable), self.plan.stored[name])
            self.line(f"{local}[{place}] = {text};")
        else:
            self.line(f"const real {local} = {text};")

    def fresh(self, stem: str) -> str:
        """Return a name for a local of our own."""
        self.count += 1
        return f"{stem}{self.count}"

    # the scope of expressions

    def use(self, function: str) -> None:
        """Note that a helper or a function of ``math.h`` is called."""
        self.program.used.add(function)

    def index(self, index: Index) -> str:
        """Return an index as an integer expression of C."""
        return _offset(self._at(index), index.offset)

    def name(self, name: Name) -> str:
        """Return the C text of a named value."""
        local = self.program.locals[name.id]
        if name.at is None:
            return local
        over = self._kept(name.id)
        return local if over is None else f"{local}[{self._place(name.at, over)}]"

    def sum(self, expr: Sum) -> str:
        """Write the loop of a sum before the statement at hand; return its variable."""
        total = self.fresh("sum")
        self.line(f"real {total} = 0;")
        with self.loop(expr.range) as variable, self.inside(expr.range, variable):
            self.line(f"{total} += {lower(expr.body, self)};")
        return total

    def _kept(self, name: str) -> IndexRange | None:
        """Return the range of a family that stands in an array."""
        for vector in self.program.loaded:
            if name in vector.slots:
                return vector.slots[name].range
        return self.plan.stored.get(name)

    def _at(self, index: Index) -> str | int:
        return 0 if index.variable is None else self.indices[index.variable]

    def _place(self, at: Index, over: IndexRange) -> str:
        return _offset(self._at(at), at.offset - over.first)

    def _added(self, place: str, at: Index, first: int) -> str:
        where = _offset(self._at(at), at.offset - first)
        return place if where == "0" else f"{place} + {where}"


def _is_scalar(value: Expr) -> bool:
    """Whether no loop and no array comes into the C of a value."""
    return not any(
        isinstance(node, Sum | Index) or (isinstance(node, Name) and node.at is not None)
        for node in walk(value)
    )


def wrapped(line: str) -> list[str]:
    """Break a long line of C at its spaces, but not behind ``const``."""
    if len(line) <= _WIDEST:
        return [line]
    indent = " " * (len(line) - len(line.lstrip()))
    lines = []
    first, *words = line.replace("const ", "const\0").split()
    filled = indent + first
    for word in words:
        if len(filled) + 1 + len(word) > _WIDEST:
            lines.append(filled)
            filled = f"{indent}    {word}"
        else:
            filled = f"{filled} {word}"
    return [line.replace("\0", " ") for line in (*lines, filled)]


def _offset(at: str | int, offset: int) -> str:
    if isinstance(at, int):
        return str(at + offset)
    if offset == 0:
        return at
    return f"{at} + {offset}" if offset > 0 else f"{at} - {-offset}"
