"""Names of a model as Python identifiers."""

from __future__ import annotations

import builtins
import keyword
import re
import sys
from collections.abc import Iterable

from nsode.backends.naming import distinct

#: Names that a generated module defines or takes as arguments.
_OWN = {
    *("np", "real", "numpy", "t", "h", "x", "u", "p", "y", "dx", "rhs", "out", "init"),
    *("NX", "NU", "NP", "NY", "x_names", "u_names", "p_names", "y_names", "u0", "p0"),
    *("sat", "shrink", "norm", "total", "indices", "solve", "vectors", "flush"),
    *("add", "tiny"),
}
RESERVED = frozenset({*_OWN, *keyword.kwlist, *keyword.softkwlist, *dir(builtins)})


def python_names(names: Iterable[str]) -> dict[str, str]:
    """Return an identifier for each name: ``q[1]`` is ``q_1``, ``lambda`` ``lambda_``."""
    return distinct(names, _spell, reserved=RESERVED)


def module_stem(prefix: str) -> str:
    """Return the name of the file, moved aside where it would hide a module of Python."""
    stem = _spell(prefix)
    hides = stem == "numpy" or stem in sys.stdlib_module_names or keyword.iskeyword(stem)
    return f"{stem}_model" if hides else stem


def _spell(name: str) -> str:
    word = re.sub(r"[^A-Za-z0-9_]", "_", name.replace("]", ""))
    # A leading underscore stays free for the module's own use; a digit cannot lead.
    return word if word[:1].isalpha() else f"n{word}"
