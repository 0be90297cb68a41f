"""What tests of several kinds share."""

from __future__ import annotations

from pathlib import Path

import nsode.models

#: Every shipped model; ``@pytest.mark.parametrize("model", MODELS, ids=lambda p: p.stem)``.
MODELS = sorted(Path(nsode.models.__file__).parent.glob("*.di"))
