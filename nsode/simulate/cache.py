"""Compiled models on disk, in a folder that belongs to us alone.

An entry is called ``KEY.DIGEST.so``: KEY is the hash of all that made it, DIGEST that of
its bytes, which are verified before they are loaded. Entries appear by renaming, so two
runs at once cannot see half of one, and one that was damaged is built again.
"""

from __future__ import annotations

import os
import shutil
import stat
import time
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from tempfile import mkdtemp
from typing import NamedTuple

from nsode.diagnostics import Diagnostic, ModelError

_MOST = 200  # entries that are kept
_STALE = 3600.0  # seconds after which the folder of a build that was killed goes away
_BUILDS = "build-"


class Cleared(NamedTuple):
    """What was removed."""

    entries: int
    size: int


def folder() -> Path:
    """Return where compiled models are kept: ``nsode`` in the cache folder of the user."""
    given = Path(os.environ.get("XDG_CACHE_HOME", ""))
    root = given if given.is_absolute() else Path.home() / ".cache"
    return root / "nsode"


def workbench() -> Path:
    """Return where a compiler may keep what it needs again: inside of the folder of entries."""
    return folder() / "compiler"


def obtain(key: str, build: Callable[[Path], Path]) -> Path:
    """Return the entry of a key, built now if it is not there or was damaged.

    Parameters
    ----------
    key
        The hash of all that goes into the entry, in hexadecimal digits.
    build
        Makes the library in an empty folder and returns its path.

    Raises
    ------
    ModelError
        NS510 if others can write into the cache; what ``build`` raises.
    """
    home = _opened()
    found = _find(home, key)
    if found is not None:
        return found
    _tidy(home)
    workshop = Path(mkdtemp(prefix=_BUILDS, dir=home))
    try:
        library = build(workshop)
        library.chmod(0o600)
        entry = home / f"{key}.{_digest(library)}.so"
        library.replace(entry)
    finally:
        shutil.rmtree(workshop, ignore_errors=True)
    return entry


def clear() -> Cleared:
    """Remove every entry and what a compiler kept; a build that may still go on stays.

    Raises
    ------
    ModelError
        NS510 if the folder is not ours.
    """
    if not folder().exists():
        return Cleared(0, 0)
    home = _opened()
    entries = list(home.glob("*.so"))
    size = sum(path.lstat().st_size for path in (*entries, *workbench().rglob("*")))
    for entry in entries:
        entry.unlink(missing_ok=True)
    shutil.rmtree(workbench(), ignore_errors=True)
    _sweep(home)
    return Cleared(len(entries), size)


def _opened() -> Path:
    """Return the folder, made if need be, once it is known to be ours alone."""
    home = folder()
    try:
        home.mkdir(mode=0o700, parents=True, exist_ok=True)
    except FileExistsError as error:
        raise _unsafe(home, "is not a folder") from error
    except OSError as error:
        raise _unwritable(home, error) from error
    state = home.lstat()
    if not stat.S_ISDIR(state.st_mode):
        raise _unsafe(home, "is not a folder")
    if hasattr(os, "geteuid") and state.st_uid != os.geteuid():
        raise _unsafe(home, "belongs to somebody else")
    if state.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        raise _unsafe(home, "can be written by others")
    if stat.S_IMODE(state.st_mode) != 0o700:
        home.chmod(0o700)
    return home


def _unsafe(home: Path, why: str) -> ModelError:
    return ModelError(
        [
            Diagnostic(
                "NS510",
                f"the build cache `{home}` {why}",
                notes=("code from it would run with your rights",),
                help="remove it, or name another place in XDG_CACHE_HOME",
            )
        ]
    )


def _unwritable(home: Path, error: OSError) -> ModelError:
    message = f"cannot make the build cache `{home}`: {str(error.strerror).lower()}"
    return ModelError([Diagnostic("NS602", message, help="name a place in XDG_CACHE_HOME")])


def _find(home: Path, key: str) -> Path | None:
    for entry in home.glob(f"{key}.*.so"):
        if entry.name == f"{key}.{_digest(entry)}.so":
            os.utime(entry)
            return entry
        entry.unlink(missing_ok=True)
    return None


def _digest(path: Path) -> str:
    """Return the hash of a file of ours; of anything else, one that no entry has."""
    try:
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0))
    except OSError:
        return ""
    with os.fdopen(descriptor, "rb") as file:
        return sha256(file.read()).hexdigest()


def _tidy(home: Path) -> None:
    """Remove what a killed build left behind, and the entries unused for longest."""
    _sweep(home)
    entries = sorted(home.glob("*.so"), key=_age)
    for entry in entries[_MOST:]:
        entry.unlink(missing_ok=True)


def _sweep(home: Path) -> None:
    for workshop in home.glob(f"{_BUILDS}*"):
        if _age(workshop) > _STALE:
            shutil.rmtree(workshop, ignore_errors=True)


def _age(path: Path) -> float:
    try:
        return time.time() - path.lstat().st_mtime
    except OSError:  # another run removed it
        return 0.0
