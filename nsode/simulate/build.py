"""From a model to a library: a C compiler, called without a shell."""

from __future__ import annotations

import platform
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from hashlib import sha256
from importlib.resources import files
from pathlib import Path

from nsode.backends import Options
from nsode.backends.c import emit
from nsode.diagnostics import Diagnostic, ModelError
from nsode.integrators import REGISTRY
from nsode.integrators.pairs import PAIRS, EmbeddedPair
from nsode.integrators.splittings import SPLITTINGS
from nsode.integrators.verlet import carries
from nsode.ode import AugmentedODE
from nsode.simulate import cache
from nsode.simulate.compilers import Compiler

#: Every name in the C begins with this, whatever the model is called.
PREFIX = "scene"

#: No -ffast-math: it drops the checks for NaN and flushes subnormals in the whole process.
#: Without contraction, gcc and clang agree bit for bit at every level of optimization.
_FLAGS = (
    "-std=c99", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-shared", "-w",
    f"-D{PREFIX}_CHECKS",
)  # fmt: skip
_FAST = (*_FLAGS, "-O3", "-fno-semantic-interposition")
_LONG = 16  # elements: loops over them gain from wide registers, all other code loses by them
_ZERO = (Fraction(0),)
_PATIENCE = 600  # seconds for one compilation


def library(ode: AugmentedODE, method: str, using: Compiler) -> Path:
    """Return the compiled library of a model and a method, from the cache if it is there.

    Raises
    ------
    ModelError
        NS509 if the compiler fails, NS510 if the cache is not safe.
    """
    texts = sources(ode, method)
    flags = optimization(ode)
    made_of = [using.identity, _processor(), *flags, *texts, *texts.values()]
    key = sha256("\0".join(made_of).encode()).hexdigest()[:32]
    return cache.obtain(key, lambda folder: _compile(texts, folder, using, flags))


def optimization(ode: AugmentedODE) -> tuple[str, ...]:
    """Return the flags with which the compiler makes the fastest code of a model."""
    longest = max((len(item.range) for item in ode.states if item.range), default=0)
    return (*_FAST, "-march=native") if longest >= _LONG and _processor() else _FAST


def sources(ode: AugmentedODE, method: str) -> dict[str, str]:
    """Return the C of a model and the loop around it, by file name.

    Raises
    ------
    ModelError
        NS501 if the method cannot step the model.
    """
    splittings = [SPLITTINGS[method]] if method in SPLITTINGS else []
    texts = emit(ode, Options(prefix=PREFIX), splittings)
    steps = "".join(
        f"static int {PREFIX}_step_{name}"
        "(double t, double h, double *x, const double *u, const double *p);\n"
        for name in (*REGISTRY, *(found.name for found in splittings))
    )
    file, definitions = "run.c", f"#define STEP {PREFIX}_step_{method}\n"
    if splittings and carries(ode) and not ode.checks:
        definitions += "#define CARRIED\n"
    if method in PAIRS:
        file, definitions = "pair.c", _tableau(PAIRS[method], bool(ode.checks))
    loop = files("nsode.simulate").joinpath(file).read_text(encoding="utf-8")
    return {
        f"{PREFIX}.h": texts[f"{PREFIX}.h"],
        f"{PREFIX}.c": texts[f"{PREFIX}.c"],
        "run.c": f"{definitions}{steps}{loop}",
    }


def _tableau(pair: EmbeddedPair, checked: bool) -> str:
    """Return the definitions that the loop of a pair reads."""
    stages = pair.method.stages
    rows = (f"{{ {_numbers((*row, *_ZERO * (stages - len(row))))} }}" for row in pair.method.a)
    found = {
        "STAGES": str(stages),
        "ORDER": str(pair.order),
        "CHECKED": str(int(checked)),
        "A": ", ".join(rows),
        "C": _numbers(pair.method.c),
        "E": _numbers(pair.error),
        "D": _numbers(pair.dense),
    }
    return "".join(f"#define {name} {value}\n" for name, value in found.items())


def _numbers(row: Iterable[Fraction]) -> str:
    return ", ".join(repr(float(number)) for number in row)


def _compile(texts: Mapping[str, str], folder: Path, using: Compiler, flags: Sequence[str]) -> Path:
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    target = folder / "run.so"
    told = ""
    for attempt in (flags, (*_FLAGS, "-O2")):  # an old compiler may not know them all
        command = [*using.command, *attempt, "-o", str(target), "run.c", "-lm"]
        try:
            done = subprocess.run(
                command, cwd=folder, env=using.environment(cache.workbench()),
                stdin=subprocess.DEVNULL, capture_output=True,
                text=True, errors="replace", timeout=_PATIENCE,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise _failed(using, f"not done after {_PATIENCE} s") from None
        except OSError as error:
            raise _failed(using, str(error)) from error
        if done.returncode == 0 and target.is_file():
            return target
        told = told or done.stderr.strip() or f"it returned {done.returncode}"
    raise _failed(using, told)


def _failed(using: Compiler, told: str) -> ModelError:
    lines = told.splitlines()[:3]
    return ModelError(
        [
            Diagnostic(
                "NS509",
                f"the C compiler `{' '.join(using.command)}` failed",
                notes=tuple(lines),
                help="name a working compiler in CC",
            )
        ]
    )


@lru_cache(maxsize=1)
def _processor() -> str:
    """Return what tells this processor's instructions from another's; empty if unknown."""
    wanted = ("model name", "flags", "Features", "CPU part")
    try:
        with Path("/proc/cpuinfo").open(encoding="utf-8", errors="replace") as file:
            first = file.read(16_384).partition("\n\n")[0]
    except OSError:
        return ""
    found = [line for line in first.splitlines() if line.startswith(wanted)]
    return "\n".join([platform.machine(), *found]) if found else ""
