"""Errors, warnings and notes: what is wrong, where, why, and the way out."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Literal, NamedTuple

from nsode.source import Source, Span

#: Every code with its title. A code never changes its meaning.
CODES: dict[str, str] = {
    # the text
    "NS001": "syntax error",
    "NS002": "character outside the language",
    "NS003": "malformed number",
    "NS004": "unbalanced bracket",
    "NS005": "no model",
    "NS006": "malformed name",
    "NS007": "no files from inside a model",
    "NS008": "malformed unit",
    # limits
    "NS010": "name too long",
    "NS011": "nested too deep",
    "NS012": "source too large",
    "NS013": "exponent too large",
    "NS014": "too many elements",
    # names, shapes, units
    "NS101": "unknown name",
    "NS102": "defined twice",
    "NS103": "reserved name",
    "NS104": "unknown function",
    "NS105": "shapes do not fit",
    "NS106": "algebraic loop",
    "NS107": "state without an equation",
    "NS108": "two equations for one state",
    "NS109": "index out of range",
    "NS110": "wrong number of arguments",
    "NS111": "not a constant",
    "NS112": "not linear in der()",
    "NS113": "singular mass matrix",
    "NS114": "unknown unit",
    "NS115": "units do not fit",
    "NS116": "undefined value",
    "NS117": "a condition where a number is wanted, or a number where a condition is wanted",
    # set-valued terms
    "NS201": "multiplicative factor not provably nonnegative",
    "NS202": "discontinuity in a multiplicative factor",
    "NS203": "nonlinear in a set-valued term",
    "NS204": "set-valued term inside the argument of another",
    "NS205": "a force without one set-valued term",
    "NS206": "multiplicative factor that is no scalar",
    "NS207": "discontinuity in the argument of a set-valued term",
    # constants of the approximation
    "NS301": "constant not positive",
    "NS302": "alpha greater than beta",
    "NS303": "unknown setting",
    "NS304": "nothing to approximate",
    "NS305": "approximated twice",
    "NS306": "law that cannot represent the term",
    "NS307": "value that breaks a proof",
    "NS308": "target without tuning",
    # warnings and notes
    "NS401": "unused name",
    "NS402": "a term that may feed energy",
    "NS403": "one argument with two factors",
    "NS404": "duration that is no multiple of the step",
    "NS405": "factor that holds a division",
    "NS406": "undefined value at the start",
    "NS407": "unstable step",
    "NS408": "lightly damped friction",
    "NS409": "impacts not resolved",
    "NS410": "step not checked",
    "NS411": "start inside a contact",
    "NS412": "friction that acts too late",
    # runs
    "NS501": "setting of a run out of range",
    "NS502": "run too large",
    "NS503": "value missing",
    "NS504": "state no longer finite",
    "NS505": "condition broken during a run",
    "NS506": "energy from nothing",
    "NS507": "interrupted",
    "NS508": "unusable input data",
    "NS509": "no working compiler",
    "NS510": "unsafe build cache",
    "NS511": "too large for the stack",
    # files and the machine
    "NS601": "cannot read",
    "NS602": "cannot write",
    "NS603": "usage",
}

Severity = Literal["error", "warning", "note"]


class Label(NamedTuple):
    """A place and the few words that stand under it."""

    span: Span
    text: str = ""


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One message. The first label is the place; further ones are places that matter too.

    ``notes`` give the cause, ``help`` the way out.
    """

    code: str
    message: str
    labels: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str | None = None
    severity: Severity = "error"

    def __post_init__(self) -> None:
        if self.code not in CODES:
            raise KeyError(f"{self.code} is not in the table of codes")


class ModelError(Exception):
    """A model is refused; ``diagnostics`` say why, errors and warnings in order of place."""

    def __init__(self, diagnostics: Iterable[Diagnostic], source: Source | None = None) -> None:
        self.diagnostics = tuple(diagnostics)
        self.source = source
        super().__init__("\n".join(f"{d.code}: {d.message}" for d in self.diagnostics))

    def __reduce__(self) -> tuple[object, ...]:
        # Errors come back from the processes of a sweep; `args` alone would not rebuild them.
        return type(self), (self.diagnostics, self.source)

    def __str__(self) -> str:
        return render(self.diagnostics, self.source)


def refuse(
    code: str, message: str, span: Span, label: str = "", *, help: str | None = None
) -> ModelError:
    """Return the error for the most common case: one message at one place."""
    return ModelError([Diagnostic(code, message, (Label(span, label),), help=help)])


def quoted(names: Iterable[str]) -> str:
    """Return names as a message lists them."""
    return ", ".join(f"`{name}`" for name in names)


def suggest(name: str, known: Iterable[str]) -> str | None:
    """Return ``did you mean ...`` for a misspelt name, None where nothing is near."""
    names = list(known)
    same = [other for other in names if other.casefold() == name.casefold()]
    swapped = [other for other in names if sorted(other) == sorted(name)]
    near = same or swapped or get_close_matches(name, names, n=1, cutoff=0.6)
    return f"did you mean `{near[0]}`?" if near else None


def visible(text: str) -> str:
    """Return text that a terminal shows and does not obey, on one line."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)


def render(diagnostics: Sequence[Diagnostic], source: Source | None, *, color: bool = False) -> str:
    """Return diagnostics as text for a person, one after the other."""
    return "\n\n".join(_render_one(d, source, color) for d in diagnostics)


_COLORS = {"error": "31;1", "warning": "33;1", "note": "36;1"}


def _paint(text: str, style: str, color: bool) -> str:
    return f"\033[{style}m{text}\033[0m" if color else text


def _render_one(diagnostic: Diagnostic, source: Source | None, color: bool) -> str:
    head = _paint(f"{diagnostic.severity}[{diagnostic.code}]", _COLORS[diagnostic.severity], color)
    lines = [f"{head}: {visible(diagnostic.message)}"]
    width = 3
    if source is not None and diagnostic.labels:
        positions = [source.position(label.span.start) for label in diagnostic.labels]
        width = max(3, *(len(str(p.line)) + 2 for p in positions))
        first = positions[0]
        lines.append(f"{'-->':>{width + 2}} {visible(source.name)}:{first.line}:{first.column}")
        for label, position in zip(diagnostic.labels, positions, strict=True):
            primary = label is diagnostic.labels[0]
            style = _COLORS[diagnostic.severity] if primary else "36"
            lines.extend(
                _excerpt(label, source, position.line, position.column, width, style, color)
            )
    lines.extend(f"{' ' * width} = note: {visible(note)}" for note in diagnostic.notes)
    if diagnostic.help is not None:
        lines.append(f"{' ' * width} = help: {visible(diagnostic.help)}")
    return "\n".join(lines)


_WIDEST = 100  # characters of a source line that a message shows


def _excerpt(
    label: Label, source: Source, line: int, column: int, width: int, style: str, color: bool
) -> list[str]:
    text = source.line(line).replace("\t", " ")
    shown = visible(text)
    start = column - 1
    length = max(1, min(label.span.end - label.span.start, len(shown) - start))
    skip = 0
    if len(shown) > _WIDEST:
        skip = max(0, start - _WIDEST // 3)
        length = min(length, _WIDEST - (start - skip))
        shown = ("…" if skip else "") + shown[skip : skip + _WIDEST] + "…"
    mark = " " * (start - skip + (1 if skip else 0)) + "^" * length
    under = f"{mark} {label.text}".rstrip()
    return [f"{line:>{width}} | {shown}", f"{'':>{width}} | {_paint(under, style, color)}"]


def as_json(diagnostics: Sequence[Diagnostic], source: Source) -> dict[str, object]:
    """Return diagnostics as plain data, for editors and scripts."""

    def place(label: Label) -> dict[str, object]:
        start, end = source.position(label.span.start), source.position(label.span.end)
        return {
            "start": {"line": start.line, "column": start.column, "offset": label.span.start},
            "end": {"line": end.line, "column": end.column, "offset": label.span.end},
            "text": label.text,
        }

    return {
        "file": source.name,
        "diagnostics": [
            {
                "code": d.code,
                "title": CODES[d.code],
                "severity": d.severity,
                "message": d.message,
                "labels": [place(label) for label in d.labels],
                "notes": list(d.notes),
                "help": d.help,
            }
            for d in diagnostics
        ],
    }
