"""Stage 2: from the model as written to the differential inclusion in normal form."""

from nsode.inclusion.build import build as build

__all__ = ["build"]
