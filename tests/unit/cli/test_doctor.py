from __future__ import annotations

from nsode.cli import run
from nsode.simulate import compilers


def test_doctor_passes_on_a_machine_without_anything(monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(compilers, "find_spec", lambda _: None)
    assert run(["doctor"]) == 0
    told = capsys.readouterr().out
    assert "no C compiler" in told
    assert "apt install gcc" in told
    assert "pip install ziglang" in told
