"""Each model here is refused with exactly the message beside it.

``python tests/refused/test_refused.py [NAME...]`` records the messages anew; read them aloud.
"""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from nsode.diagnostics import ModelError
from nsode.source import Source
from nsode.syntax import decode, parse

HERE = Path(__file__).parent
REFUSED = sorted(HERE.glob("*.di"))


def load(source: Source) -> None:
    if find_spec("nsode.compiler"):
        from nsode.compiler import loads

        loads(source.text, source.name)
    else:
        parse(source)


def message(path: Path) -> str | None:
    """Return what a person is told about a model, None where it is accepted."""
    try:
        load(decode(path.name, path.read_bytes()))
    except ModelError as error:
        return f"{error}\n"
    return None


@pytest.mark.parametrize("path", REFUSED, ids=lambda path: path.stem)
def test_is_refused_with_the_recorded_message(path: Path) -> None:
    assert message(path) == path.with_suffix(".txt").read_text(encoding="utf-8")


def test_each_message_has_its_model() -> None:
    assert {path.stem for path in HERE.glob("*.txt")} == {path.stem for path in REFUSED}


def record(names: list[str]) -> None:
    """Write the message of the named models, or of all."""
    for path in REFUSED:
        if names and path.stem not in names:
            continue
        text = message(path)
        if text is None:
            sys.exit(f"{path.name} is accepted")
        path.with_suffix(".txt").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    record(sys.argv[1:])
