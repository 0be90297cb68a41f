"""The augmented ODE as the paper prints (32), (37) and (45): columns, then `where`."""

from __future__ import annotations

from nsode.backends import Options
from nsode.backends.latex.equations import definitions, environment, state_space
from nsode.backends.latex.lower import Environment, lower
from nsode.backends.latex.names import escape
from nsode.ode import AugmentedODE
from nsode.passes.prune import needed, reads
from nsode.passes.split import split

__all__ = ["DOCUMENT", "Environment", "emit", "equations", "lower"]

#: A document of its own, to be given a title and a body.
DOCUMENT = r"""% Written by nsode.
\documentclass{{article}}
\usepackage{{amsmath}}
\setcounter{{MaxMatrixCols}}{{64}}
\begin{{document}}
\section*{{{title}}}
{body}\end{{document}}
"""


def emit(ode: AugmentedODE, options: Options) -> dict[str, str]:
    """Return ``PREFIX.tex``, a document of its own."""
    body = equations(ode, "\\[\n{}\n\\]\n", "where\n")
    title = escape(ode.name)
    return {f"{options.prefix or ode.name}.tex": DOCUMENT.format(title=title, body=body)}


def equations(ode: AugmentedODE, display: str, between: str) -> str:
    """Return the equations, each set into ``display``: the columns, then the definitions."""
    env = environment(ode)
    pieces = split(ode)
    wanted = reads(*(rate.value for rate in pieces.rates))
    parts = [display.format(state_space(ode, env))]
    bindings = needed(pieces.bindings, wanted)
    if bindings:
        parts += [between, display.format(definitions(bindings, env))]
    return "".join(parts)
