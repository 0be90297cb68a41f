"""Families: only the tables grow with the number of contacts."""

from __future__ import annotations

import subprocess
import tempfile
import time
from pathlib import Path

import nsode
from measure import table

ROW = """\
model row
constant n = {n}
parameter M = 1 {{kg}}
parameter d = 0.01 {{m}}
state x[i in 1..n] = 0.02*i  {{m}}
state v[i in 1..n] = 1       {{m/s}}
force N[i in 0..n] = dio((if i < n then x[i+1] else 0.02*n + d) - (if i > 0 then x[i] else 0) - d)
for i in 1..n: der(x[i]) = v[i]
for i in 1..n: M*der(v[i]) = N[i-1] - N[i]
approximate N: K = 1e5 {{N/m}}, beta = 4e-3 {{s}}, alpha = 2e-3 {{s}}
"""


def main() -> None:
    """Measure and print."""
    rows = [_row(n) for n in (10, 100, 1000, 10_000)]
    head = ("contacts", "to C ms", "gcc -O2 ms", "C bytes")
    table("A family of contacts, from text to a shared library", head, rows)


def _row(n: int) -> tuple[str, ...]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        begin = time.perf_counter()
        nsode.loads(ROW.format(n=n)).compile("c", folder)
        middle = time.perf_counter()
        source = folder / "row.c"
        command = ["gcc", "-O2", "-shared", "-fPIC", "-o", folder / "row.so", source, "-lm"]
        subprocess.run(list(map(str, command)), check=True)
        end = time.perf_counter()
        size = source.stat().st_size
    return str(n), f"{1e3 * (middle - begin):.0f}", f"{1e3 * (end - middle):.0f}", str(size)
