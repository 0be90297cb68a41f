"""Fuzz the compiler: ``python tests/property/fuzz.py --runs 1000000 [--seed S] [--jobs N]``.

Each input is a typed random model, a shipped model or a refused one, whole or damaged by tokens or
bytes. It is compiled to C. Nothing but a ModelError may come out, no warning of Python's, and none
may take a second.
``--only I`` runs input I of a seed alone and prints it.
"""

from __future__ import annotations

import argparse
import sys
import time
import traceback
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import cache, partial
from pathlib import Path
from random import Random

TESTS = Path(__file__).parents[1]
sys.path.insert(0, str(TESTS))

import nsode  # noqa: E402
from nsode.diagnostics import ModelError  # noqa: E402
from support.generate import damage_bytes, damage_tokens, model  # noqa: E402

LONGEST = 1.0  # seconds of CPU
_WARM_UP = b"model m\nparameter M = 1 {kg}\nstate p = M\nder(p) = M\n"  # imports the unit library
_CHUNK = 500


@cache
def corpus() -> list[bytes]:
    """Return the models of the house, short ones only."""
    files = [*(TESTS.parent / "models").glob("*.di"), *(TESTS / "refused").glob("*.di")]
    contents = [path.read_bytes() for path in sorted(files)]
    return [content for content in contents if len(content) < 5000]


def subject(seed: int, number: int) -> bytes:
    """Return input ``number`` of a seed."""
    random = Random(f"{seed}:{number}")
    content = model(random).encode() if random.random() < 0.7 else random.choice(corpus())
    how = random.random()
    if how < 0.5:
        return damage_tokens(random, content.decode("utf-8", "replace")).encode()
    return damage_bytes(random, content) if how < 0.8 else content


def compile_one(content: bytes) -> str:
    """Compile one input; return what became of it."""
    try:
        compiled = nsode.loads(content, "fuzz.di")
    except ModelError as error:
        str(error)
        return error.diagnostics[0].code
    compiled.emit("c")
    return "accepted"


def run(seed: int, numbers: range) -> tuple[Counter[str], list[str], float]:
    """Return the outcomes, the failures, and the longest time."""
    compile_one(_WARM_UP)
    warnings.simplefilter("error")
    outcomes: Counter[str] = Counter()
    failures = []
    longest = 0.0
    for number in numbers:
        start = time.process_time()
        try:
            outcomes[compile_one(subject(seed, number))] += 1
        except Exception:
            failures.append(f"--seed {seed} --only {number}\n{traceback.format_exc(limit=-4)}")
        elapsed = time.process_time() - start
        longest = max(longest, elapsed)
        if elapsed > LONGEST:
            failures.append(f"--seed {seed} --only {number}: {elapsed:.1f} s")
    return outcomes, failures, longest


def main() -> int:
    """Run the inputs that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", type=int)
    options = parser.parse_args()
    if options.only is not None:
        content = subject(options.seed, options.only)
        sys.stdout.write(content.decode("utf-8", "backslashreplace") + "\n")
        sys.stdout.write(compile_one(content) + "\n")
        return 0
    chunks = [
        range(first, min(first + _CHUNK, options.runs)) for first in range(0, options.runs, _CHUNK)
    ]
    outcomes: Counter[str] = Counter()
    failed, longest = 0, 0.0
    with ProcessPoolExecutor(options.jobs) as pool:
        for found, failures, slowest in pool.map(partial(run, options.seed), chunks):
            outcomes += found
            failed += len(failures)
            longest = max(longest, slowest)
            for failure in failures:
                sys.stdout.write(failure + "\n")
                sys.stdout.flush()
    summary = ", ".join(f"{code} {count}" for code, count in sorted(outcomes.items()))
    sys.stdout.write(f"{options.runs} inputs, {failed} failures, longest {longest:.2f} s\n")
    sys.stdout.write(f"{summary}\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
