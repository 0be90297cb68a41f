"""Stage 1: from the text of a model to its tree. The only place that knows lark."""

from __future__ import annotations

from nsode.syntax.parser import parse
from nsode.syntax.reading import decode, read

__all__ = ["decode", "parse", "read"]
