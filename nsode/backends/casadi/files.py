"""The functions as text, and the Python module that loads them again."""

from __future__ import annotations

from nsode import __version__
from nsode.backends.casadi.model import CasadiModel
from nsode.backends.numpy.names import module_stem
from nsode.backends.numpy.tables import tables
from nsode.ode import AugmentedODE

_LOADER = '''\
"""The augmented ODE of {stem} as CasADi functions, written by nsode {version}.

rhs(t, x, u, p), out(t, x, u, p), step(t, h, x, u, p) and init(u, p), in the order of
the names below; p0 and u0 hold the values that the model gives.
"""

from pathlib import Path

import casadi as ca
import numpy as np

{tables}

_lines = Path(__file__).with_name("{stem}.casadi").read_text(encoding="ascii").split()
rhs, out, step, init = (ca.Function.deserialize(line) for line in _lines)
'''


def files(model: CasadiModel, ode: AugmentedODE, prefix: str) -> dict[str, str]:
    """Return both files; the text depends on the version of CasADi."""
    stem = module_stem(prefix)
    shared = [model.rhs, model.out, model.step, model.init]
    serialized = "".join(f"{function.serialize()}\n" for function in shared)
    table = "\n".join(line for line in tables(ode, "float64") if not line.startswith("tiny"))
    loader = _LOADER.format(stem=stem, version=__version__, tables=table)
    return {f"{stem}.casadi": serialized, f"{stem}_casadi.py": loader}
