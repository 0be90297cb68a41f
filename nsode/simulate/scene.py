"""A model made ready to run: observed, compiled and loaded, once in a process."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, replace
from importlib.util import find_spec

from nsode.diagnostics import Diagnostic, ModelError
from nsode.integrators import REGISTRY
from nsode.integrators.pairs import PAIRS
from nsode.integrators.splittings import SPLITTINGS
from nsode.ode import AugmentedODE, DifferentialInclusion
from nsode.simulate.build import library
from nsode.simulate.compilers import WAY_OUT, Compiler, compiler
from nsode.simulate.guard import Books, with_books
from nsode.simulate.machine import Machine
from nsode.simulate.native import load
from nsode.simulate.observe import Observed, observe
from nsode.simulate.stack import too_large_for_the_stack
from nsode.simulate.virtual import virtual

_KEPT = 32  # models that are remembered


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """What every run of one model shares."""

    observed: Observed
    machine: Machine
    compiler: Compiler | None
    books: Books | None


_Key = tuple[int, int, str, bool]
_known: OrderedDict[_Key, tuple[DifferentialInclusion, AugmentedODE, Scene]] = OrderedDict()


def scene(
    inclusion: DifferentialInclusion, ode: AugmentedODE, method: str, *, watched: bool = False
) -> Scene:
    """Return a model ready to run by a method; at once if it did before in this process.

    One that is ``watched`` keeps books of its energy, where the method has fixed steps.

    Raises
    ------
    ModelError
        NS509 if it cannot be compiled, NS510 if the cache is not safe.
    """
    using = compiler()
    watched = watched and method in REGISTRY
    key = (id(inclusion), id(ode), method, watched)
    found = _known.get(key)
    if found is None or found[2].compiler != using:
        # The table holds the model itself, so that nothing else can take over its id.
        found = (inclusion, ode, _made(inclusion, ode, method, using, watched))
        _known[key] = found
        if len(_known) > _KEPT:
            _known.popitem(last=False)
    return found[2]


def _made(
    inclusion: DifferentialInclusion,
    ode: AugmentedODE,
    method: str,
    using: Compiler | None,
    watched: bool,
) -> Scene:
    observed, books = observe(inclusion, ode), None
    kept = with_books(inclusion, observed.ode) if watched else None
    if kept is not None:
        observed, books = replace(observed, ode=kept[0]), kept[1]
    compiled = (*REGISTRY, *PAIRS, *SPLITTINGS)
    stepped = method if method in compiled else next(iter(REGISTRY))
    if using is not None:
        crowded = too_large_for_the_stack(observed.ode)
        if crowded is not None:
            raise ModelError([crowded])
        return Scene(
            observed, load(observed.ode, library(observed.ode, stepped, using)), using, books
        )
    if stepped not in REGISTRY or find_spec("casadi") is None:
        raise ModelError([_no_compiler(stepped)])
    return Scene(observed, virtual(observed.ode, stepped), None, books)


def _no_compiler(method: str) -> Diagnostic:
    way_out = WAY_OUT
    if method in REGISTRY:
        way_out += "; `pip install casadi` runs models without, slowly"
    return Diagnostic("NS509", "there is no C compiler on this machine", help=way_out)


def slowly(made: Scene) -> list[Diagnostic]:
    """Return the word on a run without a compiler."""
    if made.compiler is not None:
        return []
    message = "no C compiler: CasADi runs the model, some hundred times slower"
    return [Diagnostic("NS509", message, help=WAY_OUT, severity="note")]
