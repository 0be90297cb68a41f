"""A model made ready to run: observed, compiled and loaded, once in a process."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, field

from nsode.diagnostics import Diagnostic, ModelError
from nsode.ode import AugmentedODE, DifferentialInclusion
from nsode.simulate.build import Compiler, compiler, library
from nsode.simulate.native import Native, load
from nsode.simulate.observe import Observed, observe

_KEPT = 32  # models that are remembered

#: Method, step and parameters of a run, which decide what is said before it.
Foreseen = tuple[str, float, bytes]


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """What every run of one model shares."""

    observed: Observed
    native: Native
    compiler: Compiler
    foreseen: dict[Foreseen, tuple[Diagnostic, ...]] = field(default_factory=dict)


_Key = tuple[int, int, str]
_known: OrderedDict[_Key, tuple[DifferentialInclusion, AugmentedODE, Scene]] = OrderedDict()


def scene(inclusion: DifferentialInclusion, ode: AugmentedODE, method: str) -> Scene:
    """Return a model ready to run by a method; at once if it did before in this process.

    Raises
    ------
    ModelError
        NS509 if it cannot be compiled, NS510 if the cache is not safe.
    """
    using = compiler()
    if using is None:
        raise ModelError(
            [
                Diagnostic(
                    "NS509",
                    "there is no C compiler on this machine",
                    help="install gcc or clang, or name one in CC",
                )
            ]
        )
    key = (id(inclusion), id(ode), method)
    found = _known.get(key)
    if found is None or found[2].compiler != using:
        # The table holds the model itself, so that nothing else can take over its id.
        found = (inclusion, ode, _made(inclusion, ode, method, using))
        _known[key] = found
        if len(_known) > _KEPT:
            _known.popitem(last=False)
    return found[2]


def _made(
    inclusion: DifferentialInclusion, ode: AugmentedODE, method: str, using: Compiler
) -> Scene:
    observed = observe(inclusion, ode)
    return Scene(observed, load(observed.ode, library(observed.ode, method, using)), using)
