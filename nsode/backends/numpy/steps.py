"""The integrators, written beside the model."""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from nsode.integrators import REGISTRY, RungeKutta


def steps() -> list[str]:
    """Return a function for each registered method that has a tableau."""
    return [_step(scheme) for scheme in REGISTRY.values() if isinstance(scheme, RungeKutta)]


def _step(scheme: RungeKutta) -> str:
    stages = [
        f"k{i + 1} = rhs({_time(scheme.c[i])}, {_advance(scheme.a[i])}, u, p)"
        for i in range(scheme.stages)
    ]
    return "\n    ".join(
        [
            f"def step_{scheme.name}(t, h, x, u=u0, p=p0):",
            f'"""Return the states one step of length h later, by the {scheme.title} method."""',
            "x = np.asarray(x, dtype=real)",
            'with np.errstate(all="ignore"):',
            *(f"    {stage}" for stage in stages),
            f"    return flush({_advance(scheme.b)})",
        ]
    )


def _time(node: Fraction) -> str:
    return f"t + {_length(node)}" if node else "t"


def _length(part: Fraction) -> str:
    """Return a fraction of the step, as 3 * h / 4."""
    scaled = "h" if part.numerator == 1 else f"{part.numerator} * h"
    return scaled if part.denominator == 1 else f"{scaled} / {part.denominator}"


def _advance(weights: tuple[Fraction, ...]) -> str:
    """Return x moved along the slopes, over one denominator: x + h / 6 * (k1 + 2 * k2)."""
    used = [(w, f"k{i + 1}") for i, w in enumerate(weights) if w]
    if not used:
        return "x"
    common = Fraction(1, lcm(*(w.denominator for w, _ in used)))
    terms = [_scaled(w / common, slope) for w, slope in used]
    slopes = f"({' + '.join(terms)})" if len(terms) > 1 else terms[0]
    return f"x + {_length(common)} * {slopes}"


def _scaled(weight: Fraction, slope: str) -> str:
    return slope if weight == 1 else f"{weight} * {slope}"
