"""Stage 4: what an augmented ODE is written as. One module for each target.

A module has ``emit(ode, options) -> {file name: text}`` and ``lower(expr, ...)``.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Literal

from nsode.diagnostics import quoted
from nsode.ode import AugmentedODE

#: Every target with the module that emits it; a module is imported when it is used.
TARGETS: dict[str, str] = {
    "c": "nsode.backends.c",
    "numpy": "nsode.backends.numpy",
    "casadi": "nsode.backends.casadi",
    "latex": "nsode.backends.latex",
    "markdown": "nsode.backends.markdown",
}


@dataclass(frozen=True, slots=True)
class Options:
    """What a target may be asked for; ``prefix`` None means the name of the model."""

    prefix: str | None = None
    real: Literal["double", "float"] = "double"


def emit(target: str, ode: AugmentedODE, options: Options = Options()) -> dict[str, str]:
    """Return the files that a target consists of, by name.

    Raises
    ------
    ValueError
        If there is no such target; the message names all.
    """
    if target not in TARGETS:
        known = quoted(TARGETS)
        raise ValueError(f"there is no target `{target}`: choose from {known}")
    files: dict[str, str] = import_module(TARGETS[target]).emit(ode, options)
    return files
