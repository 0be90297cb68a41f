"""The build cache: ours alone, whole entries only, rebuilt where damaged."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

import nsode
from nsode.diagnostics import ModelError
from nsode.simulate import build, cache
from nsode.simulate.compilers import overlooked

TEXT = "model m\nparameter k = 1\nstate p = 1\nder(p) = -k*p\nsimulate 1 step 0.1\n"
END = 0.9**10  # by Euler


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "nsode"


def run(text=TEXT):
    return nsode.loads(text).simulate(method="euler")["p"][-1]


def entries(home):
    return sorted(home.glob("*.so"))


def code(refusal):
    return refusal.value.diagnostics[0].code


def test_a_model_is_compiled_once(home, monkeypatch):
    assert run() == pytest.approx(END)
    [entry] = entries(home)
    monkeypatch.setattr(build, "_compile", lambda *_: pytest.fail("compiled again"))
    assert run() == pytest.approx(END)
    assert entries(home) == [entry]


def test_only_the_entry_stays_and_only_we_can_read_it(home):
    run()
    assert [path.suffix for path in home.iterdir()] == [".so"]
    assert stat.S_IMODE(home.stat().st_mode) == 0o700
    assert stat.S_IMODE(entries(home)[0].stat().st_mode) == 0o600


@pytest.mark.parametrize("damage", ["truncated", "another library", "empty"])
def test_a_damaged_entry_is_built_again(home, damage):
    run()
    [entry] = entries(home)
    good = entry.read_bytes()
    entry.unlink()  # the old file is still mapped by this process
    bad = {"truncated": good[: len(good) // 2], "another library": good + b"x", "empty": b""}
    entry.write_bytes(bad[damage])
    assert run() == pytest.approx(END)
    assert [path.read_bytes() for path in entries(home)] == [good]


def test_a_link_in_the_place_of_an_entry_is_not_followed(home, tmp_path):
    run()
    [entry] = entries(home)
    outside = tmp_path / "outside.so"
    entry.rename(outside)
    entry.symlink_to(outside)
    assert run() == pytest.approx(END)
    assert not entries(home)[0].is_symlink()
    assert outside.exists()


@pytest.mark.parametrize("mode", [0o770, 0o707, 0o722, 0o777])
def test_a_folder_that_others_can_write_is_refused(home, mode):
    home.mkdir()
    home.chmod(mode)
    with pytest.raises(ModelError, match="can be written by others") as refusal:
        run()
    assert code(refusal) == "NS510"
    assert list(home.iterdir()) == []


def test_a_folder_that_others_can_read_is_closed(home):
    home.mkdir(mode=0o755)
    run()
    assert stat.S_IMODE(home.stat().st_mode) == 0o700


def test_a_folder_of_somebody_else_is_refused(home, monkeypatch):
    home.mkdir(mode=0o700)
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    with pytest.raises(ModelError, match="belongs to somebody else") as refusal:
        run()
    assert code(refusal) == "NS510"


def test_a_link_in_the_place_of_the_folder_is_refused(home, tmp_path):
    (tmp_path / "elsewhere").mkdir(mode=0o700)
    home.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(ModelError, match="is not a folder"):
        run()


def test_a_folder_that_cannot_be_made_is_told_with_the_way_out(home, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    with pytest.raises(ModelError, match="XDG_CACHE_HOME") as refusal:
        run()
    assert code(refusal) == "NS602"


def test_two_runs_at_once_build_the_same_and_leave_nothing_half_done(home):
    program = f"import nsode; print(nsode.loads({TEXT!r}).simulate(method='euler')['p'][-1])"

    def other(_):
        return subprocess.run(
            [sys.executable, "-c", program], capture_output=True, text=True, check=True
        ).stdout

    with ThreadPoolExecutor(3) as pool:
        found = list(pool.map(other, range(3)))
    assert [float(text) for text in found] == pytest.approx([END] * 3)
    assert {path.suffix for path in home.iterdir()} == {".so"}


def test_a_failing_compiler_says_so_and_leaves_nothing(home, tmp_path, monkeypatch):
    compiler = tmp_path / "broken"
    compiler.write_text("#!/bin/sh\necho 'no space for this' >&2\nexit 3\n")
    compiler.chmod(0o755)
    monkeypatch.setenv("CC", str(compiler))
    with pytest.raises(ModelError) as refusal:
        run()
    assert code(refusal) == "NS509"
    assert refusal.value.diagnostics[0].notes == ("no space for this",)
    assert list(home.iterdir()) == []


def test_a_compiler_that_knows_only_plain_flags_will_do(home, tmp_path, monkeypatch):
    compiler = tmp_path / "old"
    compiler.write_text(
        '#!/bin/sh\nfor a in "$@"; do case "$a" in -O3) exit 1;; esac; done\nexec gcc "$@"\n'
    )
    compiler.chmod(0o755)
    monkeypatch.setenv("CC", str(compiler))
    assert run() == pytest.approx(END)


def test_a_compiler_command_is_never_a_shell_command(home, tmp_path, monkeypatch):
    monkeypatch.setenv("CC", f"gcc;touch {tmp_path / 'owned'}")
    run()  # no program has that name: the next compiler is taken
    assert not (tmp_path / "owned").exists()


def test_parameters_of_the_model_do_not_matter_to_its_library(home):
    run()
    run(TEXT.replace("k = 1", "k = 2"))
    assert len(entries(home)) == 1


def test_clear_removes_every_entry_and_what_a_killed_build_left(home):
    run()
    (home / "build-left").mkdir()
    (home / "build-left" / "scene.c").write_text("")
    os.utime(home / "build-left", (0, 0))
    found = cache.clear()
    assert found.entries == 1
    assert found.size > 0
    assert list(home.iterdir()) == []
    assert cache.clear() == (0, 0)


def test_clear_leaves_a_build_that_may_still_go_on(home):
    run()
    (home / "build-now").mkdir()
    assert cache.clear().entries == 1
    assert [path.name for path in home.iterdir()] == ["build-now"]


def test_a_compiler_in_cc_that_is_not_there_is_named(home, monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler -O1")
    [said] = overlooked()
    assert (said.code, said.severity) == ("NS509", "note")
    assert "no-such-compiler" in said.message
    monkeypatch.delenv("CC")
    assert overlooked() == []


def test_a_cc_that_is_no_command_is_refused(home, monkeypatch):
    monkeypatch.setenv("CC", 'gcc "-O2')
    with pytest.raises(ModelError, match="no closing quotation") as refusal:
        run()
    assert code(refusal) == "NS509"


def test_a_relative_cache_folder_is_ignored(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", "somewhere")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert cache.folder() == tmp_path / ".cache" / "nsode"
