"""Friction whose force reaches its argument too late to hold it: one integration in between.

In stick, ``f = K*(a + beta*a')`` with ``a' = theta``. Where the force acts on theta' that is a
spring and a damper. Where it acts on theta'' alone, as ``theta'' = -w*f - d*theta'``, stick obeys
``s^3 + d*s^2 + w*K*beta*s + w*K = 0``, which grows unless ``beta*d > 1``, whatever K is.
"""

from __future__ import annotations

import numpy as np

from nsode.analysis.local import LAW, Element, Local
from nsode.analysis.point import Vector
from nsode.analysis.scene import Scene
from nsode.diagnostics import Diagnostic, Label

_ROUNDING = 1e-12


def late(scene: Scene, local: Local) -> list[Diagnostic]:
    """Return a warning for each sgn term that cannot hold what it reads.

    That it does not act on theta' is required of every state, as a path through theta' may
    vanish at the start only; that it acts on theta'' is seen there. Another term that acts on
    theta' and reads the same holds it for both, as in the super-twisting controller.
    """
    weight, damping = _acceleration(local)
    held = _held(scene, local)
    found: dict[str, Diagnostic] = {}
    for element, given in zip(scene.elements, scene.constants, strict=True):
        if element.is_contact or element.term.approximation.law != LAW:
            continue
        rows = list(element.rows)
        grows = (damping[rows] <= 0) | (given.beta * damping[rows] < 1)
        late = [tuple(local.motion[row]) not in held for row in rows]
        if (late & (weight[rows] > 0) & grows).any():
            found.setdefault(element.term.name, _late(element))
    return list(found.values())


def _held(scene: Scene, local: Local) -> set[tuple[float, ...]]:
    """Return d(theta)/dx of each sliding velocity that a term acts on at once."""
    at_once = scene.acts_at_once.diagonal()
    rows = (row for e in scene.elements if not e.is_contact for row in e.rows)
    return {tuple(local.motion[row]) for row in rows if at_once[row]}


def _acceleration(local: Local) -> tuple[Vector, Vector]:
    """Return w and d of each multiplier on its own theta; w = 0 where rounding is all of it."""
    motion, state, force = local.motion, local.state, local.force
    second = -np.einsum("ij,ji->i", motion @ state, force)
    third = -np.einsum("ij,ji->i", motion @ state @ state, force)
    size = np.einsum("ij,ji->i", abs(motion) @ abs(state), abs(force))
    weight = np.where(second > _ROUNDING * size, second, 0.0)
    return weight, -third / second


def _late(element: Element) -> Diagnostic:
    name = element.term.name
    return Diagnostic(
        "NS412",
        f"`{name}` cannot hold its argument: it acts on the second derivative and not on the first",
        (Label(element.term.argument[0].span, "this argument"),),
        notes=("where it should rest it swings and does not die out, whatever K is",),
        help="let `sgn` read the velocity that its force acts on; "
        "for a sliding mode, `sgn(v + c*x)` where `v` is the rate of `x`",
        severity="warning",
    )
