"""Which C compiler runs models: that of ``CC``, the system's, or one from a wheel."""

from __future__ import annotations

import os
import shlex
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from nsode.diagnostics import Diagnostic, ModelError

#: How to get a compiler, for whoever has none.
WAY_OUT = "install gcc or clang, name one in CC, or `pip install ziglang`"

_SYSTEM = ("cc", "gcc", "clang", "tcc")
_WHEEL = "ziglang"  # Zig, which holds all of clang and needs no headers of the system
#: By default Zig's clang traps on undefined behavior, as no other compiler does.
_AS_OTHERS = ("cc", "-fno-sanitize=undefined")


@dataclass(frozen=True, slots=True)
class Compiler:
    """A C compiler: the command, and what tells this version of it from another."""

    command: tuple[str, ...]
    identity: str

    def environment(self, home: Path) -> Mapping[str, str]:
        """Return the variables of its process; what it keeps for itself goes into ``home``.

        Zig builds its headers and stubs once, in seconds, and finds them there afterwards.
        """
        return {**os.environ, "ZIG_GLOBAL_CACHE_DIR": str(home), "ZIG_LOCAL_CACHE_DIR": str(home)}


def compiler() -> Compiler | None:
    """Return the C compiler that runs models, None if this machine has none.

    Raises
    ------
    ModelError
        NS509 where ``CC`` cannot be read as a command.
    """
    for program, *arguments in _commands():
        path = shutil.which(program)
        if path is not None:
            state = Path(path).resolve().stat()
            identity = f"{path} {arguments} {state.st_size} {state.st_mtime_ns}"
            return Compiler((path, *arguments), identity)
    return None


def _commands() -> Iterator[Sequence[str]]:
    named = _named()
    if named:
        yield named
    yield from ([name] for name in _SYSTEM)
    found = find_spec(_WHEEL)
    if found is not None and found.origin is not None:
        yield [str(Path(found.origin).with_name("zig")), *_AS_OTHERS]


def _named() -> list[str]:
    try:
        return shlex.split(os.environ.get("CC", ""))
    except ValueError as error:
        why = f"CC is not the command of a compiler: {str(error).lower()}"
        raise ModelError([Diagnostic("NS509", why, help=WAY_OUT)]) from error


def overlooked() -> list[Diagnostic]:
    """Return a note where ``CC`` names a compiler that is not there."""
    named = _named()
    if not named or shutil.which(named[0]) is not None:
        return []
    found = compiler()
    used = "no other was found" if found is None else f"`{found.command[0]}` is used"
    message = f"CC names `{named[0]}`, which is not there; {used}"
    return [Diagnostic("NS509", message, severity="note")]
