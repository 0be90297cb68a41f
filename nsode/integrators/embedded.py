"""What an embedded pair is: a tableau, the weights of its error, and a dense output."""

from __future__ import annotations

from dataclasses import dataclass

from nsode.integrators.scheme import Row, RungeKutta


@dataclass(frozen=True, slots=True)
class EmbeddedPair:
    """A pair whose last stage is the first of the next step.

    ``error`` holds the weights of the difference between the two results. ``dense`` holds
    those of the quartic term of the interpolant: with s in [0, 1], d = x1 - x0 and
    b = h*k1 - d it is

        x0 + s*(d + (1 - s)*(b + s*((d - h*k_last - b) + (1 - s)*h*sum(dense*k))))
    """

    method: RungeKutta
    error: Row
    dense: Row

    def __post_init__(self) -> None:
        stages = self.method.stages
        if len(self.error) != stages or len(self.dense) != stages:
            raise ValueError(f"the pair `{self.name}` lacks a weight")
        if self.method.a[-1] != self.method.b[:-1] or self.method.b[-1]:
            raise ValueError(f"the last stage of `{self.name}` is not that of the next step")
        if sum(self.error):
            raise ValueError(f"the results of `{self.name}` differ at constant rates")

    @property
    def name(self) -> str:
        """The name by which a model and a command choose the pair."""
        return self.method.name

    @property
    def title(self) -> str:
        """What a person calls it."""
        return self.method.title

    @property
    def order(self) -> int:
        """The power of the step in the error of the result that is kept."""
        return self.method.order
