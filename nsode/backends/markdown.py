"""The augmented ODE as Markdown with TeX between dollars, for notebooks and forges."""

from __future__ import annotations

from nsode.backends import Options
from nsode.backends.latex import equations, lower
from nsode.ode import AugmentedODE

__all__ = ["emit", "lower"]


def emit(ode: AugmentedODE, options: Options) -> dict[str, str]:
    """Return ``PREFIX.md``."""
    body = equations(ode, "$$\n{}\n$$\n\n", "where\n\n")
    title = ode.name.replace("_", r"\_")
    text = f"<!-- Written by nsode. -->\n# {title}\n\n{body}".rstrip() + "\n"
    return {f"{options.prefix or ode.name}.md": text}
