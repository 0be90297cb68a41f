"""How large a model may be: what stands between an untrusted text and the machine.

Every limit has a message of its own, which names the flag that raises it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass

#: Later stages walk a tree by recursion, some seven of Python's 1000 frames to a level, and
#: compilers bound how deep brackets nest. This depth works everywhere, 200 frames below the top.
DEEPEST = 100
#: Elements of a family beyond which tables of numbers take gigabytes.
MOST = 10_000_000
_GREATEST = {"depth": DEEPEST, "elements": MOST}


@dataclass(frozen=True, slots=True)
class Limits:
    """What a model and its runs may take.

    Attributes
    ----------
    size
        Bytes or characters of the text (NS012).
    name
        Characters of a name (NS010).
    depth
        Levels of brackets, of signs and of the tree of an expression (NS011); at most
        :data:`DEEPEST`.
    operations
        Operations in one expression after its vectors are written out (NS011).
    exponent
        The magnitude of a constant exponent (NS013).
    elements
        Elements of one family, and terms of sums inside each other (NS014); at most
        :data:`MOST`.
    sums
        Sums inside each other (NS011).
    vector
        Components of a vector, or rows or columns of a matrix (NS014).
    analysis
        States and multipliers of a model that is analyzed (NS014).
    steps, memory
        Steps of a run, and bytes that it stores (NS502).
    errors
        Errors that are reported in one run.

    Raises
    ------
    ValueError
        For a limit below 1, and for a depth or elements beyond what can be raised.
    """

    size: int = 4 * 1024 * 1024
    name: int = 64
    depth: int = 64
    operations: int = 50_000
    exponent: int = 64
    elements: int = 1_000_000
    sums: int = 3
    vector: int = 16
    analysis: int = 400
    steps: int = 10**9
    memory: int = 2 * 2**30
    errors: int = 20

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            if value < 1:
                raise ValueError(f"the limit `{name}` is at least 1, not {value}")
        for name, greatest in _GREATEST.items():
            value = getattr(self, name)
            if value > greatest:
                raise ValueError(f"the limit `{name}` is at most {greatest:,}, not {value:,}")

    @classmethod
    def of(cls, values: Mapping[str, int]) -> Limits:
        """Return the usual limits with some of them changed.

        Raises
        ------
        ValueError
            For a limit that there is not, or a value that it cannot have.
        """
        known = asdict(DEFAULT_LIMITS)
        for name in values:
            if name not in known:
                raise ValueError(f"there is no limit `{name}`: choose from {', '.join(known)}")
        return cls(**values)

    def raised(self, name: str, wanted: int = 0) -> str | None:
        """Return the way out of a limit: its flag, with what is wanted or with twice as much.

        None where it cannot be raised that far.
        """
        current: int = getattr(self, name)
        value = wanted if wanted > current else 2 * current
        greatest = _GREATEST.get(name, value)
        value = min(value, greatest) if wanted <= greatest else 0
        return f"raise the limit with `--limit {name}={value}`" if value > current else None


DEFAULT_LIMITS = Limits()


def either(first: str, limit: str | None) -> str:
    """Return two ways out, of which the second is to raise a limit where it can be."""
    return first if limit is None else f"{first}, or {limit}"
