"""A figure that shows itself in a notebook, with or without pyplot."""

from __future__ import annotations

from io import BytesIO

from matplotlib.figure import Figure as Plain


class Figure(Plain):
    """A matplotlib figure that Jupyter displays as it is.

    One made without pyplot shows there as its repr only, unless pyplot has drawn before.
    """

    def _repr_png_(self) -> bytes:
        buffer = BytesIO()
        self.savefig(buffer, format="png", dpi=110)
        return buffer.getvalue()
