"""PREFIX.h: what a program that uses a model sees."""

from __future__ import annotations

from collections.abc import Iterable

from nsode.backends.c.function import wrapped
from nsode.backends.c.program import Program, Vector

_WHAT = {"x": "states", "u": "inputs", "p": "parameters", "y": "outputs"}

STATUS = """\
/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with {prefix}_CHECKS): check number status - BROKEN of {prefix}.json. */
enum {{
    {prefix}_OK = 0,
    {prefix}_NOT_FINITE = 1,
    {prefix}_SINGULAR = 2,
    {prefix}_BROKEN = 16
}};
"""


def prototypes(program: Program) -> dict[str, str]:
    """Return the head of every function of the interface, by its name."""
    real = f"{program.prefix}_real"
    state = f"{real} t, const {real} *x, const {real} *u, const {real} *p"
    step = f"{real} t, {real} h, {real} *x, const {real} *u, const {real} *p"
    heads = {
        "rhs": f"{state}, {real} *dx",
        "out": f"{state}, {real} *y",
        "jac": f"{state}, {real} *J",
        "jac_pattern": "int *row, int *col",
        "init": f"const {real} *p, {real} *x",
        **{f"step_{name}": step for name in program.methods},
    }
    return {name: f"int {program.prefix}_{name}({args})" for name, args in heads.items()}


def _comment(program: Program, name: str) -> str:
    if name.startswith("step_"):
        return f"One step of size h: {program.methods[name.removeprefix('step_')].title}."
    return {
        "rhs": "The rates dx of the states x at time t, for inputs u and parameters p.",
        "out": "The outputs y: the declared ones, then every force.",
        "jac": "The derivatives of the rates by the states, in the places of the pattern.",
        "jac_pattern": "Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1.",
        "init": "The states at the start, for these parameters.",
    }[name]


def header(program: Program) -> str:
    """Return the text of the header."""
    prefix = program.prefix
    functions = "".join(
        "\n".join([f"/* {_comment(program, name)} */", *wrapped(f"{head};"), ""])
        for name, head in prototypes(program).items()
    )
    return f"""\
/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef {prefix}_H
#define {prefix}_H

#ifdef __cplusplus
extern "C" {{
#endif

typedef {"float" if program.single else "double"} {prefix}_real;

{_enum(_counts(program))}
{"".join(_places(program, vector) for vector in program.vectors)}{STATUS.format(prefix=prefix)}
/* A step leaves x untouched unless it returns 0. */

{functions}
{_tables(program)}
#ifdef __cplusplus
}}
#endif

#endif
"""


def _enum(lines: Iterable[str]) -> str:
    return "enum {\n    " + ",\n    ".join(lines) + "\n};\n"


def _counts(program: Program) -> list[str]:
    sizes = [f"{program.prefix}_N{v.letter.upper()} = {v.size}" for v in program.vectors]
    return [*sizes, f"{program.prefix}_JAC_NNZ = {program.jacobian.size}"]


def _places(program: Program, vector: Vector) -> str:
    """Return the places of a vector; of a family, the place of its first element."""
    lines = [
        f"{program.enumerator(vector, name)} = {slot.offset}" for name, slot in vector.slots.items()
    ]
    return f"/* {_WHAT[vector.letter]} */\n{_enum(lines)}\n" if lines else ""


def _tables(program: Program) -> str:
    prefix = program.prefix
    names = "".join(f"extern const char {prefix}_{v.letter}_names[];\n" for v in program.vectors)
    return f"""\
/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const {prefix}_real {prefix}_p0[];
{names}"""
