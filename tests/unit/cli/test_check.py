from __future__ import annotations

import json
import os
import signal
import subprocess

import pytest

from nsode.cli import run
from support import MODELS
from support.command_line import NSODE, REFUSED, SOUND


def test_a_sound_model_passes_with_one_line(sound, capsys):
    assert run(["check", str(sound)]) == 0
    told = capsys.readouterr()
    assert told.out == f"{sound}: ok, 1 state + 1 auxiliary, 1 set-valued term (sgn1: sgn)\n"


@pytest.mark.parametrize("model", MODELS, ids=lambda p: p.stem)
def test_every_shipped_model_passes(model, capsys):
    assert run(["check", str(model), "--strict"]) == 0, capsys.readouterr().err


def test_a_refused_model_is_shown_with_code_place_and_caret(refused, capsys):
    assert run(["check", str(refused)]) == 1
    told = capsys.readouterr()
    assert told.out == ""
    lines = told.err.splitlines()
    assert lines[0].startswith("error[NS101]: ")
    assert lines[1].endswith(f"--> {refused}:4:11")
    assert lines[2].endswith("| der(v) = -w*sgn(v)")
    assert lines[3].split("|")[1].lstrip().startswith("^")


def test_one_refused_model_does_not_hide_the_others(sound, refused, capsys):
    assert run(["check", str(refused), str(sound)]) == 1
    assert f"{sound}: ok" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["missing.di", ".", "\0.di", "x" * 5000])
def test_what_cannot_be_read_ends_with_2(tmp_path, monkeypatch, name, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(["check", name]) == 2
    assert capsys.readouterr().err.startswith("error[NS601]: cannot read")


@pytest.mark.parametrize("text", [SOUND, REFUSED])
def test_a_file_name_does_not_command_the_terminal(tmp_path, monkeypatch, text, capsys):
    monkeypatch.chdir(tmp_path)
    name = "\x1b]0;owned\x07\n.di"
    (tmp_path / name).write_text(text)
    run(["check", name, "\x1b[2J.di"])
    told = "".join(capsys.readouterr())
    assert "]0;owned" in told
    assert "[2J.di" in told
    assert all(line.isprintable() for line in told.splitlines())


def test_standard_input_is_a_model_too(stdin, capsys):
    stdin(SOUND.encode())
    assert run(["check", "-"]) == 0
    assert capsys.readouterr().out.startswith("<stdin>: ok")


def test_standard_input_that_is_no_text_is_refused(stdin, capsys):
    stdin(b"model m\nstate \xff\n")
    assert run(["check", "-"]) == 1
    assert "NS002" in capsys.readouterr().err


def test_json_tells_the_same_to_a_program(sound, refused, tmp_path, capsys):
    missing = tmp_path / "missing.di"
    assert run(["check", "--format", "json", str(sound), str(refused), str(missing)]) == 2
    told = capsys.readouterr()
    assert told.err == ""
    report = json.loads(told.out)
    assert report["schema_version"] == 1
    assert [file["ok"] for file in report["files"]] == [True, False, False]
    assert [file["file"] for file in report["files"]] == list(map(str, (sound, refused, missing)))
    codes = [[d["code"] for d in file["diagnostics"]] for file in report["files"]]
    assert (codes[1][0], codes[2]) == ("NS101", ["NS601"])
    start = report["files"][1]["diagnostics"][0]["labels"][0]["start"]
    assert (start["line"], start["column"]) == (4, 11)


def test_a_warning_passes_unless_strict(tmp_path, capsys):
    path = tmp_path / "block.di"
    path.write_text(SOUND.replace("state", "parameter idle = 1\nstate"))
    assert run(["check", str(path)]) == 0
    assert "warning[NS401]" in capsys.readouterr().err
    assert run(["check", "--strict", str(path)]) == 1


def test_no_color_reaches_a_pipe(refused):
    told = subprocess.run([*NSODE, "check", refused], capture_output=True, text=True)
    assert told.returncode == 1
    assert "\033" not in told.stdout + told.stderr


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="needs a pseudo-terminal")
@pytest.mark.parametrize(("no_color", "painted"), [("", True), ("1", False)])
def test_a_terminal_gets_colors_unless_it_wants_none(refused, no_color, painted):
    ours, theirs = os.openpty()
    environment = os.environ | {"NO_COLOR": no_color, "TERM": "xterm"}
    subprocess.run([*NSODE, "check", refused], stderr=theirs, env=environment)
    os.close(theirs)
    told = os.read(ours, 65536).decode()
    os.close(ours)
    assert "NS101" in told
    assert ("\033[" in told) is painted


def test_watch_checks_again_after_each_change(sound):
    with subprocess.Popen(
        [*NSODE, "check", "--watch", "--format", "json", sound],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert json.loads(process.stdout.readline())["files"][0]["ok"]
        sound.write_text(REFUSED)
        assert not json.loads(process.stdout.readline())["files"][0]["ok"]
        sound.unlink()
        told = json.loads(process.stdout.readline())["files"][0]
        assert [d["code"] for d in told["diagnostics"]] == ["NS601"]
        process.send_signal(signal.SIGINT)
        assert process.wait() == 0
        assert process.stderr.read() == ""


def test_watch_needs_files(capsys):
    assert run(["check", "--watch", "-"]) == 2
