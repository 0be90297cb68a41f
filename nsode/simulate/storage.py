"""Trajectories in files: ``.npz`` holds all of one, ``.csv`` the numbers."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import numpy as np

from nsode.diagnostics import Diagnostic, ModelError
from nsode.files import write_binary
from nsode.simulate.trajectory import Trajectory

_SCHEMA = 1
_ARRAYS = ("t", "x", "y", "psi", "modes")
_CHUNK = 10_000  # rows of text that are made at a time


def save(trajectory: Trajectory, path: Path) -> Path:
    """Write a trajectory; the ending of the path says how.

    Raises
    ------
    ModelError
        NS602 for another ending.
    OSError
        If the file cannot be written; an older one stays as it was.
    """
    check_ending(path)
    writer = _WRITERS[path.suffix]
    write_binary(path, lambda file: writer(trajectory, file))
    return path


def check_ending(path: Path) -> None:
    """Refuse a path that does not say how to write it.

    Raises
    ------
    ModelError
        NS602 for another ending.
    """
    if path.suffix not in _WRITERS:
        known = " or ".join(f"`{ending}`" for ending in _WRITERS)
        message = f"cannot write `{path}`: the name must end in {known}"
        raise ModelError([Diagnostic("NS602", message)])


def load(path: Path) -> Trajectory:
    """Read what :func:`save` wrote as ``.npz``.

    Raises
    ------
    ModelError
        NS601 if it is something else.
    """
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as held:
            arrays = {name: held[name] for name in held.files}
        meta = json.loads(str(arrays["meta"][()]))
        about = meta.pop("trajectory")
        return Trajectory(
            name=about["name"],
            t=arrays["t"], x=arrays["x"], y=arrays["y"],
            x_names=_names(arrays["x_names"]), y_names=_names(arrays["y_names"]),
            psi=arrays["psi"], psi_names=_names(arrays["psi_names"]),
            modes=arrays["modes"], mode_names=_names(arrays["mode_names"]),
            forces=tuple(about["forces"]), units=about["units"], meta=meta,
        )  # fmt: skip
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise ModelError([Diagnostic("NS601", f"cannot read `{path}`: {reason}")]) from error
    except (KeyError, TypeError, ValueError, EOFError, zipfile.BadZipFile) as error:
        message = f"`{path}` is no trajectory that nsode wrote"
        raise ModelError([Diagnostic("NS601", message)]) from error


def _names(array: np.ndarray[Any, Any]) -> tuple[str, ...]:
    return tuple(map(str, array.tolist()))


def _npz(trajectory: Trajectory, file: IO[bytes]) -> None:
    about = {
        "schema_version": _SCHEMA,
        "name": trajectory.name,
        "forces": trajectory.forces,
        "units": dict(trajectory.units),
    }
    meta = json.dumps({"trajectory": about, **trajectory.meta}, allow_nan=False)
    names: dict[str, Any] = {
        f"{kind}_names": np.array(getattr(trajectory, f"{kind}_names"), dtype=np.str_)
        for kind in ("x", "y", "psi", "mode")
    }
    arrays: dict[str, Any] = {key: getattr(trajectory, key) for key in _ARRAYS}
    np.savez(file, meta=np.array(meta), **arrays, **names)


def _csv(trajectory: Trajectory, file: IO[bytes]) -> None:
    head = ",".join(("t", *trajectory.x_names, *trajectory.y_names))
    file.write(f"{head}\n".encode())
    for first in range(0, len(trajectory), _CHUNK):
        rows = slice(first, first + _CHUNK)
        table = np.column_stack([trajectory.t[rows], trajectory.x[rows], trajectory.y[rows]])
        lines = (",".join(map(repr, row)) for row in table.tolist())
        file.write("".join(f"{line}\n" for line in lines).encode())


_WRITERS: dict[str, Callable[[Trajectory, IO[bytes]], None]] = {".npz": _npz, ".csv": _csv}
