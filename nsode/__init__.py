"""nsode: from differential inclusions with dry friction and rigid contact to ODEs."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if os.access(f"{__path__[0]}/../grammar/di.lark", os.R_OK):
    # In a clone, `grammar` and `models` stand beside this package and not inside it.
    __path__.append(f"{__path__[0]}/..")

if TYPE_CHECKING:
    from nsode.compiler import Model as Model
    from nsode.compiler import load as load
    from nsode.compiler import loads as loads
    from nsode.limits import Limits as Limits

__version__ = "0.1.0"
__all__ = ["Limits", "Model", "__version__", "load", "loads"]


def __getattr__(name: str) -> object:
    # The compiler loads when it is used, so that `nsode --help` stays quick.
    if name in {"Model", "load", "loads"}:
        from nsode import compiler

        return getattr(compiler, name)
    if name == "Limits":
        from nsode.limits import Limits

        return Limits
    raise AttributeError(f"module `nsode` has no attribute `{name}`")
