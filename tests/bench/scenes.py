"""From text to C: the shipped models, and scenes of many contacts written out one by one."""

from __future__ import annotations

from functools import partial

import nsode
from measure import exponent, in_turns, table
from support import MODELS

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
    return head + body + TAIL


def to_c(text: str) -> dict[str, str]:
    """Compile a text to C in memory."""
    return nsode.loads(text).emit("c")


def main() -> None:
    """Measure and print."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in MODELS}
    rows = _rows(texts, _measured(texts, 5))
    table("From text to C, shipped models", ("model", "lines", "ms"), rows)
    sizes = [250, 500, 1000, 2000]
    texts = {f"{contacts} contacts": written_out(contacts) for contacts in sizes}
    times = _measured(texts, 5)
    table("From text to C, contacts written out", ("scene", "lines", "ms"), _rows(texts, times))
    print(f"  growth exponent {exponent(sizes, list(times.values())):.2f}")


def _measured(texts: dict[str, str], rounds: int) -> dict[str, float]:
    to_c(next(iter(texts.values())))  # what is made or imported once does not count
    return in_turns({name: partial(to_c, text) for name, text in texts.items()}, rounds)


def _rows(texts: dict[str, str], times: dict[str, float]) -> list[tuple[str, str, str]]:
    return [
        (name, str(len(text.splitlines())), f"{1e3 * times[name]:.1f}")
        for name, text in texts.items()
    ]
