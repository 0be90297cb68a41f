"""The C is clean and the same for every compiler, as C and as C++, and under sanitizers."""

from pathlib import Path

import numpy as np
import pytest

import nsode
from nsode.backends import Options, emit
from nsode.expr import Index, IndexRange, Name
from nsode.ode import AugmentedODE, LinearSolve, Output, Rate, State, size
from support import MODELS
from support.hand_built import call, column, num, ode
from support.native import WARNINGS, build, have, run_tool, write_files

CORTEX_M4 = ("-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16")
AS_CPP = ("-x", "c++", *(flag for flag in WARNINGS if flag != "-std=c99"))
COMMANDS = {
    "gcc": ("gcc", *WARNINGS, "-O2", "-c"),
    "clang": ("clang", *WARNINGS, "-fsyntax-only"),
    "g++": ("g++", *AS_CPP, "-fsyntax-only"),
    "clang++": ("clang++", *AS_CPP, "-fsyntax-only"),
    "tcc": ("tcc", "-c"),
    "cortex-m4": ("arm-none-eabi-gcc", *WARNINGS, *CORTEX_M4, "-fsyntax-only"),
}


def solves(n):
    """Every helper for linear systems, in a loop and alone."""
    i, over = Index("i"), IndexRange("i", 1, 5)
    at = Name("x", i)
    matrix = tuple(tuple(at if k == j else num(0.5) for k in range(n)) for j in range(n))
    unknowns = tuple(f"v{k}" for k in range(n))
    return ode(
        f"solves{n}",
        states=[State("x", call("+", i, 1), over)],
        bindings=[LinearSolve(unknowns, matrix, (num(1),) * n, over)],
        rates=[Rate("x", Name("v0", i), over)],
        outputs=[Output("v", Name(f"v{n - 1}", i), over)],
    )


def functions():
    x = Name("x")
    calls = [
        "sqrt",
        "exp",
        "log",
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "sinh",
        "cosh",
        "tanh",
    ]
    pairs = ["atan2", "min", "max", "mod", "sat", "shrink", "norm"]
    values = [call(f, x) for f in calls] + [call(f, x, 2) for f in pairs]
    values += [call("norm", *([x] * k)) for k in (1, 3, 4, 5)]
    values += [call("^", call("+", x, 1), k) for k in (2, 3, 5, 0.5, 1.5, -2, 11)]
    outputs = [Output(f"y{k}", value) for k, value in enumerate(values)]
    return ode("functions", states=[State("x", num(0.5))], rates=[Rate("x", x)], outputs=outputs)


def pressed():
    """A start in two phases, both of which read `R`."""
    text = """
model pressed
parameter R = 1
state z = 0.9*R
state v = 0
force N = dio(z - R)
der(z) = v
der(v) = N - 9.81
approximate N: K = 98.1, alpha = 2e-3, beta = 4e-3, at equilibrium
"""
    return nsode.loads(text).ode


BUILT = (column(9), functions(), pressed(), *map(solves, (1, 2, 4)))
SCENES = {scene.name: scene for scene in BUILT}
MODEL_NAMES = {path.stem: path for path in MODELS}


def scene(name):
    return SCENES[name] if name in SCENES else nsode.load(MODEL_NAMES[name]).ode


@pytest.mark.parametrize("compiler", COMMANDS)
@pytest.mark.parametrize("name", [*SCENES, *MODEL_NAMES])
def test_no_compiler_has_a_word_to_say(name, compiler, tmp_path):
    command = COMMANDS[compiler]
    if not have(command[0]):
        pytest.skip(f"{command[0]} is not installed")
    for real, checks in (("float", f"-D{name}_CHECKS"), ("double", "-DNOTHING")):
        if compiler == "cortex-m4" and real == "double":
            continue
        files = emit("c", scene(name), Options(real=real))
        [source] = [p for p in write_files(files, tmp_path / real) if p.suffix == ".c"]
        told = run_tool([*command, checks, source], cwd=tmp_path)
        assert told.stdout + told.stderr == ""


MAIN = """\
#include "{name}.h"
#include <stdio.h>

int main(void)
{{
    {name}_real x[{name}_NX + 1], y[{name}_NY + 1], u[] = {{ {inputs} }};
    int status = {name}_init({name}_p0, x);
    for (int k = 0; k < 2000; ++k) {{
        const {name}_real h = ({name}_real){step}, t = ({name}_real)k*h;
        status |= {name}_step_{method}(t, h, x, u, {name}_p0);
        status |= {name}_out(t, x, u, {name}_p0, y);
    }}
    for (int i = 0; i < {name}_NX; ++i) {{
        printf("%.17g\\n", (double)x[i]);
    }}
    return status;
}}
"""


def ran(folder: Path, scene: AugmentedODE, command: list[str], method: str = "rk4") -> str:
    """What two thousand steps print."""
    inputs = [item.default or 0.0 for item in scene.inputs for _ in range(size(item))]
    text = MAIN.format(
        name=scene.name,
        method=method,
        step=scene.run.step or 1e-3,
        inputs=", ".join(map(repr, [*inputs, 0.0])),
    )
    (folder / "main.c").write_text(text)
    program = folder / "program"
    run_tool([*command, folder / "main.c", folder / f"{scene.name}.c", "-o", program, "-lm"])
    told = run_tool([program])
    assert told.stderr == ""
    return told.stdout


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("name", [*SCENES, *MODEL_NAMES])
def test_sanitizers_find_nothing(name, compiler, tmp_path):
    if not have(compiler):
        pytest.skip(f"{compiler} is not installed")
    built = scene(name)
    write_files(emit("c", built), tmp_path)
    watch = "-fsanitize=address,undefined,float-divide-by-zero"
    checks = f"-D{name}_CHECKS"
    command = [compiler, "-g", "-O1", checks, watch, "-fno-sanitize-recover=all"]
    ran(tmp_path, built, command)


@pytest.mark.parametrize("name", ["column", *MODEL_NAMES])
def test_compilers_and_optimizations_agree_bit_for_bit(name, tmp_path):
    built = scene(name)
    write_files(emit("c", built), tmp_path)
    if "sin(" in (tmp_path / f"{name}.c").read_text():
        pytest.skip("the scene calls libm, which compilers evaluate at their own discretion")
    commands = [
        [compiler, level, "-ffp-contract=off"]
        for compiler in ("gcc", "clang")
        for level in ("-O0", "-O1", "-O2", "-O3")
        if have(compiler)
    ]
    results = {ran(tmp_path, built, command) for command in commands}
    assert len(results) == 1


def test_reading_and_writing_is_all_that_the_code_does(tmp_path):
    native = build(column(4), tmp_path)
    symbols = run_tool(["nm", "-D", "--defined-only", tmp_path / "model.so"]).stdout
    names = {line.split()[-1] for line in symbols.splitlines()}
    assert {name for name in names if not name.startswith("column_")} <= {"_init", "_fini"}
    undefined = run_tool(["nm", "-D", "--undefined-only", tmp_path / "model.so"]).stdout
    assert not {"malloc", "free", "fmax", "fmin"} & set(undefined.split())
    assert np.isfinite(native.init()).all()
