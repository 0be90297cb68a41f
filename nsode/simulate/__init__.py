"""Running a model: build its C, load it, step it, and hand back a trajectory."""

from __future__ import annotations

from nsode.simulate.failure import RunError
from nsode.simulate.observe import Mode
from nsode.simulate.settings import Wish
from nsode.simulate.simulation import Manner, RunWarning, simulate
from nsode.simulate.trajectory import Trajectory

__all__ = ["Manner", "Mode", "RunError", "RunWarning", "Trajectory", "Wish", "simulate"]
