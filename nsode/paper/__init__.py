"""The figures of the paper, each from one model and one file here.

A figure says in words what it shows, with numbers measured in its own runs; where the
paper's own setting cannot show what it is meant to, the words say so.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from nsode.files import write_all
from nsode.paper.sheet import Sheet

__all__ = ["FIGURES", "Sheet", "draw", "write"]

#: Every figure with its title; figure ``name`` is drawn by ``nsode.paper.name``.
FIGURES: dict[str, str] = {
    "fig3": "Dry friction under a load below its level",
    "fig5": "A bouncing mass",
    "fig7": "Example I: a rolling sphere",
    "fig9": "Example II: two blocks, a wall and a conveyor",
    "fig11": "Example III: periodic motion on a belt",
}


def draw(name: str) -> Sheet:
    """Run what a figure shows and draw it.

    Raises
    ------
    KeyError
        If the paper has no such figure, or none that comes from a run.
    ModuleNotFoundError
        If matplotlib is not installed.
    """
    if name not in FIGURES:
        raise KeyError(name)
    make: Callable[[], Sheet] = import_module(f"nsode.paper.{name}").sheet
    return make()


def write(name: str, sheet: Sheet, folder: Path) -> list[Path]:
    """Write a figure as PDF and PNG, its words as Markdown, and its runs.

    Raises
    ------
    OSError
        If a file cannot be written.
    """
    from nsode.simulate.plot import write as write_figure

    words = f"# {FIGURES[name]} ({name})\n\n{sheet.text}\n"
    paths = write_all({f"{name}.md": words}, folder)
    for ending in ("pdf", "png"):
        path = folder / f"{name}.{ending}"
        write_figure(sheet.figure, path)
        paths.append(path)
    for run, trajectory in sheet.runs.items():
        paths.append(trajectory.save(folder / f"{name}-{run}.npz"))
    return paths
