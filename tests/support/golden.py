"""Recorded texts: ``UPDATE_GOLDEN=1 pytest`` records them anew, for a person to review."""

from __future__ import annotations

import os
from pathlib import Path

GOLDEN = Path(__file__).parent.parent / "golden"


def assert_recorded(name: str, text: str) -> None:
    """Compare a text with what is recorded under a name."""
    path = GOLDEN / name
    if os.environ.get("UPDATE_GOLDEN"):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")
