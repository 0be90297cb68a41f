from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path

import pytest

import nsode
from nsode.cli import COMMANDS, run
from nsode.diagnostics import ModelError
from support import MODELS
from support.native import have, run_tool

TEXT = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
SPHERE = next(model for model in MODELS if model.stem == "rolling_sphere")


BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", TEXT, re.DOTALL | re.MULTILINE)


def blocks(language: str) -> list[str]:
    return [text for tag, text in BLOCKS if tag == language]


@pytest.fixture
def clone(tmp_path, monkeypatch):
    """A folder that looks like a clone to the commands of the README."""
    (tmp_path / "models").mkdir()
    for model in MODELS:
        (tmp_path / "models" / model.name).write_bytes(model.read_bytes())
    monkeypatch.chdir(tmp_path)
    return tmp_path


def compile_as_told() -> None:
    [command] = re.findall(r"^\.venv/bin/nsode (compile .*)", TEXT, re.MULTILINE)
    assert run(shlex.split(command)) == 0


def test_the_output_shown_is_the_output(clone, capsys):
    compile_as_told()
    shown = next(block for block in blocks("") if block.startswith("rolling_sphere:"))
    told = capsys.readouterr().out
    assert re.sub(r" +[\d.]+ k?B\n", "\n", shown) == re.sub(r" +[\d.]+ k?B\n", "\n", told)


@pytest.mark.skipif(not have("gcc"), reason="gcc is not installed")
def test_the_ten_lines_of_c_roll_the_sphere_to_five_sevenths(clone):
    compile_as_told()
    [program] = blocks("c")
    assert len([line for line in program.splitlines() if line]) == 10
    Path("main.c").write_text(program)
    [build] = re.findall(r"^(gcc .*) && \./sphere$", TEXT, re.MULTILINE)
    run_tool(shlex.split(build))
    told = run_tool(["./sphere"]).stdout
    [speed] = re.findall(r"v\.x = (\S+) m/s", told)
    assert abs(float(speed) - 5.5 * 5 / 7) < 1e-6
    assert f"`{told.strip()}`" in TEXT


def test_the_python_shown_runs(clone):
    for program in blocks("python"):
        run_tool([sys.executable, "-c", program], cwd=clone)


def test_the_model_shown_is_sound():
    model = next(block for block in blocks("") if block.startswith("model "))
    assert nsode.loads(model).diagnostics == ()


def test_the_message_shown_is_the_message(capsys):
    shown = next(block for block in blocks("") if block.startswith("error["))
    model = "model slider\nparameter M = 1\ninput u\nstate v = 1\n\nM*der(v) = -u*sgn(v)\n"
    with pytest.raises(ModelError) as refusal:
        nsode.loads(model, "slider.di")
    assert shown == f"{refusal.value}\n"


def test_every_command_is_in_the_table():
    for command in COMMANDS:
        assert f"| `nsode {command} " in TEXT or f"| `nsode {command}`" in TEXT
