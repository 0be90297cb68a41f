"""What tests of several kinds share."""

from __future__ import annotations

from pathlib import Path

import nsode.models

#: Every shipped model; ``@pytest.mark.parametrize("model", MODELS, ids=lambda p: p.stem)``.
MODELS = sorted(Path(nsode.models.__file__).parent.glob("*.di"))


def listing(folder: Path) -> list[str]:
    """Return the names of what a folder holds, in order."""
    return sorted(path.name for path in folder.iterdir())
