"""The tables of an analysis, in text and in HTML."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby
from math import inf, isfinite, isnan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nsode.analysis.result import Analysis
    from nsode.analysis.steps import StableStep

_SHOWN = 12  # multipliers whose W is printed
_WIDTH = 100  # characters of a line, beyond which W stands in numbers


@dataclass(frozen=True, slots=True)
class Table:
    """A title, a row of heads (empty: none), rows of cells, and remarks below."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    remarks: tuple[str, ...] = ()

    def text(self) -> Iterator[str]:
        """Yield the lines of the table, columns aligned."""
        yield self.title
        cells = [row for row in (self.head, *self.rows) if row]
        widths = [max(len(row[k]) for row in cells) for k in range(len(cells[0]))] if cells else []
        for row in cells:
            padded = (f"{c:<{w}}" if not k else f"{c:>{w}}" for k, (c, w) in _sized(row, widths))
            yield f"  {'  '.join(padded)}".rstrip()
        yield from (f"  {remark}" for remark in self.remarks)

    def html(self) -> str:
        """Return the table for a notebook."""
        head = "".join(f"<th>{escape(cell)}</th>" for cell in self.head)
        body = "".join(
            "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>"
            for row in self.rows
        )
        remarks = "".join(f"<p>{escape(remark)}</p>" for remark in self.remarks)
        title = f"<caption style='text-align:left'><b>{escape(self.title)}</b></caption>"
        return f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{remarks}"


def _sized(row: Sequence[str], widths: Sequence[int]) -> Iterable[tuple[int, tuple[str, int]]]:
    return enumerate(zip(row, widths, strict=True))


def lines(parts: Iterable[Table], name: str) -> Iterator[str]:
    """Yield the report of a model, line by line."""
    yield name
    for part in parts:
        yield ""
        yield from part.text()


def tables(found: Analysis) -> list[Table]:
    """Return the parts of the report that have something to say."""
    parts = [_mass(found), _steps(found), _contacts(found), _frictions(found), _rest(found)]
    return [part for part in parts if part.rows or part.remarks]


def number(value: float) -> str:
    """Return a number with four digits, a dash where it is not known."""
    if isnan(value):
        return "-"
    return "none" if value == inf else f"{value:.4g}"


def active_text(modes: Sequence[tuple[str, str]]) -> str:
    """Return what the elements of a set do; neighbors in a family that do the same as one."""
    parts: list[str] = []
    active = [(name, mode) for name, mode in modes if mode not in ("open", "free")]
    for (_, mode), group in groupby(active, lambda pair: (_family(pair[0]), pair[1])):
        members = [name for name, *_ in group]
        first, last = members[0], members[-1]
        through = "" if first == last else f" to {last}"
        parts.append(f"{first}{through} {mode}")
    return ", ".join(parts)


def _family(name: str) -> str:
    return name.partition("[")[0] if "[" in name else name


def _mass(found: Analysis) -> Table:
    mass = found.mass
    title = "effective inverse mass W" + (", at the start" if mass.varies else "")
    remarks = tuple(
        f"not symmetric at {a}, {b}: a force does not enter through the Jacobian of its argument"
        for a, b in mass.asymmetric()
    )
    if len(mass.names) > _SHOWN:
        return Table(f"{title}: {len(mass.names)} multipliers", (), (), remarks)
    numbers = tuple(tuple(map(number, row)) for row in mass.matrix)
    table = _square(title, mass.names, mass.formulas or numbers, remarks)
    if max(map(len, table.text())) > _WIDTH and mass.formulas is not None:
        told = "its formulas are long: `--format json` has them, as does `.mass.formulas`"
        table = _square(title, mass.names, numbers, (*remarks, told))
    return table


def _square(
    title: str, names: Sequence[str], cells: Iterable[tuple[str, ...]], remarks: tuple[str, ...]
) -> Table:
    rows = tuple((name, *row) for name, row in zip(names, cells, strict=True))
    return Table(title, ("", *names) if rows else (), rows, remarks)


def _steps(found: Analysis) -> Table:
    sets = "too many active sets to list" if found.sets is None else f"{found.sets} active sets"
    head = ("", "stable to", "frequency", "damping", "own modes")
    rows = tuple(_step(step) for step in found.steps)
    remarks = [text for step in found.steps[:1] for text in _limited_by(step)]
    if found.own_modes:
        shown = ", ".join(_mode(mode) for mode in found.own_modes[:4])
        remarks.append(f"the model's own modes: {shown}")
    if found.growing is not None:
        where = active_text(found.growing.modes)
        grows = _mode(found.growing.eigenvalue)
        remarks.append(f"{grows} grows by itself, whatever the step, in: {where}")
    if found.unknown is not None:
        return Table("stable steps", (), (), (f"not known: {found.unknown}", *remarks))
    if found.mass.varies:
        remarks.append(_elsewhere(found.along))
    where = ", at the start" if found.mass.varies and not found.along else ""
    return Table(f"stable steps{where} ({sets})", head, rows, tuple(remarks))


def _elsewhere(along: int) -> str:
    """Return where the limits hold, in a scene whose W changes."""
    if along:
        return f"the least at the start and in {along:,} states; W varies, and others may want less"
    return "W varies: a state elsewhere may want less; --along RUN.npz looks at those of a run"


def _step(step: StableStep) -> tuple[str, ...]:
    proven = "" if step.proven else " (found)"
    own = "-" if step.own is None else "no margin" if step.own == 0 else _seconds(step.own)
    return (
        step.method,
        f"{_seconds(step.step)}{proven}",
        f"{number(step.frequency)} rad/s",
        number(step.damping),
        own,
    )


def _seconds(value: float) -> str:
    return number(value) if value == inf else f"{number(value)} s"


def _limited_by(step: StableStep) -> Iterator[str]:
    held = active_text(step.modes) or "free flight"
    yield f"{step.method} is limited by {_mode(step.eigenvalue)} in: {held}"
    if step.found > step.step * (1 + 1e-9):
        yield f"the step is a proven bound; the least limit found is {number(step.found)} s"
    if step.change:
        powers = ", ".join(f"{name}^{power:g}" for name, power in step.change[:3])
        yield f"the limit follows {powers}"


def _mode(value: complex) -> str:
    if value.imag == 0:
        return f"{number(value.real)}/s"
    sign = f"{number(value.real)} " if value.real else ""
    return f"({sign}+- {number(abs(value.imag))}i)/s"


def _contacts(found: Analysis) -> Table:
    head = ("", "mass", "frequency", "restitution", "at", "measured", "deepest", "at rest")
    rows = tuple(
        (
            c.name,
            number(c.effective_mass),
            f"{number(c.frequency)} rad/s",
            number(c.mapped_restitution),
            f"{number(c.impact_speed)} m/s" if isfinite(c.impact_speed) else "-",
            number(c.restitution),
            number(c.penetration),
            number(c.static_penetration),
        )
        for c in found.contacts
    )
    shown, remarks = _shortened(rows)
    coarse = tuple(d.message for d in found.diagnostics if d.code == "NS409")
    return Table("contacts, each on its own", head, shown, (*remarks, *coarse))


def _frictions(found: Analysis) -> Table:
    head = ("", "mass", "frequency", "damping", "limit", "presliding")
    rows = tuple(
        (
            f.name,
            number(f.effective_mass),
            f"{number(f.frequency)} rad/s",
            number(f.damping),
            number(f.limit),
            number(f.presliding),
        )
        for f in found.frictions
    )
    return Table("friction in stick, under the load at the start", head, *_shortened(rows))


def _shortened(
    rows: tuple[tuple[str, ...], ...],
) -> tuple[tuple[tuple[str, ...], ...], tuple[str, ...]]:
    """Return the first rows, and a remark that tells how many follow."""
    if len(rows) <= _SHOWN:
        return rows, ()
    return rows[:_SHOWN], (f"and {len(rows) - _SHOWN} more, in the JSON",)


def _rest(found: Analysis) -> Table:
    remarks = []
    if found.unknown is None or not found.passive:
        remarks.append("no element creates energy" if found.passive else "energy may be created")
    if found.unread:
        remarks.append("no force and no output depends on " + ", ".join(found.unread))
    remarks += [f"{a} and {b} act at one and the same place" for a, b in found.coinciding]
    if found.idle:
        remarks.append("never act: " + ", ".join(found.idle))
    return Table("energy and size", (), (), tuple(remarks))
