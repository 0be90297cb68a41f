"""Verlet's step in C: kick, drift, kick, with e and a relaxed in the middle."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import replace
from itertools import groupby

from nsode.backends.c import work
from nsode.backends.c.function import body
from nsode.backends.c.program import Program, definitions
from nsode.backends.c.step import step
from nsode.integrators.verlet import STEP, Parts, Verlet, split
from nsode.ode import AugmentedODE, size
from nsode.passes.reciprocal import multiply_by_reciprocals
from nsode.passes.split import split as in_pieces

_ONWARD = "static inline int onward(real t, real h, real *x, const real *u, const real *p, real *k)"
_AT = "real t, real {h}, const real *x, const real *u, const real *p, real *dx"


def stages(program: Program) -> dict[str, list[str]]:
    """Return the bodies of the functions that a step calls besides the rates, by their heads."""
    parts = split(program.whole)
    head = _AT.format(h=program.locals[STEP.id])
    bodies = {
        f"static inline int {name}({head})": _filled(program, ode)
        for name, ode in (("drift", parts.drift), ("press", parts.press), ("slide", parts.slide))
    }
    return {**bodies, _ONWARD: _onward(program, parts)}


def _filled(program: Program, ode: AugmentedODE) -> list[str]:
    pieces = in_pieces(multiply_by_reciprocals(ode))
    staged = replace(program, ode=pieces, bindings=definitions(pieces))
    return [*body(program, work.rates(staged)), f"    return {program.prefix}_OK;"]


@step.register
def _(scheme: Verlet, program: Program) -> list[str]:
    lines = [
        f"real k[{max(1, program.x.size)}];",
        "const int status = rates(t, x, u, p, k);",
        "return status ? status : onward(t, h, x, u, p, k);",
    ]
    return [f"    {line}" for line in lines]


def _onward(program: Program, parts: Parts) -> list[str]:
    """Return the step from the rates at its start on, which leaves those at its end behind."""
    nx = f"{program.prefix}_NX"
    kicked = list(_stretches(program, parts.kicked))
    moved, pressed, slid = (
        list(_stretches(program, {rate.state for rate in ode.rates}))
        for ode in (parts.drift, parts.press, parts.slide)
    )
    lines = [
        f"real next[{max(1, program.x.size)}];",
        "int status;",
        *_loop([("0", nx)], "next[i] = x[i];"),
        *_loop(kicked, "next[i] += h/2*k[i];"),
    ]
    if moved:
        lines += _call("drift", "t, h", "next")
        lines += _loop(moved, "next[i] += h/2*k[i];")
        lines += _call("drift", "t + h/2, h", "next")
    if pressed:
        lines += _call("press", "t + h/2, h", "next")
        lines += _loop(pressed, "next[i] = (next[i] + k[i])/2;")
    if slid:
        lines += _call("slide", "t + h/2, h", "next")
    lines += _loop(moved, "next[i] = x[i] + h*k[i];")
    lines += _loop([*pressed, *slid], "next[i] = k[i];")
    lines += _call("rates", "t + h", "next")
    lines += _loop(kicked, "next[i] += h/2*k[i];")
    return [f"    {line}" for line in [*lines, "return finish(x, next);"]]


def _call(function: str, at: str, state: str) -> list[str]:
    return [
        f"status = {function}({at}, {state}, u, p, k);",
        "if (status) {",
        "    return status;",
        "}",
    ]


def _loop(stretches: Sequence[tuple[object, object]], statement: str) -> list[str]:
    return [
        line
        for first, end in stretches
        for line in (f"for (int i = {first}; i < {end}; ++i) {{", f"    {statement}", "}")
    ]


def _stretches(program: Program, names: Container[str]) -> Iterator[tuple[int, int]]:
    """Yield where some states stand in x: first places, and those after the last."""
    offset = 0
    for wanted, items in groupby(program.x.items, lambda item: item.name in names):
        end = offset + sum(map(size, items))
        if wanted:
            yield offset, end
        offset = end
