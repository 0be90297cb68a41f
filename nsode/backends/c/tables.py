"""The constant tables of a model in C: parameter defaults and the names of all places."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain

from nsode.backends.c.expressions import number
from nsode.backends.c.names import plain
from nsode.backends.c.program import Program
from nsode.ode import Parameter, element_names

_WIDTH = 90
_LONGEST_PORTABLE = 4095  # characters that C99 promises for one string


def parameters(program: Program) -> str:
    """Return the table of the parameters' defaults."""
    items = [item for item in program.ode.parameters if isinstance(item, Parameter)]
    values = [number(value).text for value in chain.from_iterable(p.values for p in items)]
    if any("NAN" in value or "INFINITY" in value for value in values):
        program.used.add("NAN")
    lines = ",\n".join(_filled(values or ["0"], ", "))
    return f"const {program.prefix}_real {program.prefix}_p0[] = {{\n{lines}\n}};\n"


def names(program: Program) -> list[str]:
    """Return the strings that hold the names of x, u, p and y, each ended by NUL."""
    return [
        _string(f"{program.prefix}_{vector.letter}_names", element_names(vector.items))
        for vector in program.vectors
    ]


def _string(name: str, texts: Sequence[str]) -> str:
    # No name begins with a digit, so none can run into the octal escape before it.
    lines = _filled([plain(text) + "\\0" for text in texts], "")
    literal = "\n".join(f'    "{line.strip()}"' for line in lines) or '    ""'
    table = f"const char {name}[] =\n{literal};\n"
    return _long(table) if sum(len(text) + 1 for text in texts) >= _LONGEST_PORTABLE else table


def _long(table: str) -> str:
    return f"""\
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Woverlength-strings"
#endif
{table}#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
"""


def _filled(texts: Iterable[str], separator: str) -> list[str]:
    """Return texts in lines of bounded width, indented once."""
    lines: list[str] = []
    line = ""
    for text in texts:
        if line and len(line) + len(separator) + len(text) > _WIDTH:
            lines.append(f"    {line}")
            line = text
        else:
            line = f"{line}{separator}{text}" if line else text
    return [*lines, f"    {line}"] if line else lines
