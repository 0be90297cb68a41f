"""The generated RK4 step against a hand-written one of the same equations, at equal flags."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path
from statistics import median
from typing import NamedTuple

import nsode
from families import ROW
from measure import table
from nsode.ode import element_names
from support import MODELS

HERE = Path(__file__).parent
FLAGS = ("-O3 -march=native", "-O3", "-O2")


class Scene(NamedTuple):
    """A model, a step, how many, and the order in which the hand-written C wants p."""

    name: str
    step: float
    steps: int
    parameters: str


def _constants(terms: str, constants: str) -> str:
    return " ".join(
        f"{term}.{constant}" for term in terms.split() for constant in constants.split()
    )


SCENES = [
    Scene("rolling_sphere", 1e-3, 4000, "M R mu g N.K N.beta N.alpha F.K F.beta"),
    Scene(
        "two_blocks_conveyor", 5e-4, 1000,
        "M1 M2 Ks mu1 mu2 mu3 u g "
        + _constants("N1 N2 N3", "K beta alpha") + " " + _constants("F1 F2 F3", "K beta"),
    ),
    Scene("row", 1e-3, 200, "M d N.K N.beta N.alpha"),
]  # fmt: skip


def main() -> None:
    """Measure and print."""
    rows = [_row(scene, flags) for scene in SCENES for flags in FLAGS]
    head = ("RK4 step", "flags", "generated ns", "by hand ns", "ratio", "difference")
    table("The generated step against the hand-written one (medians of one run)", head, rows)


def _row(scene: Scene, flags: str) -> tuple[str, ...]:
    with tempfile.TemporaryDirectory() as folder:
        told = subprocess.run(
            [str(_build(scene, flags, Path(folder)))],
            check=True, capture_output=True, text=True,
        ).stdout.splitlines()  # fmt: skip
    pairs = [tuple(map(float, line.split())) for line in told[:-1]]
    generated, hand = (median(column) for column in zip(*pairs, strict=True))
    ratio = median(a / b for a, b in pairs)
    numbers = f"{generated:.1f}", f"{hand:.1f}", f"{ratio:.3f}", f"{float(told[-1]):.1e}"
    return (scene.name, flags, *numbers)


def _text(scene: Scene) -> str:
    if scene.name == "row":
        return ROW.format(n=100)
    [path] = [model for model in MODELS if model.stem == scene.name]
    return path.read_text(encoding="utf-8")


def _build(scene: Scene, flags: str, folder: Path) -> Path:
    model = nsode.loads(_text(scene))
    model.compile("c", folder)
    place = {name: i for i, name in enumerate(element_names(model.ode.parameters))}
    order = ",".join(str(place[name]) for name in scene.parameters.split())
    program = folder / "race"
    definitions = {
        "HEADER": f'"{scene.name}.h"', "PREFIX": scene.name, "HAND_P": order,
        "STEP": scene.step, "STEPS": scene.steps,
    }  # fmt: skip
    command = [
        "gcc", "-std=c99", *flags.split(), *(f"-D{k}={v}" for k, v in definitions.items()),
        "-I", folder, "-o", program, HERE / "loop.c", folder / f"{scene.name}.c",
        HERE / "hand" / f"{scene.name}.c", "-lm",
    ]  # fmt: skip
    subprocess.run(list(map(str, command)), check=True)
    return program
