"""The figures of the paper, and that their words are true of their runs."""

from __future__ import annotations

import re

import numpy as np
import pytest

from nsode import paper
from nsode.cli.paper import _FIGURES
from support import listing

pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def sheets():
    return {name: paper.draw(name) for name in paper.FIGURES}


def test_the_command_knows_every_figure():
    assert list(paper.FIGURES) == list(_FIGURES)


def test_a_figure_is_written_with_its_words_and_its_runs(sheets, tmp_path):
    paper.write("fig7", sheets["fig7"], tmp_path)
    assert listing(tmp_path) == ["fig7-run.npz", "fig7.md", "fig7.pdf", "fig7.png"]
    first = (tmp_path / "fig7.pdf").read_bytes()
    paper.write("fig7", sheets["fig7"], tmp_path)
    assert (tmp_path / "fig7.pdf").read_bytes() == first


def test_in_figure_3_lugre_and_dahl_drift_and_the_paper_does_not(sheets):
    runs = sheets["fig3"].runs

    def moved(name):
        run = runs[name]
        # 10 and 20 s lie half a period apart in phase at most: 3e-5 m of elastic swing
        return run["p"][-1] - run["p"][len(run) // 2]

    assert abs(moved("xiong2013")) < 1e-4
    assert moved("lugre") > 5e-3
    assert moved("dahl") > moved("lugre")


def test_the_table_of_figure_5_holds_the_measured_restitutions(sheets):
    found = [float(number) for number in re.findall(r"ms \| ([\d.]+) \|", sheets["fig5"].text)]
    assert found == pytest.approx([1.0, 0.8790, 0.7677, 0.2829], abs=0.002)


def test_figure_9_says_at_which_step_the_blocks_rest(sheets):
    papers, stable = map(float, re.findall(r"ms \| (\S+) m/s", sheets["fig9"].text))
    assert 1e-5 < papers < 1
    assert stable < 1e-12


def test_figure_11_compares_laws_where_nothing_sticks_and_says_so(sheets):
    runs = sheets["fig11"].runs
    assert np.abs(runs["u1"]["p"] - runs["u1-smoothing"]["p"]).max() < 1e-4
    assert "sticks for 16 % of the time" in sheets["fig11"].text
    rest = re.search(r"below (\S+) m/s while it sticks", sheets["fig11"].text)
    unrest = re.search(r"chatters by up to (\S+) m/s", sheets["fig11"].text)
    assert float(rest[1]) < 0.1 * float(unrest[1])
