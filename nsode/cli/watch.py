"""Waiting for files to change."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import click

_PAUSE = 0.2  # seconds between two looks


def watched(files: Sequence[str]) -> Iterator[None]:
    """Yield once, and again after each change of a file, for ever."""
    seen = None
    while True:
        stamps = [_stamp(Path(file)) for file in files]
        if stamps != seen:
            seen = stamps
            if sys.stdout.isatty():
                click.clear()
            yield
            sys.stdout.flush()
        time.sleep(_PAUSE)


def _stamp(path: Path) -> tuple[int, int, int] | None:
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino
