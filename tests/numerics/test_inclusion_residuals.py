"""What the compiled C computes satisfies the inclusions, over 10^6 points.

With y = a + beta a' and Z = chi/K, (17a) is y = sat(Z, y + beta(theta - a')); with
y = e + beta e', (22) is min(y, psi + e + alpha e') = 0. Both hold up to rounding.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping

import numpy as np
import pytest

import nsode
from nsode.ode import element_names
from support.models import MODELS
from support.native import run_tool

POINTS, CHUNK = 1_000_000, 100_000

DRIVER = """
#include "{name}.h"
typedef {name}_real real;
void batch(long n, const real *x, const real *p, real *dx, real *y);
void batch(long n, const real *x, const real *p, real *dx, real *y)
{{
    const real u[1] = {{0}};
    for (long k = 0; k < n; ++k) {{
        {name}_rhs(0, x + k*{name}_NX, u, p, dx + k*{name}_NX);
        {name}_out(0, x + k*{name}_NX, u, p, y + k*{name}_NY);
    }}
}}
"""

Values = Mapping[str, np.ndarray]

#: Gap of each dio and (sliding velocity, factor) of each sgn, by hand.
GAPS: dict[str, dict[str, Callable]] = {
    "dry_friction": {},
    "bouncing_mass": {"f": lambda x, p: x["p"]},
    "frictional_contact": {"N": lambda x, p: x["p.z"]},
    "rolling_sphere": {"N": lambda x, p: x["p.z"] - p["R"]},
    "two_blocks_conveyor": {
        "N1": lambda x, p: x["p1.x"],
        "N2": lambda x, p: x["p2.x"] - x["p1.x"],
        "N3": lambda x, p: x["p2.y"],
    },
    "belt_oscillator": {},
}
SLIPS: dict[str, dict[str, Callable]] = {
    "dry_friction": {"F": lambda x, p, y: ([x["v"]], p["F0"])},
    "bouncing_mass": {},
    "frictional_contact": {"F": lambda x, p, y: ([x["v.x"], x["v.y"]], p["mu"] * y["N"])},
    "rolling_sphere": {
        "F": lambda x, p, y: (
            [x["v.x"] - p["R"] * x["w.y"], x["v.y"] + p["R"] * x["w.x"]],
            p["mu"] * y["N"],
        )
    },
    "two_blocks_conveyor": {
        "F1": lambda x, p, y: ([x["v1.y"]], p["mu1"] * y["N1"]),
        "F2": lambda x, p, y: ([x["v1.y"] - x["v2.y"]], p["mu2"] * y["N2"]),
        "F3": lambda x, p, y: ([x["v2.x"] + p["u"]], p["mu3"] * y["N3"]),
    },
    "belt_oscillator": {"Fc": lambda x, p, y: ([x["w"]], p["F"] / (p["V"] + np.abs(x["w"])))},
}


@pytest.fixture(scope="session")
def batch(compile_c):
    """Return ``batch(name, real)``: rates and outputs of many states at once."""

    def load(name: str, real: str):
        native = compile_c(MODELS / f"{name}.di", real=real)
        driver = native.folder / "driver.c"
        driver.write_text(DRIVER.format(name=name))
        library = native.folder / "batch.so"
        source = native.folder / f"{name}.c"
        run_tool(["gcc", "-O2", "-ffp-contract=off", "-fPIC", "-shared", "-o", library,
                  driver, source, "-lm"])  # fmt: skip
        run = ctypes.CDLL(str(library)).batch
        p = native.p0

        def call(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            dx, y = np.empty_like(x), np.empty((len(x), len(native.y_names)), native.dtype)
            pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (x, p, dx, y)]
            run(ctypes.c_long(len(x)), *pointers)
            return dx, y

        return native, call

    return load


def states(names: list[str], rng: np.random.Generator) -> np.ndarray:
    shape = (CHUNK, len(names))
    x = rng.standard_normal(shape) * 10.0 ** rng.uniform(-6, 1, shape)
    x[rng.random(shape) < 0.02] = 0.0
    inner = [k for k, n in enumerate(names) if ".e" in n or ".a" in n]
    x[:, inner] *= 1e-3
    return x


def sat(level: np.ndarray, x: list[np.ndarray]) -> list[np.ndarray]:
    n = np.sqrt(sum(c * c for c in x))
    inside = n <= level
    return [np.where(inside, c, level * (c / np.where(n > 0, n, 1))) for c in x]


def slip_residual(theta, level, a, da, beta) -> np.ndarray:
    y = [ai + beta * di for ai, di in zip(a, da, strict=True)]
    pulled = [yi + beta * (ti - di) for yi, ti, di in zip(y, theta, da, strict=True)]
    off = [yi - si for yi, si in zip(y, sat(level, pulled), strict=True)]

    def size(parts):
        return np.sqrt(sum(c * c for c in parts))

    return size(off) / (size(a) + beta * size(theta) + beta * size(da) + level)


def contact_residual(psi, e, de, alpha, beta) -> np.ndarray:
    y = e + beta * de
    off = np.abs(np.minimum(y, psi + e + alpha * de))
    return off / (np.abs(psi) + np.abs(e) + (alpha + beta) * np.abs(de) + np.finfo(float).tiny)


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("name", GAPS)
def test_the_inclusions_hold_to_two_eps_of_scale_on_the_compiled_c(name, real, batch):
    native, call = batch(name, real)
    eps = np.finfo(native.dtype).eps
    p0 = native.p0.astype(float)
    p = dict(zip(element_names(native.ode.parameters), p0, strict=True))
    rng = np.random.default_rng(1)
    worst = 0.0
    for _ in range(POINTS // CHUNK):
        rows = states(native.x_names, rng).astype(native.dtype)
        dx, y = (found.astype(float) for found in call(rows))
        assert np.isfinite(dx).all()
        x = dict(zip(native.x_names, rows.T.astype(float), strict=True))
        d = dict(zip(native.x_names, dx.T, strict=True))
        out = dict(zip(native.y_names, y.T, strict=True))
        for term, gap in GAPS[name].items():
            assert (out[term] >= 0).all()
            found = contact_residual(
                gap(x, p), x[f"{term}.e"], d[f"{term}.e"], p[f"{term}.alpha"], p[f"{term}.beta"]
            )
            worst = max(worst, found.max())
        for term, slip in SLIPS[name].items():
            theta, chi = slip(x, p, out)
            suffixes = [""] if len(theta) == 1 else [".x", ".y"]
            a = [x[f"{term}.a{s}"] for s in suffixes]
            da = [d[f"{term}.a{s}"] for s in suffixes]
            level = chi / p[f"{term}.K"]
            with np.errstate(invalid="ignore"):  # 0/0 of the scale at rest without a load
                found = slip_residual(theta, level, a, da, p[f"{term}.beta"])
            worst = max(worst, np.nanmax(found))
            force = np.sqrt(sum(out[f"{term}{s}"] ** 2 for s in suffixes))
            assert (force <= chi * (1 + 4 * eps)).all()
    assert worst <= 2 * eps


def test_a_model_without_constants_still_compiles_and_its_p0_says_so(compile_c):
    native = compile_c("model m\nstate v = 1\nforce F = 2*sgn(v)\nder(v) = -F\n")
    assert np.isnan(native.p0).all()
    assert (
        nsode.loads("model m\nstate v = 1\nder(v) = -sgn(v)\n").ode.parameters[0].name == "sgn1.K"
    )
