"""Trajectories: columns by name, files, tables, figures, and the command."""

from __future__ import annotations

import csv
import json
import os
import pty
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest

import nsode
from nsode.cli import run as command
from nsode.diagnostics import ModelError
from nsode.simulate import Mode, Trajectory
from nsode.simulate.panels import left_out, panels
from support import listing
from support.models import MODELS

DECAY = "model m\nparameter k = 1 {1/s}\nstate p = 1 {m}\nder(p) = -k*p\nsimulate 1 step 0.1\n"


@pytest.fixture(scope="module")
def sphere():
    return nsode.load(MODELS / "rolling_sphere.di").simulate(1.0, every=10)


@pytest.fixture
def model(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("m.di").write_text(DECAY)
    return "m.di"


# columns


def test_a_column_is_found_by_its_name_and_a_vector_by_its_stem(sphere):
    assert np.array_equal(sphere["p.z"], sphere.x[:, sphere.x_names.index("p.z")])
    assert sphere["p"].shape == (len(sphere), 3)
    assert sphere["q"].shape == (len(sphere), 4)
    assert np.array_equal(sphere["F"], np.column_stack([sphere["F.x"], sphere["F.y"]]))
    assert np.array_equal(sphere["F.a"], np.column_stack([sphere["F.a.x"], sphere["F.a.y"]]))
    assert np.array_equal(sphere["N.psi"], sphere["p.z"] - 0.5)
    assert sphere["t"] is sphere.t


def test_a_component_of_a_family_is_that_of_each_element():
    text = """\
model family
constant n = 3
state x[i in 1..n][2] = [0.1*i, -0.2*i]
force F[i in 1..n] = 2*sgn(x[i])
force N[i in 1..n] = dio(x[i].x)
for i in 1..n: der(x[i]) = [N[i], 0] - F[i]
approximate F: K = 100, beta = 1e-2
approximate N: K = 100, beta = 1e-2, alpha = 5e-3
"""
    run = nsode.loads(text).simulate(0.1, step=1e-3)
    each = [run[f"F[{i}].a.x"] for i in (1, 2, 3)]
    assert np.array_equal(run["F.a.x"], np.column_stack(each))
    assert run["F.a"].shape == (len(run), 6)
    assert run["N.e"].shape == run["N.psi"].shape == run["x.y"].shape == (len(run), 3)
    assert np.array_equal(run["F[2].a"], run["F.a"][:, [1, 4]])  # as stored: each x, then each y
    with pytest.raises(KeyError, match=r"nothing is called `F.b`"):
        run["F.b"]


def test_forces_and_units_are_known(sphere):
    assert sphere.forces == ("N", "F.x", "F.y")
    assert sphere.unit("v.x") == "m/s"
    assert sphere.unit("t") == "s"


def test_a_misspelt_name_draws_a_suggestion(sphere):
    with pytest.raises(KeyError, match=r"did you mean `p.z`"):
        sphere["p.zz"]
    with pytest.raises(KeyError, match="did you mean `N`"):
        sphere.mode("NN")


# files


def test_npz_holds_all_of_a_trajectory_without_pickle(sphere, tmp_path):
    path = sphere.save(tmp_path / "run.npz")
    with np.load(path, allow_pickle=False) as held:
        assert {"t", "x", "y", "x_names", "y_names", "meta"} <= set(held.files)
        assert held["x_names"].tolist() == list(sphere.x_names)
        meta = json.loads(str(held["meta"]))
    assert meta["model"]["text"] == (MODELS / "rolling_sphere.di").read_text()
    assert meta["parameters"]["N.K"] == 1e5
    back = Trajectory.load(path)
    for array in ("t", "x", "y", "psi", "modes"):
        assert np.array_equal(getattr(back, array), getattr(sphere, array))
    for plain in ("name", "x_names", "y_names", "mode_names", "forces", "units", "meta"):
        assert getattr(back, plain) == getattr(sphere, plain)


def test_the_same_run_makes_the_same_file(tmp_path):
    for name in ("a.npz", "b.npz"):
        nsode.loads(DECAY).simulate().save(tmp_path / name)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_csv_gives_every_number_back_exactly(sphere, tmp_path):
    path = sphere.save(tmp_path / "run.csv")
    with path.open() as file:
        head, *rows = csv.reader(file)
    assert head == ["t", *sphere.x_names, *sphere.y_names]
    expected = np.column_stack([sphere.t, sphere.x, sphere.y])
    assert np.array_equal(np.array(rows, dtype=float), expected)


def test_a_file_that_cannot_be_written_leaves_the_old_one(sphere, tmp_path, monkeypatch):
    path = tmp_path / "run.npz"
    path.write_text("old")

    def full(*_args, **_kwargs):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez", full)
    with pytest.raises(OSError, match="No space"):
        sphere.save(path)
    assert path.read_text() == "old"
    assert listing(tmp_path) == ["run.npz"]


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"t,x\n0,1\n"])
def test_something_else_is_not_taken_for_a_trajectory(tmp_path, content):
    path = tmp_path / "run.npz"
    path.write_bytes(content)
    with pytest.raises(ModelError, match="no trajectory"):
        Trajectory.load(path)


@pytest.mark.parametrize(
    "foreign",
    [
        {"x": np.zeros(11)},
        {"x": np.zeros((11, 1), complex)},
        {"x": np.zeros((2, 1))},
        {"t": np.zeros((11, 1))},
        {"t": np.array("0")},
        {"x_names": np.array(["p", "q"])},
        {"modes": np.zeros((11, 1), np.int8)},
        {"meta": np.array("null")},
        {"meta": np.array("[" * 100_000)},
        {"meta": np.array("{}")},
    ],
)
def test_arrays_that_do_not_fit_are_no_trajectory(tmp_path, foreign):
    path = nsode.loads(DECAY).simulate().save(tmp_path / "run.npz")
    np.savez(path, **(dict(np.load(path)) | foreign))
    with pytest.raises(ModelError, match="no trajectory"):
        Trajectory.load(path)


def test_a_head_that_promises_more_than_any_memory_is_no_trajectory(tmp_path):
    path = tmp_path / "run.npz"
    head = b"{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000000, 3), }"
    array = b"\x93NUMPY\x01\x00" + (len(head) + 1).to_bytes(2, "little") + head + b"\n"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("t.npy", array)
    with pytest.raises(ModelError, match="no trajectory"):
        Trajectory.load(path)


def test_pickled_arrays_are_refused(tmp_path):
    path = tmp_path / "run.npz"
    np.savez(path, t=np.array([{}], dtype=object), meta=np.array("{}"))
    with pytest.raises(ModelError, match="no trajectory"):
        Trajectory.load(path)


# tables and figures


def test_pandas_gets_states_and_outputs_over_time(sphere):
    pytest.importorskip("pandas")
    frame = sphere.to_pandas()
    assert list(frame.columns) == [*sphere.x_names, *sphere.y_names]
    assert np.array_equal(frame["v.x"].to_numpy(), sphere["v.x"])
    assert frame.index.name == "t"


def test_xarray_gets_units_too(sphere):
    pytest.importorskip("xarray")
    found = sphere.to_xarray()
    assert found["v.x"].attrs["units"] == "m/s"


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_a_figure_shows_every_vector_and_the_modes(sphere, tmp_path, ending):
    pytest.importorskip("matplotlib")
    file = tmp_path / f"run.{ending}"
    figure = sphere.plot(file=file)
    labels = [axis.get_ylabel() for axis in figure.axes]
    assert labels[:2] == ["p [m]", "v [m/s]"]
    assert [text.get_text() for text in figure.axes[-1].get_yticklabels()] == ["F", "N"]
    assert file.stat().st_size > 5_000


def test_a_figure_of_chosen_names(sphere):
    pytest.importorskip("matplotlib")
    figure = sphere.plot("p.z", "F", "N.psi")
    titles = [axis.get_ylabel() for axis in figure.axes[:3]]
    assert titles == ["p.z [m]", "F [N]", "N.psi [m]"]
    assert len(figure.axes[1].lines) == 2


def test_a_figure_shows_what_the_elements_do(sphere):
    pytest.importorskip("matplotlib")
    drawn = {axis.get_ylabel(): axis for axis in sphere.plot().axes}
    assert {"N [N]", "F [N]", "penetration [m]"} < set(drawn)
    [depth] = drawn["penetration [m]"].lines
    np.testing.assert_array_equal(depth.get_ydata(), np.maximum(0.0, 0.5 - sphere["p.z"]))
    closed = np.flatnonzero(np.diff((sphere.mode("N") == Mode.CONTACT).astype(int)) == 1)
    gray = sorted(patch.get_x() for patch in drawn["v [m/s]"].patches)
    np.testing.assert_array_equal(gray, sphere.t[closed + 1])


def test_scalars_of_one_unit_share_a_panel_and_elements_of_one_kind_do():
    panels_ = panels(nsode.load(MODELS / "gripper.di").simulate(0.01))
    titles = [panel.title for panel in panels_]
    assert titles[2:4] == ["a, b [m]", "va, vb [m/s]"]
    assert titles[4:] == ["L, R [N]", "FL, FR [N]", "penetration [m]"]


def test_of_a_large_family_the_ends_are_named():
    pytest.importorskip("matplotlib")
    figure = nsode.load(MODELS / "burridge_knopoff.di").simulate(0.1).plot()
    legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert legend == ["x[1]", "x[32]"]
    assert len(figure.axes[0].lines) == 32
    assert [text.get_text() for text in figure.axes[-1].get_yticklabels()] == ["F[32]", "F[1]"]


@pytest.mark.parametrize("name", ["rolling_sphere", "two_blocks_conveyor", "burridge_knopoff"])
def test_no_legend_and_no_label_lies_on_a_curve_or_on_another(name):
    pytest.importorskip("matplotlib")
    figure = nsode.load(MODELS / f"{name}.di").simulate(0.5).plot()
    figure.draw_without_rendering()
    boxes = [axis.get_window_extent() for axis in figure.axes]
    legends = [axis.get_legend() for axis in figure.axes if axis.get_legend() is not None]
    texts = [legend.get_window_extent() for legend in legends]
    texts += [axis.yaxis.label.get_window_extent() for axis in figure.axes]
    for k, text in enumerate(texts):
        assert not any(text.overlaps(box) for box in boxes)
        assert not any(text.overlaps(other) for other in texts[:k])


def test_energies_are_drawn_where_the_run_kept_the_ledger():
    model = nsode.load(MODELS / "bouncing_mass.di").with_ledger()
    energy = panels(model.simulate(1.0, 1e-4))[-1]
    assert energy.title == "energy [J]"
    given, stored, dissipated = (energy.curves[w] for w in ("given", "stored", "dissipated"))
    np.testing.assert_allclose(stored + dissipated, given, atol=1e-2 * given.max())
    assert [panel.title for panel in panels(model.simulate(1.0, every=5))][
        -1
    ] == "stored energy [J]"


def test_a_trajectory_shows_itself_as_text_and_html(sphere):
    assert "rolling_sphere: 1 s in 1,000 steps of 1 ms by rk4, 101 rows" in str(sphere)
    assert "<table>" in sphere._repr_html_()
    assert "v.x" in sphere._repr_html_()


def test_a_summary_tells_how_far_each_element_gives_way():
    run = nsode.loads("""
model heavy
state p = -9.81/N.K
state w = 0
state v[2] = [3, 4]
force N = dio(p)
force F = 2*sgn(v)
der(p) = w
der(w) = N - 9.81
der(v) = -F
approximate N: K = 1e5, beta = 4e-3, alpha = 2e-3, at equilibrium
approximate F: K = 1e3, beta = 4e-2
simulate 1 step 1e-3
""").simulate()
    assert str(run).splitlines()[-2:] == [
        "  N: contact 100 %, deepest 9.81e-05",  # M*g/K
        "  F: slip 100 %, presliding 0.002",  # the level of friction over K
    ]


def test_a_long_summary_begins_with_what_is_no_element_of_a_family():
    text = "state x[i in 1..40] = i\nfor i in 1..40: der(x[i]) = -x[i]\n"
    mean = "output mean = sum(i in 1..40: x[i])/40\n"
    run = nsode.loads(f"model many\n{text}{mean}simulate 1 step 0.1\n").simulate()
    _, _, first, second, *_, last = str(run).splitlines()
    assert first.split()[:2] == ["mean", "20.5"]
    assert second.split()[:2] == ["x[1]", "1"]
    assert last == "  and 25 more"


# the command


def test_the_command_runs_and_writes(model, capfd):
    assert command(["simulate", model, "-o", "run.csv", "--plot"]) == 0
    assert listing(Path()) == ["m.di", "m.png", "run.csv"]
    out = capfd.readouterr()
    assert "m: 1 s in 10 steps of 100 ms by rk4, 11 rows" in out.out
    assert out.err == ""


def test_the_command_takes_settings_parameters_and_inputs(model, capfd):
    Path("m.di").write_text(
        "model m\nparameter k = 1\ninput f\nstate p = 0\nder(p) = f - k*p\nsimulate 1 step 0.1\n"
    )
    Path("data.csv").write_text("t,f\n0,1\n1,1\n")
    arguments = ["--for", "0.4", "--step", "0.2", "--method", "euler", "-p", "k=0.5"]
    assert command(["simulate", model, *arguments, "-u", "f=data.csv", "-o", "a.npz"]) == 0
    assert Trajectory.load("a.npz")["p"] == pytest.approx([0, 0.2, 0.2 + 0.2 * 0.9])
    assert command(["simulate", model, *arguments, "-u", "f=2", "-o", "b.npz"]) == 0
    assert Trajectory.load("b.npz")["p"][1] == pytest.approx(0.4)
    capfd.readouterr()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t,g,h\n0,1,2\n", "has no column `f`"),
        ("0,1,2\n", "has no column `f`"),
        ("0 1\n1 2\n", "it has 1 column\n"),
        ("t,f\n0,1\n1,one\n", "no table of numbers: `one` in line 3 is no number"),
        ("0,1\n1,1_0\n", "no table of numbers: `1_0` in line 2 is no number"),
        ("t,f\n0,1\n1\n", "no table of numbers: line 3 ends before column 2"),
        ("t,f\n\n", "no table of numbers: no row stands below its head"),
        ("", "no table of numbers: it is empty"),
    ],
)
def test_a_table_that_does_not_hold_the_input_is_refused(model, text, message, capfd):
    Path("m.di").write_text("model m\ninput f\nstate p = 0\nder(p) = f\nsimulate 1 step 0.1\n")
    Path("data.csv").write_text(text)
    assert command(["simulate", model, "-u", "f=data.csv"]) == 1
    assert message in capfd.readouterr().err


def test_a_pipe_or_a_device_is_no_table_and_is_not_waited_for(model, capfd):
    os.mkfifo("pipe")
    Path("m.di").write_text("model m\ninput f\nstate p = 0\nder(p) = f\nsimulate 1 step 0.1\n")
    for path in ("pipe", "/dev/zero"):
        assert command(["simulate", model, "-u", f"f={path}"]) == 2
        assert capfd.readouterr().err == (
            f"error[NS601]: cannot read `{path}`: it is not a regular file\n"
        )


@pytest.mark.parametrize(
    ("flags", "status", "message"),
    [
        (["--step", "0"], 1, "NS501"),
        (["--step", "nan"], 1, "NS501"),
        (["--for", "-1"], 1, "NS501"),
        (["--for", "1e9", "--step", "1e-6"], 1, "3.2 years"),
        (["--for", "1e5", "--step", "1e-5", "--every", "1"], 1, "160 GB"),
        (["-o", "no/such/x.csv"], 2, "there is no folder `no/such`"),
        (["-o", "-rf"], 2, "must end in `.npz` or `.csv`"),
        (["-o", "folder.csv"], 2, "it is a folder"),
        (["--plot", "m.di"], 2, "must end in one of"),
        (["-p", "k"], 2, "NAME=NUMBER"),
        (["-p", "k=one"], 2, "`k=one` is not NAME=NUMBER"),
        (["-p", "kk=1"], 1, "did you mean `k`?"),
        (["-u", "f=none.csv"], 2, "cannot read `none.csv`"),
    ],
)
def test_the_command_refuses_before_the_run(model, flags, status, message, capfd):
    Path("folder.csv").mkdir()
    assert command(["simulate", model, *flags]) == status
    assert message in capfd.readouterr().err
    assert listing(Path()) == ["folder.csv", "m.di"]
    assert Path("m.di").read_text() == DECAY


def test_rows_before_a_failure_are_written(model, capfd):
    Path("m.di").write_text("model m\nstate p = 1\nder(p) = p^2\n")
    flags = ["--for", "2", "--step", "1e-3", "-o", "run.csv"]
    assert command(["simulate", model, *flags]) == 1
    assert "NS504" in capfd.readouterr().err
    rows = Path("run.csv").read_text().splitlines()
    assert 1000 < len(rows) < 1010


def test_ctrl_c_writes_what_was_computed_and_the_bar_shows_on_terminals_only(model):
    program = "import sys; from nsode.cli import run; sys.exit(run(sys.argv[1:]))"
    flags = ["--for", "1e6", "--step", "1e-3", "--every", "100000", "-o", "run.npz"]
    terminal, other_end = pty.openpty()
    child = subprocess.Popen(
        [sys.executable, "-c", program, "simulate", model, *flags],
        stdout=subprocess.DEVNULL, stderr=other_end,
    )  # fmt: skip
    os.close(other_end)
    shown = b""
    while b" s left" not in shown:
        shown += os.read(terminal, 1000)
    child.send_signal(signal.SIGINT)
    begin = time.monotonic()
    assert child.wait(timeout=20) == 130
    assert time.monotonic() - begin < 5
    os.close(terminal)
    assert Trajectory.load("run.npz").meta["run"]["interrupted"]


def test_the_cache_is_shown_and_cleared(model, tmp_path, monkeypatch, capfd):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert command(["simulate", model]) == 0
    assert command(["cache"]) == 0
    assert "1 compiled models" in capfd.readouterr().out
    assert command(["cache", "clear"]) == 0
    assert "1 removed" in capfd.readouterr().out
    assert command(["cache"]) == 0
    assert "0 compiled models" in capfd.readouterr().out


def test_a_figure_tells_how_much_it_leaves_out():
    assert left_out(nsode.load(MODELS / "granular_column.di").simulate(1e-3)) == ""
    lines = [f"state p{k}[2] = [0, 0]\nder(p{k}) = [0, 0]\n" for k in range(11)]
    many = nsode.loads(f"model many\n{''.join(lines)}simulate 1 step 0.1\n")
    assert left_out(many.simulate()) == ", without 3 of the states and outputs"


def test_a_figure_draws_energies_and_the_files_beside_it_do_not_change(tmp_path, capfd):
    pytest.importorskip("matplotlib")
    model, alone, beside = str(MODELS / "bouncing_mass.di"), tmp_path / "a.csv", tmp_path / "b.csv"
    assert command(["simulate", model, "-o", str(alone)]) == 0
    said = capfd.readouterr().out
    figure = tmp_path / "m.svg"
    assert command(["simulate", model, "-o", str(beside), "--plot", str(figure)]) == 0
    assert beside.read_bytes() == alone.read_bytes()
    assert capfd.readouterr().out.splitlines()[:-2] == said.splitlines()[:-1]
    assert "<!-- energy [J] -->" in figure.read_text()


def test_the_command_stores_the_ledger_with_the_run(tmp_path):
    file = tmp_path / "run.npz"
    model = str(MODELS / "bouncing_mass.di")
    assert command(["simulate", model, "--for", "0.5", "--ledger", "-o", str(file)]) == 0
    saved = Trajectory.load(file)
    assert {"f.stored", "f.dissipated", "f.given"} <= set(saved.y_names)
    work = 9.8 * (1 - saved["p"].min())  # of the weight; the contact stores no more
    assert 0.5 * work < saved["f.stored"].max() <= work
