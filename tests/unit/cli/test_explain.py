from __future__ import annotations

import pytest

from nsode.cli import run


def test_a_dash_is_standard_output(sound, capsys):
    assert run(["explain", str(sound)]) == 0
    told = capsys.readouterr().out
    assert run(["explain", str(sound), "-o", "-"]) == 0
    assert capsys.readouterr().out == told


@pytest.mark.parametrize("place", ["", ".", "..", "block.di/x.txt"])
def test_what_is_no_file_cannot_be_written(sound, tmp_path, monkeypatch, place, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(["explain", str(sound), "-o", place]) == 2
    assert capsys.readouterr().err.startswith("error[NS602]: cannot write")
