from __future__ import annotations

import os
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from nsode import cli
from nsode.cli import COMMANDS, run
from support.command_line import NSODE


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


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("nsode ch", "plain,check"),
        ("nsode compile block.di -t n", "plain,numpy"),
        ("nsode check --wa", "plain,--watch"),
        ("nsode simulate blo", "file,blo"),
        ("nsode check blo", "file,blo"),
    ],
)
def test_a_shell_completes_commands_options_and_files(words, offered):
    count = str(len(words.split()) - 1)
    environment = {"_NSODE_COMPLETE": "bash_complete", "COMP_WORDS": words, "COMP_CWORD": count}
    told = subprocess.run(
        NSODE,
        capture_output=True, text=True, env=os.environ | environment,
    )  # fmt: skip
    assert told.stdout.splitlines() == [offered]
