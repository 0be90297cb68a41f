"""The rewrite, shown happening: the inclusion, each replacement, the augmented ODE."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass

from nsode.explain.steps import Step, steps
from nsode.ode import AugmentedODE, DifferentialInclusion

__all__ = ["Explanation", "Step", "explain"]


@dataclass(frozen=True, slots=True)
class Explanation:
    """How one differential inclusion becomes an ODE; a notebook shows it typeset."""

    inclusion: DifferentialInclusion
    ode: AugmentedODE
    steps: tuple[Step, ...]

    def text(self, *, color: bool = False) -> str:
        """Return it for a terminal."""
        from nsode.explain.text import text

        return text(self, color=color)

    def markdown(self) -> str:
        """Return it as Markdown with TeX between dollars."""
        from nsode.explain.typeset import MARKDOWN, typeset

        return typeset(self, MARKDOWN)

    def latex(self) -> str:
        """Return it as a LaTeX document."""
        from nsode.explain.typeset import LATEX, typeset

        return typeset(self, LATEX)

    def __str__(self) -> str:
        return self.text()

    def _repr_mimebundle_(
        self, include: Container[str] | None = None, exclude: Container[str] | None = None
    ) -> dict[str, str]:
        return {"text/plain": self.text(), "text/markdown": self.markdown()}


def explain(inclusion: DifferentialInclusion, ode: AugmentedODE) -> Explanation:
    """Return how an inclusion became its augmented ODE."""
    return Explanation(inclusion, ode, steps(inclusion, ode))
