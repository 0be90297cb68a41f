"""From text to C: the shipped models, and scenes of many contacts written out one by one."""

from __future__ import annotations

from functools import partial

import nsode
from measure import exponent, seconds, table
from support import MODELS

LINES_PER_CONTACT = 5
CONTACT = """\
state p{i} = {height}  {{m}}
state v{i} = 0  {{m/s}}
force N{i} = dio(p{i})
der(p{i}) = v{i}
M*der(v{i}) = N{i} - M*g
"""
TAIL = "approximate default dio: K = 1e5 {N/m}, beta = 4e-3 {s}, alpha = 2e-3 {s}\n"


def written_out(contacts: int) -> str:
    """Return a model of so many bouncing balls, each with five lines of its own."""
    head = "model balls\nparameter M = 1 {kg}\nparameter g = 9.8 {m/s^2}\n"
    body = "".join(CONTACT.format(i=i, height=1 + i / 1000) for i in range(contacts))
    return (
        head + body + "approximate default dio: K = 1e5 {N/m}, beta = 4e-3 {s}, alpha = 2e-3 {s}\n"
    )


def to_c(text: str) -> dict[str, str]:
    """Compile a text to C in memory."""
    return nsode.loads(text).emit("c")


def main() -> None:
    """Measure and print."""
    nsode.loads(MODELS[0].read_text(encoding="utf-8"))  # the parser is made once
    rows = [
        (path.stem, str(len(text.splitlines())), f"{1e3 * seconds(partial(to_c, text), 5):.1f}")
        for path in MODELS
        for text in [path.read_text(encoding="utf-8")]
    ]
    table("From text to C, shipped models", ("model", "lines", "ms"), rows)
    sizes = [1250, 2500, 5000, 10_000]
    texts = [written_out(lines // LINES_PER_CONTACT) for lines in sizes]
    times = [seconds(partial(to_c, text), 3) for text in texts]
    rows = [
        (f"{lines // LINES_PER_CONTACT} contacts", str(lines), f"{1e3 * taken:.0f}")
        for lines, taken in zip(sizes, times, strict=True)
    ]
    table("From text to C, contacts written out", ("scene", "lines", "ms"), rows)
    print(f"  growth exponent {exponent(sizes, times):.2f}")
