from __future__ import annotations

import shlex

import pytest

from nsode.cli import run
from support import listing


def test_new_writes_a_model_that_passes_without_a_warning(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(["new", "ball"]) == 0
    assert run(["check", "--strict", "ball.di"]) == 0
    assert "wrote ball.di" in capsys.readouterr().out


def test_new_leaves_a_file_that_exists_alone(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ball.di").write_text("mine")
    assert run(["new", "ball"]) == 2
    assert (tmp_path / "ball.di").read_text() == "mine"
    assert "exists" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["", "../ball", "a b", "1a", "état", "model", "a.b", "a\n"])
def test_new_refuses_what_cannot_name_a_model(tmp_path, monkeypatch, name, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(["new", name]) == 2
    assert listing(tmp_path) == []
    assert capsys.readouterr().err.startswith("error[NS603]")


def test_new_makes_the_folder_and_shows_a_command_that_can_be_typed(tmp_path, capsys):
    folder = tmp_path / "it's here"
    assert run(["new", "ball", "-o", str(folder)]) == 0
    [hint] = [line for line in capsys.readouterr().out.splitlines() if line.startswith("next: ")]
    assert shlex.split(hint)[1:4] == ["nsode", "compile", str(folder / "ball.di")]
