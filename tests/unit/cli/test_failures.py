from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from nsode import compiler
from nsode.cli import run
from support.command_line import NSODE, SOUND


def test_an_unexpected_exception_is_one_line_and_no_traceback(monkeypatch, sound, capsys):
    monkeypatch.setattr(compiler, "compile_source", lambda *_: 1 / 0)
    assert run(["check", str(sound)]) == 2
    told = capsys.readouterr().err
    assert told.startswith("internal error: ZeroDivisionError")
    assert told.count("\n") == 1


def test_the_traceback_of_an_internal_error_is_there_for_those_who_ask(monkeypatch, sound, capsys):
    monkeypatch.setattr(compiler, "compile_source", lambda *_: 1 / 0)
    monkeypatch.setenv("NSODE_DEBUG", "1")
    assert run(["check", str(sound)]) == 2
    assert "Traceback" in capsys.readouterr().err


def test_an_interrupt_is_quiet(monkeypatch, sound, capsys):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(compiler, "compile_source", interrupt)
    assert run(["check", str(sound)]) == 130
    assert capsys.readouterr().err == ""


def test_a_reader_that_goes_away_is_no_error():
    read, write = os.pipe()
    os.close(read)
    told = subprocess.run([*NSODE, "code"], stdout=write, stderr=subprocess.PIPE, text=True)
    os.close(write)
    assert (told.returncode, told.stderr) == (141, "")


def test_a_terminal_without_the_characters_gets_their_numbers(tmp_path):
    path = tmp_path / "ŝ.di"
    path.write_text(SOUND)
    told = subprocess.run(
        [*NSODE, "check", path],
        capture_output=True,
        env=os.environ | {"PYTHONIOENCODING": "latin-1"},
    )
    assert told.returncode == 0
    assert b"\\u015d" in told.stdout


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("arguments", [["code"], ["--help"], ["check", "-"]])
def test_a_full_disk_behind_standard_output_is_told(arguments):
    with Path("/dev/full").open("w") as full:
        told = subprocess.run(
            [*NSODE, *arguments], input=SOUND, stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert told.returncode == 2
    assert told.stderr == "error[NS602]: cannot write standard output: no space left on device\n"


@pytest.mark.skipif(os.name == "nt", reason="needs a shell that closes streams")
@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&- <&-"])
def test_streams_that_a_shell_closed_are_not_missed(closed, sound):
    program = f'exec "$@" {closed}'
    told = subprocess.run(
        ["sh", "-c", program, "sh", *NSODE, "check", str(sound)], capture_output=True, text=True
    )
    assert (told.returncode, told.stderr) == (0, "")


def test_standard_input_that_cannot_be_read_is_told(tmp_path):
    with (tmp_path / "for writing").open("w") as file:
        told = subprocess.run([*NSODE, "check", "-"], stdin=file, capture_output=True, text=True)
    assert told.returncode == 2
    assert told.stderr.startswith("error[NS601]: cannot read standard input: ")
