"""The names, sizes and default values at the head of a generated module."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from itertools import groupby
from math import isfinite, isnan

from nsode.ode import AugmentedODE, Input, Parameter, Placed, element, size

#: Columns of a generated module.
WIDTH = 88

#: Magnitudes that a step sets to zero, as in the C.
_TINY = {"float64": "1e-290", "float32": "1e-37"}


def tables(ode: AugmentedODE, real: str) -> list[str]:
    """Return the lines that define sizes, names and defaults."""
    vectors: dict[str, Sequence[Placed]] = {
        "x": ode.states,
        "u": ode.inputs,
        "p": ode.parameters,
        "y": ode.outputs,
    }
    return [
        f"real = np.{real}",
        f"tiny = {_TINY[real]}",
        "",
        *(f"N{v.upper()} = {sum(map(size, items))}" for v, items in vectors.items()),
        *(_table(f"{v}_names", map(_names, items)) for v, items in vectors.items()),
        _array("u0", map(_default, ode.inputs)),
        _array("p0", map(_values, ode.parameters)),
    ]


def _names(item: Placed) -> str:
    """Return an entry of a tuple: the name, or for a family the names of its elements."""
    if item.range is None:
        return json.dumps(item.name)
    before, after = (_inner(part) for part in element(item.name, 0).split("[0]", 1))
    spread = f"range({item.range.first}, {item.range.last + 1})"
    return f'*(f"{before}[{{k}}]{after}" for k in {spread})'


def _inner(text: str) -> str:
    """Return text as it stands inside the quotes of an f-string."""
    return json.dumps(text)[1:-1].replace("{", "{{").replace("}", "}}")


def _default(item: Input) -> str:
    value = float("nan") if item.default is None else item.default
    return _repeated(value, 1 if item.range is None else len(item.range), item.range is not None)


def _values(item: Parameter) -> str:
    runs = [(value, len(list(run))) for value, run in groupby(item.values, key=repr)]
    return ", ".join(_repeated(float(value), n, n > 1) for value, n in runs)


def _repeated(value: float, n: int, many: bool) -> str:
    return f"*[{number(value)}] * {n}" if many else number(value)


def number(value: float) -> str:
    """Return a number as Python reads it back."""
    if isnan(value):
        return "np.nan"
    return repr(float(value)) if isfinite(value) else "np.inf" if value > 0 else "-np.inf"


def _array(name: str, entries: Iterable[str]) -> str:
    return _table(name, entries, "np.array([", "], dtype=real)")


def _table(name: str, entries: Iterable[str], start: str = "(", end: str = ")") -> str:
    """Return an assignment, broken between entries where it would grow too wide."""
    found = list(entries)
    comma = "," if len(found) == 1 and start == "(" else ""
    line = f"{name} = {start}{', '.join(found)}{comma}{end}"
    if len(line) <= WIDTH:
        return line
    rows = [""]
    for entry in found:
        if rows[-1] and len(rows[-1]) + len(entry) > WIDTH - 6:
            rows.append("")
        rows[-1] += f" {entry}," if rows[-1] else f"    {entry},"
    return "\n".join([f"{name} = {start}", *rows, end])
