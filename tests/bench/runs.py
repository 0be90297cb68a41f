"""A run against the bare C loop of the same step, and what a call costs."""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from pathlib import Path
from statistics import median

import nsode
from measure import table
from nsode.simulate.build import optimization, sources
from nsode.simulate.observe import observe
from support.models import MODELS

HERE = Path(__file__).parent
SCENES = ("rolling_sphere", "two_blocks_conveyor", "bouncing_mass", "burridge_knopoff")
STEPS, ROWS, ROUNDS = 1_000_000, 10_000, 11


def main() -> None:
    """Measure and print."""
    rows = [_row(name) for name in SCENES]
    head = ("model", "bare ns/step", "run ns/step", "overhead", "first call s", "cached call ms")
    table(f"{STEPS:,} steps with {ROWS:,} rows against a bare loop (medians)", head, rows)


def _row(name: str) -> tuple[str, ...]:
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CACHE_HOME"] = folder
        model = nsode.load(MODELS / f"{name}.di")
        step = 1e-5
        first = _seconds(lambda: model.simulate(100 * step, step))
        cached = median(_seconds(lambda: model.simulate(100 * step, step)) for _ in range(20))
        model.simulate(STEPS * step, step, every=STEPS // ROWS)
        program = _bare(model, step, Path(folder))
        pairs = [
            (
                median(map(float, subprocess.check_output([program]).split())),
                1e9 / STEPS
                * _seconds(lambda: model.simulate(STEPS * step, step, every=STEPS // ROWS)),
            )
            for _ in range(ROUNDS)
        ]  # fmt: skip
    bare, run = (median(column) for column in zip(*pairs, strict=True))
    over = median(b / a for a, b in pairs) - 1
    shown = f"{bare:.1f}", f"{run:.1f}", f"{100 * over:+.1f} %"
    return (name, *shown, f"{first:.2f}", f"{1e3 * cached:.2f}")


def _seconds(action: object) -> float:
    begin = time.perf_counter()
    action()  # type: ignore[operator]
    return time.perf_counter() - begin


def _bare(model: nsode.Model, step: float, folder: Path) -> Path:
    ode = observe(model.inclusion, model.ode).ode
    texts = sources(ode, "rk4")
    for name in ("scene.h", "scene.c"):
        (folder / name).write_text(texts[name])
    alone = ("-shared", "-fPIC", "-Dscene_CHECKS")
    flags = [flag for flag in optimization(ode) if flag not in alone]
    p = ",".join(map(repr, model.p0.tolist()))
    definitions = [f"-DP={p}", f"-DSTEP={step}", f"-DSTEPS={STEPS}", "-DROUNDS=3"]
    program = folder / "bare"
    command = ["cc", *flags, *definitions, "-I", folder, HERE / "bare.c"]
    subprocess.run([*map(str, command), "-o", str(program), "-lm"], check=True)
    return program


if __name__ == "__main__":
    main()
