"""What can be known before a run: effective mass, stable steps, energy, restitution."""

from nsode.analysis.analyze import analyze
from nsode.analysis.energy import ledger
from nsode.analysis.quick import Foreseen, foresee, warnings
from nsode.analysis.restitution import impact, mapped_restitution
from nsode.analysis.result import Analysis

__all__ = [
    "Analysis",
    "Foreseen",
    "analyze",
    "foresee",
    "impact",
    "ledger",
    "mapped_restitution",
    "warnings",
]
