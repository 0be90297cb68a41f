from __future__ import annotations

import io
import sys

import pytest

from support.command_line import REFUSED, SOUND


@pytest.fixture
def sound(tmp_path):
    path = tmp_path / "block.di"
    path.write_text(SOUND)
    return path


@pytest.fixture
def refused(tmp_path):
    path = tmp_path / "refused.di"
    path.write_text(REFUSED)
    return path


@pytest.fixture
def stdin(monkeypatch):
    def give(data: bytes) -> None:
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))

    return give
