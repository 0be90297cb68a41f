"""Differential inclusions with dry friction and rigid contact, compiled to ODEs.

A model is text with ``sgn()`` for friction and ``dio()`` for contact::

    model = nsode.load("rolling_sphere.di")  # or nsode.loads(text)
    model.compile("c", "build")              # plain C, to copy anywhere
    run = model.simulate(step=1e-3)          # runs that C
    run["v.x"], run.plot()
    model.analyze()                          # stable steps, effective mass, restitution
    model.explain()                          # each term and what replaces it

What is refused is a :class:`ModelError` with a code, a place and a way out.
"""

from __future__ import annotations

import os
from importlib import import_module
from typing import TYPE_CHECKING

if os.access(f"{__path__[0]}/../grammar/di.lark", os.R_OK):
    # In a clone, `grammar` and `models` stand beside this package and not inside it.
    __path__.append(f"{__path__[0]}/..")

if TYPE_CHECKING:
    from nsode.backends import Options as Options
    from nsode.compiler import Model as Model
    from nsode.compiler import load as load
    from nsode.compiler import loads as loads
    from nsode.diagnostics import ModelError as ModelError
    from nsode.limits import Limits as Limits
    from nsode.simulate import RunError as RunError
    from nsode.simulate import RunWarning as RunWarning
    from nsode.simulate import Trajectory as Trajectory

__version__ = "0.1.0"

# Each loads when it is used, so that `nsode --help` stays quick.
_HOMES = {
    "Limits": "nsode.limits",
    "Model": "nsode.compiler",
    "ModelError": "nsode.diagnostics",
    "Options": "nsode.backends",
    "RunError": "nsode.simulate",
    "RunWarning": "nsode.simulate",
    "Trajectory": "nsode.simulate",
    "load": "nsode.compiler",
    "loads": "nsode.compiler",
}
__all__ = [
    "Limits",
    "Model",
    "ModelError",
    "Options",
    "RunError",
    "RunWarning",
    "Trajectory",
    "__version__",
    "load",
    "loads",
]


def __getattr__(name: str) -> object:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module `nsode` has no attribute `{name}`")


def __dir__() -> list[str]:
    return list(__all__)
