"""``nsode doctor``."""

from __future__ import annotations

import platform
import re
import shutil
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import click

import nsode
from nsode.cli.terminal import bold, quiet, say

LIBRARIES = {
    "lark": "reads models",
    "click": "the command line",
    "numpy": "arrays",
}
OPTIONAL = {
    "casadi": "-t casadi, optimization, CVODES",
    "do-mpc": "predictive control through CasADi",
    "sympy": "symbols to explore",
    "pint": "checks units beside those of SI",
    "scipy": "its integrators",
    "matplotlib": "plots",
    "ziglang": "a C compiler from a wheel",
}
COMPILERS = {
    "gcc": ("compiles the C to run it", "apt install gcc"),
    "clang": ("the same", "apt install clang"),
    "arm-none-eabi-gcc": ("the C for a Cortex-M", "apt install gcc-arm-none-eabi"),
    "qemu-system-arm": ("tests that C", "apt install qemu-system-arm"),
}


@click.command()
def command() -> None:
    """Show what nsode finds on this machine, what for, and how to get the rest."""
    from nsode.simulate.compilers import WAY_OUT, compiler

    say(f"nsode {nsode.__version__} in {Path(nsode.__file__).parent}")
    say(f"python {platform.python_version()}, {platform.system()} {platform.machine()}")
    _libraries("libraries", LIBRARIES)
    _libraries("optional libraries", OPTIONAL)
    _section("programs", {name: _program(name) for name in COMPILERS}, COMPILERS)
    if compiler() is None:
        slowly = "CasADi runs them, slowly" if _library("casadi") else "nsode cannot run them"
        say(f"\nno C compiler: models still compile to C, but {slowly}; {WAY_OUT}")


def _libraries(title: str, purposes: dict[str, str]) -> None:
    about = {name: (purpose, f"pip install {name}") for name, purpose in purposes.items()}
    _section(title, {name: _library(name) for name in purposes}, about)


def _section(title: str, found: dict[str, str | None], about: dict[str, tuple[str, str]]) -> None:
    say(f"\n{bold(title)}")
    for name, state in found.items():
        purpose, way = about[name]
        shown = "-" if state is None else state
        line = f"  {name:<18} {shown:<10} {purpose}"
        say(line if state is not None else f"{line}: {quiet(way)}")


def _library(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _program(name: str) -> str | None:
    """Return the version that a program tells, None where it is not installed."""
    path = shutil.which(name)
    if path is None:
        return None
    try:
        told = subprocess.run([path, "--version"], capture_output=True, text=True, timeout=10)
    except (OSError, subprocess.TimeoutExpired):
        return "broken"
    first = told.stdout.partition("\n")[0]
    # Debian writes its own version in parentheses before or behind the one that counts.
    numbers = re.findall(r"\d+\.\d+(?:\.\d+)?", re.sub(r"\([^)]*\)", "", first))
    return numbers[0] if numbers else "found"
