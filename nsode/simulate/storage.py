"""Trajectories in files: ``.npz`` holds all of one, ``.csv`` the numbers."""

from __future__ import annotations

import json
import zipfile
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np

from nsode.diagnostics import Diagnostic, ModelError
from nsode.files import open_regular, write_binary
from nsode.simulate.trajectory import Trajectory

_Array = np.ndarray[Any, Any]

_SCHEMA = 1
#: What has a row for each time: under which name, and in which numbers.
_KINDS = {
    "x": ("x", np.float64),
    "y": ("y", np.float64),
    "psi": ("psi", np.float64),
    "mode": ("modes", np.int8),
}
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
        with open_regular(path) as file, np.load(file, allow_pickle=False) as held:
            return _trajectory({name: held[name] for name in held.files})
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise ModelError([Diagnostic("NS601", f"cannot read `{path}`: {reason}")]) from error
    except _FOREIGN as error:
        message = f"`{path}` is no trajectory that nsode wrote"
        raise ModelError([Diagnostic("NS601", message)]) from error


#: What reading raises on files that hold something else, or a size that no memory has.
_FOREIGN = (
    *(AttributeError, EOFError, KeyError, MemoryError, NotImplementedError, RecursionError),
    *(TypeError, ValueError, zipfile.BadZipFile, zlib.error),
)


def _trajectory(arrays: Mapping[str, _Array]) -> Trajectory:
    meta = json.loads(str(arrays["meta"][()]))
    about = meta.pop("trajectory")
    t = _checked(arrays, "t", (arrays["t"].size,), np.float64)
    named = {kind: tuple(map(str, arrays[f"{kind}_names"].tolist())) for kind in _KINDS}
    tables = {
        kind: _checked(arrays, key, (t.size, len(named[kind])), dtype)
        for kind, (key, dtype) in _KINDS.items()
    }
    return Trajectory(
        name=about["name"], t=t,
        x=tables["x"], x_names=named["x"],
        y=tables["y"], y_names=named["y"],
        psi=tables["psi"], psi_names=named["psi"],
        modes=tables["mode"], mode_names=named["mode"],
        forces=tuple(about["forces"]), units=about["units"], meta=meta,
    )  # fmt: skip


def _checked(arrays: Mapping[str, _Array], key: str, shape: tuple[int, ...], dtype: type) -> _Array:
    if (arrays[key].shape, arrays[key].dtype) != (shape, dtype):
        raise ValueError(key)
    return arrays[key]


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
        for kind in _KINDS
    }
    keys = ("t", *(key for key, _ in _KINDS.values()))
    arrays: dict[str, Any] = {key: getattr(trajectory, key) for key in keys}
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
