"""Files are read where they are files, and written whole or not at all."""

from __future__ import annotations

import errno
import os
import secrets
import stat
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from operator import methodcaller
from pathlib import Path
from typing import IO

_MARK, _HEAD = b"nsode", 4096  # generated files say at their head who wrote them


@contextmanager
def open_regular(path: str | os.PathLike[str]) -> Iterator[IO[bytes]]:
    """Open a file to read, without waiting for what is none, such as a pipe or a terminal.

    Raises
    ------
    OSError
        If there is no such file, or it is a folder, a pipe or a device.
    """
    with open(path, "rb", opener=_without_waiting) as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError(errno.EINVAL, "it is not a regular file", os.fspath(path))
        yield file


def _without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0))


def write_all(files: Mapping[str, str], folder: Path) -> list[Path]:
    """Write every file into ``folder``, which is made if need be, or none of them.

    All texts reach the disk under other names first; only then do the files appear.

    Raises
    ------
    OSError
        If a file cannot be written; nothing half written stays behind.
    ValueError
        If a name is more than the name of a file.
    """
    targets = [_inside(folder, name) for name in files]
    _make(folder)
    for target in targets:
        _refuse_other(target)
    drafts: list[Path] = []
    try:
        for target, text in zip(targets, files.values(), strict=True):
            drafts.append(_draft(target, methodcaller("write", text.encode("utf-8"))))
        for draft, target in zip(drafts, targets, strict=True):
            draft.replace(target)
    finally:
        for draft in drafts:
            draft.unlink(missing_ok=True)
    _settle(folder)
    return targets


def write_generated(files: Mapping[str, str], folder: Path) -> list[Path]:
    """Write generated files as :func:`write_all` does, but over none that a person wrote.

    Raises
    ------
    FileExistsError
        If a file of that name is there and its head does not say that nsode wrote it.
    OSError
        If a file cannot be written.
    """
    for name, text in files.items():
        target = _inside(folder, name)
        signed = _MARK in text[:_HEAD].lower().encode()
        if signed and target.is_file() and _MARK not in target.read_bytes()[:_HEAD].lower():
            told = "a file that nsode did not write is there"
            raise FileExistsError(errno.EEXIST, told, str(target))
    return write_all(files, folder)


def write_binary(path: Path, write: Callable[[IO[bytes]], object]) -> None:
    """Write one file by a function that fills it, whole or not at all; its folder is made.

    Raises
    ------
    OSError
        If the file cannot be written; an older one stays as it was.
    """
    _make(path.parent)
    _refuse_other(path)
    draft = _draft(path, write)
    try:
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)
    _settle(path.parent)


def create(path: Path, text: str) -> None:
    """Write a file that does not exist yet, in a folder that is made if need be.

    Raises
    ------
    FileExistsError
        If something of that name is there.
    """
    _make(path.parent)
    os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
    try:
        write_all({path.name: text}, path.parent)
    except BaseException:
        path.unlink(missing_ok=True)
        raise


def _make(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, "is no folder", str(folder))
    folder.mkdir(parents=True, exist_ok=True)


def _refuse_other(target: Path) -> None:
    """Refuse to put a file in the place of a folder, a device or a pipe."""
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "is a folder", str(target))
    if target.exists() and not target.is_file():
        raise OSError(errno.EINVAL, "is no regular file", str(target))


def _inside(folder: Path, name: str) -> Path:
    if name in {"", ".", ".."} or Path(name).name != name or "\0" in name:
        raise ValueError(f"`{name}` is not the plain name of a file")
    return folder / name


def _draft(target: Path, write: Callable[[IO[bytes]], object]) -> Path:
    """Fill a file beside ``target``, down to the disk, under a name of its own."""
    draft = target.with_name(f".{target.name}.{secrets.token_hex(6)}")
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    try:
        # The mode is that of a plain `open`, which `tempfile` would narrow to the owner.
        with os.fdopen(os.open(draft, flags, 0o666), "wb") as file:
            write(file)
            file.flush()
            os.fsync(file.fileno())
    except BaseException as error:
        draft.unlink(missing_ok=True)
        if isinstance(error, OSError):
            error.filename = str(target)  # nobody knows of the draft
        raise
    return draft


def _settle(folder: Path) -> None:
    """Make the names last, where the system lets a folder be synced."""
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
