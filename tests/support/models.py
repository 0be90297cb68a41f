"""The shipped models, where the installed package has them."""

from __future__ import annotations

from pathlib import Path

import nsode.models

MODELS = Path(nsode.models.__file__).parent
PATHS = sorted(MODELS.glob("*.di"))
