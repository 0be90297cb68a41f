from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from nsode.cli import run
from support import MODELS, listing


def test_compile_writes_the_files_and_tells_what_they_hold(sound, tmp_path, capsys):
    folder = tmp_path / "build"
    assert run(["compile", str(sound), "-t", "c", "-o", str(folder)]) == 0
    assert listing(folder) == ["block.c", "block.h", "block.json"]
    told = capsys.readouterr().out
    assert told.startswith("block: 1 state + 1 auxiliary, 1 set-valued term (sgn1: sgn), ")
    assert all(str(folder / name) in told for name in listing(folder))


def test_compile_of_a_refused_model_writes_nothing(refused, tmp_path):
    assert run(["compile", str(refused), "-o", str(tmp_path / "build")]) == 1
    assert not (tmp_path / "build").exists()


def test_a_file_in_the_place_of_the_folder_is_told(sound, tmp_path, capsys):
    (tmp_path / "build").write_text("")
    assert run(["compile", str(sound), "-o", str(tmp_path / "build")]) == 2
    assert capsys.readouterr().err.startswith("error[NS602]: cannot write")


@pytest.mark.parametrize("prefix", ["", "1a", "a-b", "a b", "../a", "/a", "é", "a" * 65, "a\n"])
def test_a_prefix_is_an_identifier_or_refused(sound, tmp_path, prefix, capsys):
    assert run(["compile", str(sound), "-o", str(tmp_path / "out"), f"--prefix={prefix}"]) == 2
    assert capsys.readouterr().err.startswith("error[NS603]")
    assert not (tmp_path / "out").exists()


def test_a_prefix_names_files_and_functions(sound, tmp_path):
    assert run(["compile", str(sound), "-o", str(tmp_path / "out"), "--prefix", "abc"]) == 0
    assert listing(tmp_path / "out") == ["abc.c", "abc.h", "abc.json"]
    assert "abc_step_rk4" in (tmp_path / "out" / "abc.h").read_text()


def test_only_what_was_asked_for_is_compiled(tmp_path, capsys):
    sphere = next(model for model in MODELS if model.stem == "rolling_sphere")
    out = tmp_path / "out"
    assert run(["compile", str(sphere), "-o", str(out), "--outputs", "depth"]) == 0
    told = capsys.readouterr().out.splitlines()
    assert told[0].startswith(
        "rolling_sphere: 2 states + 1 auxiliary, 1 set-valued term (N: dio), "
    )
    assert told[1].startswith("  before: 13 states + 3 auxiliary, 2 set-valued terms (N: dio, F: ")
    assert told[2].startswith("  states left out: p.x, p.y, v.x, v.y, w.x")
    assert told[3] == "  outputs left out: N, F.x, F.y"
    assert "rolling_sphere_NX = 3" in (out / "rolling_sphere.h").read_text()


def test_what_is_baked_in_is_said_with_its_unit(tmp_path, capsys):
    sphere = next(model for model in MODELS if model.stem == "rolling_sphere")
    baked = ["--bake", "M=2", "--bake", "mu=0.25", "--bake", "N.K=1e5"]
    assert run(["compile", str(sphere), "-o", str(tmp_path / "out"), *baked]) == 0
    told = capsys.readouterr().out.splitlines()
    before, after = (int(re.search(r"(\d+) operations", line)[1]) for line in (told[1], told[0]))
    assert after < before
    assert told[2] == "  baked in: M = 2.0 kg, mu = 0.25, N.K = 100000.0 N/m"


@pytest.mark.parametrize("option", [["--outputs", "M1"], ["--bake", "M1=2"]])
def test_what_there_is_not_can_neither_be_kept_nor_baked(sound, tmp_path, option, capsys):
    assert run(["compile", str(sound), "-o", str(tmp_path / "out"), *option]) == 1
    assert "error[NS101]" in (told := capsys.readouterr().err)
    assert "`M1`" in told
    assert not (tmp_path / "out").exists()


def test_a_folder_may_begin_with_a_dash(sound, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["compile", str(sound), "-o", "-odd"]) == 0
    assert (tmp_path / "-odd" / "block.c").exists()


@pytest.mark.parametrize("name", ["a b", "it's", 'quo"te', "$HOME", "-odd"])
def test_the_next_command_can_be_typed(sound, tmp_path, monkeypatch, name, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(["compile", str(sound), "-o", name]) == 0
    hint = capsys.readouterr().out.splitlines()[-1].removeprefix("next: ")
    _, _, option, include, _, source, _ = shlex.split(hint)
    assert option == "-I"
    assert not include.startswith("-")
    assert Path(include).samefile(name)
    assert Path(source).samefile(Path(name, "block.c"))


@pytest.mark.parametrize("folder", ["", "-"])
def test_what_is_no_folder_is_wrong_usage(sound, tmp_path, monkeypatch, folder):
    monkeypatch.chdir(tmp_path)
    assert run(["compile", str(sound), "-o", folder]) == 2
    assert listing(tmp_path) == ["block.di"]
