"""A short run of the fuzzer (``tests/property/fuzz.py`` has the long one)."""

from __future__ import annotations

import sys
from pathlib import Path
from random import Random

from nsode.source import Source
from nsode.syntax import parse
from support.generate import model

sys.path.insert(0, str(Path(__file__).parent))

import fuzz


def test_what_the_generator_writes_can_be_parsed() -> None:
    for seed in range(100):
        parse(Source("m.di", model(Random(seed))))


def test_most_of_what_the_generator_writes_reaches_the_generated_code() -> None:
    outcomes = [fuzz.compile_one(model(Random(seed)).encode()) for seed in range(100)]
    assert outcomes.count("accepted") >= 40


def test_nothing_but_a_refusal_comes_out_of_any_text() -> None:
    _, failures, _ = fuzz.run(seed=1, numbers=range(500))
    assert not failures, "\n".join(failures)
