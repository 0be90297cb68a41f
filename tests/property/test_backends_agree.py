"""C, NumPy and CasADi give one right-hand side, to 4 eps of the running term scale.

``NSODE_SEEDS=10000`` compares that many random models of each kind instead of a few.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

import nsode
from nsode.backends import emit
from nsode.diagnostics import ModelError
from nsode.ode import AugmentedODE, element_names
from support.generate import model
from support.models import PATHS
from support.modules import load_module
from support.native import Native, build_all, have
from support.odes import Maker
from support.running import Tracer
from support.twins import Twins

EPS = np.finfo(float).eps
SEEDS = int(os.environ.get("NSODE_SEEDS", "15"))
TEXTS = int(os.environ.get("NSODE_SEEDS", "300"))  # of which every fourth is of twins
EXACT = int(os.environ.get("NSODE_SEEDS", "80"))  # of texts without libm, three times compiled
BATCH = 40  # of models in one library
COMPILERS = ("gcc", "clang")  # by turns
CONTRACT = "-ffp-contract=off"
PLAIN = ("-O0", CONTRACT)

Rates = Callable[[float, NDArray, NDArray, NDArray], NDArray]


def through_casadi(ode: AugmentedODE) -> Rates:
    pytest.importorskip("casadi")
    from nsode.backends.casadi import functions

    rhs = functions(ode).rhs
    return lambda t, x, u, p: np.array(rhs(t, x, u, p)).reshape(-1)


@pytest.fixture(scope="module")
def compiled(compile_c: Callable) -> Callable[[Path], Native]:
    """``compiled(path)``: the C of a shipped model, compiled once for this module."""
    return cache(compile_c)


def points(ode: AugmentedODE, count: int) -> list[tuple[float, NDArray, NDArray, NDArray]]:
    """Return where to compare: near the start and far from it, pressed, free and at rest."""
    rng = np.random.default_rng(7)
    module = load_module(ode)
    start, u = module.init(), np.nan_to_num(module.u0)
    found = [(0.0, start, u, module.p0), (0.5, 0 * start, u, module.p0)]
    for k in range(count):
        x = start + rng.normal(size=start.size) * 10.0 ** rng.integers(-6, 1)
        p = module.p0 * rng.uniform(0.9, 1.1, size=module.p0.size)
        found.append((0.1 * k, x, u + rng.normal(size=u.size), p))
    return found


def assert_agrees(ode: AugmentedODE, rates: Rates, count: int) -> None:
    for t, x, u, p in points(ode, count):
        expected, scale = Tracer(ode, t, x, u, p).rhs()
        assert np.all(np.isfinite(expected)), element_names(ode.states)
        error = np.abs(rates(t, x, u, p) - expected)
        worst = int(np.argmax(error - 4 * EPS * scale))
        assert error[worst] <= 4 * EPS * scale[worst], (element_names(ode.states)[worst], t, x, p)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_shipped_models_have_one_right_hand_side(path, compiled):
    ode = nsode.load(path).ode
    for rates in (compiled(path).rhs, load_module(ode).rhs, through_casadi(ode)):
        assert_agrees(ode, rates, 12)


@pytest.mark.parametrize("seed", range(SEEDS))
def test_random_models_have_one_right_hand_side(seed, compile_c):
    ode = Maker(seed, depth=3).make()
    # The quickest compiler will do: the shipped models are there for the best one.
    native = compile_c(ode, cc="tcc", flags=()) if have("tcc") else compile_c(ode)
    for rates in (native.rhs, load_module(ode).rhs, through_casadi(ode)):
        assert_agrees(ode, rates, 3)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_outputs_starts_and_steps_of_c_and_numpy_agree(path, compiled):
    ode = nsode.load(path).ode
    native, module = compiled(path), load_module(ode)
    np.testing.assert_array_equal(module.init(), native.init())
    np.testing.assert_array_equal(module.p0, native.p0)
    jacobian = slopes(ode)
    h = 1e-6
    for t, x, u, p in points(ode, 5):
        traced = Tracer(ode, t, x, u, p)
        expected, scale = traced.out()
        for outputs in (native.out(t, x, u, p), module.out(t, x, u, p)):
            assert np.all(np.abs(outputs - expected) <= 4 * EPS * scale)
        for method in ("rk4", "heun", "euler"):
            stepped = native.step(t, h, x, u, p, method=method)
            found = getattr(module, f"step_{method}")(t, h, x, u, p)
            after = Tracer(ode, t + h, stepped, u, p).rhs()[1]
            moved = h * np.maximum(traced.rhs()[1], after)
            # A stage reads the states of the one before, rounding errors included.
            carried = h * np.abs(jacobian(t, x, u, p)) @ moved
            assert np.all(np.abs(found - stepped) <= 4 * EPS * (np.abs(x) + moved + carried))


def slopes(ode: AugmentedODE) -> Rates:
    pytest.importorskip("casadi")
    from nsode.backends.casadi import functions

    model = functions(ode)
    jacobian = model.rhs.jacobian()
    n = len(model.x_names)
    return lambda t, x, u, p: np.array(jacobian(t, x, u, p, 0)[1]).reshape(n, n)


def text(seed: int) -> str:
    """Return a random model: tame and rich (see twins), or wild, poles and all (see generate)."""
    return Twins(seed).texts[0] if seed % 4 == 0 else model(Random(seed))


def accepted(seeds: range) -> list[tuple[int, AugmentedODE]]:
    """Return the ODEs of the random texts that are not refused, with their seeds."""
    found = []
    for seed in seeds:
        try:
            found.append((seed, nsode.loads(text(seed)).ode))
        except ModelError:
            assert seed % 4, "the tame models are all valid"
    return found


def assert_agrees_where_finite(ode: AugmentedODE, all_rates: Sequence[Rates], count: int) -> int:
    """Compare rates, leaving out poles and what grew beyond reason; return how many are left."""
    compared = 0
    for t, x, u, p in points(ode, count):
        expected, scale = Tracer(ode, t, x, u, p).rhs()
        fine = np.isfinite(expected) & (scale < 1e200)
        for rates in all_rates:
            error = np.abs(rates(t, x, u, p)[fine] - expected[fine])
            agrees = error <= 4 * EPS * scale[fine]
            assert np.all(agrees), (rates, np.array(element_names(ode.states))[fine][~agrees], t, x)
        compared += int(np.sum(fine))
    return compared


@pytest.mark.parametrize("first", range(0, TEXTS, BATCH))
def test_random_texts_have_one_right_hand_side(first, tmp_path):
    cc = COMPILERS[first // BATCH % len(COMPILERS)]
    if not have(cc):
        pytest.skip(f"{cc} is not installed")
    models = accepted(range(first, min(first + BATCH, TEXTS)))
    assert len(models) > BATCH // 2 or TEXTS % BATCH
    natives = build_all([ode for _, ode in models], tmp_path, cc=cc, flags=PLAIN)
    compared = states = 0
    for (seed, ode), native in zip(models, natives, strict=True):
        try:
            all_rates = (native.rhs, load_module(ode).rhs, through_casadi(ode))
            compared += assert_agrees_where_finite(ode, all_rates, 3)
        except AssertionError as error:
            error.add_note(f"seed {seed}:\n{text(seed)}")
            raise
        states += len(native.x_names)
    assert compared > 3 * states  # of 5 points each: most are no poles


@pytest.mark.parametrize("first", range(0, EXACT, BATCH))
def test_random_texts_have_one_jacobian(first):
    """CasADi derives the operations; nsode derives the expressions and shares what is common."""
    for seed, ode in accepted(range(first, min(first + BATCH, EXACT))):
        module, n = load_module(ode), len(element_names(ode.states))
        x = module.init() + 0.3 * np.random.default_rng(seed).normal(size=n)
        u = np.nan_to_num(module.u0)
        expected = slopes(ode)(0.3, x, u, module.p0)
        found = np.zeros((n, n))
        columns = np.repeat(np.arange(n), np.diff(module.jac_columns))
        found[module.jac_rows, columns] = module.jac(0.3, x, u, module.p0)
        there_are = np.isfinite(module.rhs(0.3, x, u, module.p0))[:, None]  # rates to derive
        fine = there_are & np.isfinite(expected) & (np.abs(expected) < 1e100)
        largest = np.abs(expected[fine]).max(initial=1.0)
        assert np.all(np.abs(found[fine] - expected[fine]) <= 1e-9 * largest), ode.source.text


ROUNDED = re.compile(r"\b(a?sin|a?cos|a?tan|atan2|[sct]\w+h|exp|log|pow)f?\(")


def without_libm(seeds: range) -> list[AugmentedODE]:
    """Return random models whose C calls nothing that a libm or a compiler may round."""
    wild = [ode for seed, ode in accepted(seeds) if seed % 4]
    plain = [ode for ode in wild if not any(map(ROUNDED.search, emit("c", ode).values()))]
    return plain + [nsode.loads(Twins(seed, libm=False).texts[0]).ode for seed in seeds[::4]]


@pytest.mark.parametrize("first", range(0, EXACT, 2 * BATCH))
def test_compilers_agree_bit_for_bit_on_random_models(first, tmp_path):
    compilers = {"gcc": ("-O2", CONTRACT), "clang": ("-O1", CONTRACT), "tcc": ()}
    here = {cc: flags for cc, flags in compilers.items() if have(cc)}
    if len(here) < 2:
        pytest.skip("there is one compiler at most")
    models = without_libm(range(first, min(first + 2 * BATCH, EXACT)))
    assert len(models) > BATCH // 2 or EXACT % (2 * BATCH)
    built = [build_all(models, tmp_path / cc, cc=cc, flags=flags) for cc, flags in here.items()]
    for ode, *natives in zip(models, *built, strict=True):
        for t, x, u, p in points(ode, 5):
            rates, outputs = ({bits(n, f, t, x, u, p) for n in natives} for f in ("rhs", "out"))
            assert len(rates) == len(outputs) == 1, ode.source.text


def bits(native: Native, function: str, *point: float | NDArray) -> bytes:
    values = getattr(native, function)(*point)
    return np.where(np.isnan(values), np.nan, values).tobytes()  # a NaN may have either sign


def test_a_let_that_is_a_number_divides_as_ieee_says():
    ode = nsode.loads("model m\nstate x = 1\nlet y = 0\nder(x) = 1/y\n").ode
    assert load_module(ode).rhs(0.0, np.ones(1))[0] == np.inf


def test_a_choice_of_a_number_divides_as_ieee_says():
    text = "model m\nstate x = 1\nder(x) = (if x > 2 then x else 0)^-1\n"
    assert load_module(nsode.loads(text).ode).rhs(0.0, np.ones(1))[0] == np.inf


def test_the_time_divides_as_ieee_says():
    ode = nsode.loads("model m\nstate x = 1\nder(x) = 1/t + t^-1\n").ode
    assert load_module(ode).rhs(0.0, np.ones(1))[0] == np.inf


def test_the_comparison_can_fail():
    ode = Maker(0).make()
    rates = load_module(ode).rhs
    with pytest.raises(AssertionError):
        assert_agrees(ode, lambda t, x, u, p: rates(t, x, u, p) * (1 + 1e-12), 3)
