from __future__ import annotations

import pytest

from nsode.cli import run
from nsode.diagnostics import CODES


def test_code_lists_every_code(capsys):
    assert run(["code"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == list(CODES)


@pytest.mark.parametrize("code", CODES)
def test_every_code_can_be_asked_for(code, capsys):
    assert run(["code", code.lower()]) == 0
    assert code in capsys.readouterr().out


@pytest.mark.parametrize("short", ["NS001", "ns1", "1", "001"])
def test_a_code_may_be_shortened(short, capsys):
    assert run(["code", short]) == 0
    assert "NS001" in capsys.readouterr().out


def test_an_unknown_code_is_wrong_usage(capsys):
    assert run(["code", "NS999"]) == 2
