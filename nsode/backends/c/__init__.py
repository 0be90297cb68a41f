"""Plain C: a header, a source file and a description."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from nsode.backends import Options
from nsode.backends.c.expressions import Scope, lower
from nsode.backends.c.header import header
from nsode.backends.c.names import file_stem
from nsode.backends.c.program import program
from nsode.backends.c.single import check_single
from nsode.backends.c.source import source
from nsode.backends.descriptor import render
from nsode.integrators.splittings import Verlet
from nsode.ode import AugmentedODE

__all__ = ["Scope", "emit", "lower"]


_DEFAULTS = Options()


def emit(
    ode: AugmentedODE, options: Options = _DEFAULTS, splittings: Iterable[Verlet] = ()
) -> dict[str, str]:
    """Write a model as C99 that is also C++.

    Parameters
    ----------
    ode
        The model; its units are SI throughout.
    options
        The prefix of every name and the type of a number.
    splittings
        Methods that are written besides the registered ones.

    Returns
    -------
    dict
        ``PREFIX.h``, ``PREFIX.c`` and ``PREFIX.json``; ``math`` and the like are moved aside.

    Raises
    ------
    ModelError
        NS501 if a splitting cannot step the model, NS116 for numbers that a float cannot
        hold where one is asked for.
    """
    if options.real == "float":
        check_single(ode)
    options = replace(options, prefix=file_stem(options.prefix or ode.name))
    made = program(ode, options, splittings)
    return {
        f"{made.prefix}.h": header(made),
        f"{made.prefix}.c": source(made),
        f"{made.prefix}.json": render(ode, options),
    }
