"""Integrators in C: one fused step per method, around the inlined right-hand side."""

from __future__ import annotations

from fractions import Fraction
from functools import singledispatch
from math import lcm

from nsode.backends.c.program import Program
from nsode.integrators import Scheme
from nsode.integrators.scheme import RungeKutta
from nsode.integrators.splittings import Verlet
from nsode.ode import expressions, size
from nsode.passes.prune import reads

#: Below this a value is zero: e and a decay into subnormals, which are slow.
_FLUSH = {False: "(real)1e-290", True: "(real)1e-37"}


@singledispatch
def step(scheme: Scheme | Verlet, program: Program) -> list[str]:
    """Return the body of the function that advances ``x`` by one step, indented once."""
    raise NotImplementedError(f"no C for {type(scheme).__name__}")


def finish(program: Program) -> str:
    """Return the function that ends every step: a sound ``next`` becomes the state."""
    places = f"{program.prefix}_NX"
    absolute = "fabsf" if program.single else "fabs"
    program.used.add("fabs")
    return f"""\
/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{{
    int finite = 1;
    for (int i = 0; i < {places}; ++i) {{
        finite &= next[i] - next[i] == 0;
    }}
    if (!finite) {{
        return {program.prefix}_NOT_FINITE;
    }}
    for (int i = 0; i < {places}; ++i) {{
        x[i] = {absolute}(next[i]) < {_FLUSH[program.single]} ? 0 : next[i];
    }}
    return {program.prefix}_OK;
}}
"""


@step.register
def _(scheme: RungeKutta, program: Program) -> list[str]:
    stages = range(scheme.stages)
    places = max(1, program.x.size)
    slopes = ", ".join(f"k{i + 1}[{places}]" for i in stages)
    lines = [f"real {slopes}, next[{places}];", "int status;"]
    whole, read = f"{program.prefix}_NX", _as_far_as_read(program)
    for i in stages:
        if i:
            lines += _advance(read or whole, scheme.a[i])
        state = "next" if i else "x"
        lines += [
            f"status = rates({_instant(scheme.c[i])}, {state}, u, p, k{i + 1});",
            "if (status) {",
            "    return status;",
            "}",
        ]
    lines += [*_advance(whole, scheme.b), "return finish(x, next);"]
    return [f"    {line}" for line in lines]


def _instant(node: Fraction) -> str:
    return f"t + {_share(node)}" if node else "t"


def _share(part: Fraction) -> str:
    """Return a part of the step size."""
    top = "h" if part.numerator == 1 else f"{part.numerator}*h"
    return top if part.denominator == 1 else f"{top}/{part.denominator}"


def _as_far_as_read(program: Program) -> str:
    """Return the number of states without the last ones, which no rate reads; empty if all.

    Integrals, such as the books of a run, need no values between the ends of a step.
    """
    ode = program.whole
    exprs = [rate.value for rate in ode.rates]
    exprs += [expr for item in ode.bindings for expr in expressions(item)]
    read = reads(*exprs)
    last = max((k for k, item in enumerate(program.x.items) if item.name in read), default=-1)
    count = sum(map(size, program.x.items[: last + 1]))
    return "" if count in (0, program.x.size) else str(count)


def _advance(count: str, weights: tuple[Fraction, ...]) -> list[str]:
    """Return the loop for ``x + h*sum(w*k)``, with the weights over one denominator."""
    used = {f"k{i + 1}[i]": w for i, w in enumerate(weights) if w}
    if len(used) == 1:
        [(slope, weight)] = used.items()
        increment = f"{_share(weight)}*{slope}"
    else:
        whole = lcm(*(w.denominator for w in used.values()))
        terms = " + ".join(_times(w * whole, k) for k, w in used.items())
        increment = f"{_share(Fraction(1, whole))}*({terms})"
    return [
        f"for (int i = 0; i < {count}; ++i) {{",
        f"    next[i] = x[i] + {increment};",
        "}",
    ]


def _times(weight: Fraction, slope: str) -> str:
    return slope if weight == 1 else f"{weight}*{slope}"
