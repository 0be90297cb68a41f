"""PREFIX.c: the functions and tables of a model."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import chain

from nsode.backends.c import jacobian, tables, verlet, work
from nsode.backends.c.function import body, wrapped
from nsode.backends.c.header import prototypes
from nsode.backends.c.helpers import need_math, with_helpers
from nsode.backends.c.program import Program
from nsode.backends.c.step import finish, step
from nsode.integrators.splittings import Verlet

_STATE = "real t, const real *x, const real *u, const real *p"


def source(program: Program) -> str:
    """Return the text of the source file."""
    patterns = jacobian.tables(program)
    sections = [*_cores(program), *patterns, *_interface(program), *_steps(program)]
    constants = [tables.parameters(program), *tables.names(program)]
    head = [_includes(program), *with_helpers(program.used, program.single)]
    return "\n".join([*head, *sections, *constants])


def _includes(program: Program) -> str:
    math = "#include <math.h>\n\n" if need_math(program.used) else ""
    return f"""\
/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "{program.prefix}.h"

{math}typedef {program.prefix}_real real;
"""


def _cores(program: Program) -> list[str]:
    """Return what the functions of the interface share."""
    ok = f"    return {program.prefix}_OK;"
    rates = [*body(program, work.rates(program)), ok]
    cores = [_function(f"static inline int rates({_STATE}, real *dx)", rates)]
    if program.checks:
        checks = [*body(program, work.checks(program)), ok]
        check = _function(f"static int check({_STATE})", checks)
        cores.append(f"#ifdef {program.prefix}_CHECKS\n{check}#endif\n")
    return cores


def _heads(program: Program) -> dict[str, str]:
    """Return the heads of the interface with the short name for a number."""
    long = f"{program.prefix}_real "
    return {name: head.replace(long, "real ") for name, head in prototypes(program).items()}


def _interface(program: Program) -> list[str]:
    ok = f"    return {program.prefix}_OK;"
    heads = _heads(program)
    return [
        _function(heads["rhs"], [*_guard(program), "    return rates(t, x, u, p, dx);"]),
        _function(heads["out"], [*body(program, work.outputs(program)), ok]),
        _function(heads["jac"], [*_jacobian(program), ok]),
        _function(heads["jac_pattern"], jacobian.fill(program)),
        _function(heads["init"], [*_start(program), ok]),
    ]


def _jacobian(program: Program) -> list[str]:
    return [*jacobian.cleared(program), *body(program, work.jacobian(program))]


def _start(program: Program) -> list[str]:
    phases = [body(program, phase) for phase in work.start(program)]
    blocks = phases if len(phases) == 1 else map(_block, phases)  # they load the same names
    return [*chain.from_iterable(blocks)]


def _steps(program: Program) -> list[str]:
    heads = _heads(program)
    return [
        finish(program),
        *_stages(program),
        *(
            _function(heads[f"step_{name}"], [*_guard(program), *step(scheme, program)])
            for name, scheme in program.methods.items()
        ),
    ]


def _stages(program: Program) -> list[str]:
    """Return what the step of a splitting calls, if there is one."""
    if not any(isinstance(scheme, Verlet) for scheme in program.methods.values()):
        return []
    return [_function(head, lines) for head, lines in verlet.stages(program).items()]


def _guard(program: Program) -> list[str]:
    """Return the call of the checks."""
    if not program.checks:
        return []
    return [
        f"#ifdef {program.prefix}_CHECKS",
        "    const int broken = check(t, x, u, p);",
        "    if (broken) {",
        "        return broken;",
        "    }",
        "#endif",
    ]


def _block(lines: Sequence[str]) -> list[str]:
    return ["    {", *(f"    {line}" for line in lines), "    }"]


def _function(head: str, lines: Sequence[str]) -> str:
    """Return a function; arguments that its body does not use are voided."""
    text = "\n".join(lines)
    arguments = (part.split()[-1].lstrip("*") for part in head.split("(")[1].rstrip(")").split(","))
    unused = [f"    (void){name};" for name in arguments if not _mentions(text, name)]
    return "\n".join([*wrapped(head), "{", *unused, *lines, "}", ""])


def _mentions(text: str, name: str) -> bool:
    # A pattern that begins with a letter is found several times faster than one with \b.
    return re.search(rf"{name}\b(?<=\b{name})", text) is not None
