"""``nsode new``."""

from __future__ import annotations

from pathlib import Path

import click

from nsode.cli.failure import writing
from nsode.cli.options import folder_option
from nsode.cli.terminal import bold, quiet, say, typed
from nsode.diagnostics import Diagnostic, ModelError
from nsode.files import create

STARTER = """\
# A block on a table: it falls, lands, slides and comes to rest.
# A unit stands in braces, a comment begins with #. Change anything and see.
model NAME

parameter M  = 1    {kg}        # values can be changed later without compiling again
parameter mu = 0.3  {1} >= 0    # the bound proves that friction never pushes
parameter g  = 9.81 {m/s^2}

state p[2] = [0, 0.1]  {m}      # p.x along the table, p.y above it
state v[2] = [2, 0]    {m/s}

# dio(gap): no force while the gap is open, any force that keeps it from closing further.
force N = dio(p.y)  {N}
# chi*sgn(velocity): chi against the motion; at rest whatever balances, up to chi.
force F = mu*N*sgn(v.x)  {N}

der(p) = v
M*der(v) = [-F, N - M*g]

output height = p.y  {m}

# Each set-valued force becomes a stiff, damped element with a state of its own.
# K is its stiffness; alpha < beta sets how much a bounce loses.
approximate N: K = 1e5 {N/m}, beta = 4e-3 {s}, alpha = 2.8e-3 {s}
approximate F: K = 1e5 {N/m}, beta = 4e-3 {s}

simulate 2 {s} step 1e-3 {s} method rk4
"""


@click.command()
@click.argument("name")
@folder_option
def command(name: str, folder: Path) -> int:
    """Write NAME.di, a model to start from. A file that exists is left alone."""
    name = name.removesuffix(".di")
    text = STARTER.replace("NAME", name)
    _refuse_bad_name(name, text)
    path = folder / f"{name}.di"
    with writing():
        _create(path, text)
    say(f"wrote {bold(str(path))}")
    say(quiet(f"next: nsode compile {typed(path)} -t c -o build"))
    return 0


def _create(path: Path, text: str) -> None:
    try:
        create(path, text)
    except FileExistsError as error:
        way_out = "choose another name"
        raise ModelError([Diagnostic("NS602", f"`{path}` exists", help=way_out)]) from error


def _refuse_bad_name(name: str, text: str) -> None:
    """Let the language itself judge a name: only a model that compiles is written."""
    from nsode import compiler

    if not name.isidentifier():
        message = f"`{name}` cannot name a model"
        way_out = "a letter, then letters, digits and underscores"
        raise ModelError([Diagnostic("NS603", message, help=way_out)])
    try:
        compiler.loads(text, f"{name}.di")
    except ModelError as error:
        first = error.diagnostics[0]
        raise ModelError([Diagnostic("NS603", first.message, help=first.help)]) from error
