"""Each page of ``nsode code`` does what it says: one model gets that code, the other passes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import nsode
from nsode.diagnostics import CODES, ModelError

PAGES = sorted((Path(nsode.__file__).parent / "catalog").glob("NS*.md"))
# What the text of a model does not show: sizes, and errors of a run or of the machine.
WITHOUT_EXAMPLE = {"NS012", "NS307", "NS408", "NS410", *(code for code in CODES if code[2] in "56")}
SHOWN = [page for page in PAGES if page.stem not in WITHOUT_EXAMPLE]
_BLOCK = re.compile(r"^```di\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def codes(text: str) -> tuple[set[str], set[str]]:
    """Return the codes of the errors, and of the warnings and notes, about a model."""
    try:
        found = nsode.loads(text).diagnostics
    except ModelError as error:
        found = error.diagnostics
    errors = {d.code for d in found if d.severity == "error"}
    return errors, {d.code for d in found} - errors


def blocks(page: Path) -> list[str]:
    return _BLOCK.findall(page.read_text(encoding="utf-8"))


def test_every_code_has_its_page() -> None:
    assert {page.stem for page in PAGES} == set(CODES)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_has_a_title_an_example_and_its_repair(page: Path) -> None:
    assert page.stem in CODES
    assert page.read_text(encoding="utf-8").startswith(f"# {page.stem}: {CODES[page.stem]}\n")
    assert page.stem in WITHOUT_EXAMPLE or len(blocks(page)) == 2


@pytest.mark.parametrize("page", SHOWN, ids=lambda page: page.stem)
def test_the_example_gets_the_code_and_the_repair_does_not(page: Path) -> None:
    example, repaired = blocks(page)
    errors, others = codes(example)
    assert page.stem in errors | others
    assert not errors - {page.stem}
    errors, others = codes(repaired)
    assert not errors
    assert page.stem not in others


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_lines_of_a_page_fit_a_terminal(page: Path) -> None:
    text = _BLOCK.sub("", page.read_text(encoding="utf-8"))
    assert max(map(len, text.splitlines())) <= 100
