from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from nsode import cli, compiler
from nsode.cli import COMMANDS, run
from nsode.diagnostics import CODES
from nsode.simulate import compilers
from support import MODELS, listing

SOUND = """\
model block
parameter M = 1
state v = 1
M*der(v) = -0.5*sgn(v)
approximate sgn1: K = 1e5, beta = 4e-3
"""
REFUSED = "model block\nparameter u = 1\nstate v = 1\nder(v) = -w*sgn(v)\n"
NSODE = [sys.executable, "-P", "-m", "nsode"]


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


# the group


def test_help_names_every_command_and_imports_none_of_them():
    program = (
        "import sys; from nsode.cli import run; run(['--help'])\n"
        "print(*sys.modules, file=sys.stderr)"
    )
    told = subprocess.run([sys.executable, "-P", "-c", program], capture_output=True, text=True)
    assert told.returncode == 0
    assert all(f"\n  {name} " in told.stdout for name in COMMANDS)
    modules = told.stderr.split()
    assert not [m for m in modules if m.startswith("nsode.") and m != "nsode.cli"]
    assert not {"lark", "numpy", "casadi", "sympy", "pint"}.intersection(modules)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_explains_itself(name, capsys):
    assert run([name, "--help"]) == 0
    assert capsys.readouterr().out.startswith(f"Usage: nsode {name}")


def test_every_command_that_exists_can_be_typed():
    modules = {path.stem for path in Path(cli.__file__).parent.glob("*.py")}
    found = {name for name in modules if hasattr(import_module(f"nsode.cli.{name}"), "command")}
    assert found == set(COMMANDS)


def test_version_is_told(capsys):
    assert run(["--version"]) == 0
    assert capsys.readouterr().out.startswith("nsode 0.")


@pytest.mark.parametrize(
    "arguments",
    [[], ["chekc"], ["check"], ["check", "--foo"], ["compile", "a.di", "-t", "fortran"]],
)
def test_wrong_usage_ends_with_2(arguments, capsys):
    assert run(arguments) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert "Traceback" not in told.err


def test_a_misspelt_command_draws_a_suggestion(capsys):
    run(["chekc"])
    assert "did you mean `check`?" in capsys.readouterr().err


# failures


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


# check


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


# compile


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
    assert told[1].startswith("  left out: p.x, p.y, v.x, v.y, w.x")
    assert "rolling_sphere_NX = 3" in (out / "rolling_sphere.h").read_text()


def test_an_output_that_there_is_not_is_wrong_usage(sound, tmp_path, capsys):
    assert run(["compile", str(sound), "-o", str(tmp_path / "out"), "--outputs", "zz"]) == 2
    assert "`zz`" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_folder_may_begin_with_a_dash(sound, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["compile", str(sound), "-o", "-odd"]) == 0
    assert (tmp_path / "-odd" / "block.c").exists()


# new, doctor, code


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


def test_doctor_passes_on_a_machine_without_anything(monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(compilers, "find_spec", lambda _: None)
    assert run(["doctor"]) == 0
    told = capsys.readouterr().out
    assert "no C compiler" in told
    assert "apt install gcc" in told
    assert "pip install 'nsode[compiler]'" in told


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
