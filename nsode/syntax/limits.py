"""How large a model may be: what stands between an untrusted text and the machine."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of the text of a model.

    Attributes
    ----------
    size
        Bytes or characters of the text (NS012).
    name
        Characters of a name (NS010).
    depth
        Levels of brackets, of signs and of the tree of an expression (NS011).
    errors
        Errors that are reported in one run.
    """

    size: int = 4 * 1024 * 1024
    name: int = 64
    depth: int = 64
    errors: int = 20


DEFAULT_LIMITS = Limits()
