"""Every notebook runs from top to bottom, in a kernel of its own, and is stored as it ran."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")

NOTEBOOKS = sorted((Path(__file__).parents[2] / "notebooks").glob("*.ipynb"))
EXAMPLES = {"dry_friction", "bouncing_mass", "rolling_sphere", "two_blocks", "belt_oscillator"}
MACHINE = re.compile(r"(?<![\w.])/(home|root|tmp|work|usr|Users|var)/|[A-Z]:\\")

every_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def outputs(notebook):
    """Yield every output, and its text."""
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            texts = [part for kind, part in data.items() if not kind.startswith("image/")]
            yield output, "".join([output.get("text", ""), *texts])


def test_each_example_of_the_paper_has_a_notebook():
    assert {path.stem for path in NOTEBOOKS} >= EXAMPLES


@every_notebook
def test_the_stored_notebook_has_run_and_names_no_machine(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    counts = [cell.execution_count for cell in notebook.cells if cell.cell_type == "code"]
    assert counts == list(range(1, len(counts) + 1))
    for output, text in outputs(notebook):
        assert output.output_type != "error"
        assert output.get("name") != "stderr", text
        assert not MACHINE.search(text), text


@pytest.mark.filterwarnings("ignore")  # of the kernel's machinery, not of the notebook
@every_notebook
def test_the_notebook_runs_and_warns_of_nothing(path, tmp_path):
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(path, as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}
    )
    client.execute()
    assert all(cell.get("execution_count") for cell in notebook.cells if cell.cell_type == "code")
    assert not [text for output, text in outputs(notebook) if output.get("name") == "stderr"]
