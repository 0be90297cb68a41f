"""Running a model: build its C, load it, step it, and hand back a trajectory."""

from __future__ import annotations
