"""Units: optional, converted to SI, and checked as far as a model declares them.

What a unit in braces means stands in :mod:`.reading` (SI) and :mod:`.library` (pint),
how units combine in :mod:`.inference`, where they must agree in :mod:`.check`.
"""

from nsode.inclusion.units.check import check_units
from nsode.inclusion.units.conversion import in_si

__all__ = ["check_units", "in_si"]
