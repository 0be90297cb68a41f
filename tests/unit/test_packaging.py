from __future__ import annotations

import importlib.util
import sys
import tomllib
from pathlib import Path

import pytest

from support.native import run_tool

ROOT = Path(__file__).parents[2]
TOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]
PACKAGES = TOOLS["setuptools"]["packages"]


def folder_of(package: str) -> Path:
    moved = TOOLS["setuptools"]["package-dir"]
    return ROOT / moved.get(package, package.replace(".", "/"))


def test_every_package_of_the_tree_is_listed():
    found = {
        ".".join(path.parent.relative_to(ROOT).parts) for path in ROOT.glob("nsode/**/__init__.py")
    }
    pages = {"nsode.catalog"}  # a folder of texts, without an __init__.py
    assert found | pages | {"nsode.grammar", "nsode.models"} == set(PACKAGES)


def test_no_module_stands_outside_a_package():
    folders = {path.parent for path in ROOT.glob("nsode/**/*.py")}
    assert folders <= {folder_of(package) for package in PACKAGES}


@pytest.mark.parametrize("package", PACKAGES)
def test_what_is_installed_is_what_the_tree_holds(package):
    spec = importlib.util.find_spec(package)
    assert spec is not None
    [installed] = map(Path, spec.submodule_search_locations[:1])
    for source in folder_of(package).iterdir():
        if source.suffix in {".py", ".lark", ".di", ".md"} or source.name == "py.typed":
            assert (installed / source.name).read_bytes() == source.read_bytes()


def test_a_clone_works_before_it_is_installed():
    program = (
        f"import sys; sys.path.insert(0, {str(ROOT)!r})\n"
        "import nsode, nsode.models; print(nsode.__file__, nsode.models.__file__)\n"
        "nsode.loads('model m\\nstate v = 1\\nder(v) = -v')"
    )
    told = run_tool([sys.executable, "-P", "-c", program]).stdout.split()
    assert [Path(path).resolve() for path in told] == [
        ROOT / "nsode" / "__init__.py",
        ROOT / "models" / "__init__.py",
    ]


def test_every_layer_of_the_contract_exists_or_is_marked_as_to_come():
    [contract] = TOOLS["importlinter"]["contracts"]
    layers = [name for layer in contract["layers"] for name in layer.split(" | ")]
    here = {
        f"nsode.{path.stem}"
        for path in (ROOT / "nsode").iterdir()
        if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    free = {"nsode.__init__", "nsode.__main__"}
    assert here - free <= {name.strip("()") for name in layers}
    assert {name for name in layers if not name.startswith("(")} <= here
