"""The step that a method can take at a few states, by the Jacobian of the ODE itself.

For laws whose active sets are not known: at the start, pressed and sticking, and pressed and
sliding as at the start. Other states may want less, so what is found proves nothing; but a
step beyond it is too long.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from nsode.analysis.local import LAW, Element, Local
from nsode.analysis.point import Matrix, Point, Vector, assemble, start
from nsode.analysis.scene import Scene
from nsode.analysis.stability import reach, upper
from nsode.analysis.steps import StableStep
from nsode.derivative import Jacobian, jacobian
from nsode.integrators import Scheme
from nsode.ode import AugmentedODE, layout
from nsode.rewrite import rewrite

_ROUNDS = 5  # of Newton's method toward gaps that are not affine in the state
_FASTEST = 64  # modes of a state whose limits are computed
_RESOLVED = 1e-12  # of the terms of a gap: a depth that rounding cannot take for open
_ROUNDING = 1e-9  # of a mode's magnitude: what is left of a real part of zero

_Modes = tuple[tuple[str, str], ...]


def limit(scene: Scene, local: Local, load: Sequence[float], scheme: Scheme) -> StableStep | None:
    """Return the least limit of a method at the states that are looked at; None if there is none.

    Parameters
    ----------
    local, load
        The linear model at the start, and the forces that would hold the scene at rest.
    """
    ode = rewrite(scene.inclusion)
    derivatives = jacobian(ode)
    found: list[StableStep] = []
    for modes, x, depths in _states(scene, local, load):
        matrix = _matrix(ode, derivatives, _point(scene, ode, x, depths))
        if not np.isfinite(matrix).all():
            continue
        values = np.linalg.eigvals(matrix)
        values.real[np.abs(values.real) <= _ROUNDING * np.abs(values)] = 0.0
        fastest = values[np.argsort(-np.abs(values), kind="stable")][:_FASTEST]
        damped = [upper(complex(value)) for value in fastest if value.real <= 0 and value]
        steps = [(reach(scheme, value), value) for value in damped]
        found += [
            StableStep(scheme.name, step, False, step, value, modes, None, ())
            for step, value in steps
            if step > 0
        ]
    return min(found, key=lambda step: step.step, default=None)


def _states(
    scene: Scene, local: Local, load: Sequence[float]
) -> Iterator[tuple[_Modes, Vector, Mapping[str, float]]]:
    """Yield states with what the elements do there, and how deep the contacts are pressed."""
    contacts = [element for element in scene.elements if element.is_contact]
    frictions = [element for element in scene.elements if not element.is_contact]
    seen = _RESOLVED * (np.abs(local.slope) @ np.abs(scene.start_state) + np.abs(local.argument))
    depths = {e.name: max(_depth(scene, e, load[e.rows[0]]), seen[e.rows[0]]) for e in contacts}
    closed = {e.rows[0]: -depths[e.name] for e in contacts}
    resting = closed | {row: 0.0 for e in frictions for row in e.rows}
    pressed = tuple((e.name, "contact") for e in contacts)
    yield tuple(_at_start(scene, local)), scene.start_state, {}
    yield (*pressed, *((e.name, "stick") for e in frictions)), _near(scene, local, resting), depths
    if frictions and contacts:
        slides = (*pressed, *((e.name, "slip") for e in frictions))
        yield slides, _near(scene, local, closed), depths


def _at_start(scene: Scene, local: Local) -> Iterator[tuple[str, str]]:
    for element in scene.elements:
        here = local.argument[list(element.rows)]
        if element.is_contact:
            yield element.name, "open" if here[0] > 0 else "contact"
        else:
            yield element.name, "slip" if here.any() else "stick"


def _depth(scene: Scene, element: Element, load: float) -> float:
    """Return how deep a force of rest presses a contact whose force is ``K*depth**n``."""
    known = scene.start.values
    stiffness = known[f"{element.term.name}.K"][0]
    power = known.get(f"{element.term.name}.n", [1.0])[0]
    return float(np.power((load if load > 0 else 1.0) / stiffness, 1.0 / power))


def _near(scene: Scene, local: Local, wanted: Mapping[int, float]) -> Vector:
    """Return the state nearest the start with these gaps and sliding velocities."""
    rows, values = list(wanted), np.array(list(wanted.values()))
    x = scene.start_state
    for _ in range(_ROUNDS if scene.gaps_bend else 1):
        missing = values - local.argument[rows]
        x = x + np.linalg.lstsq(local.slope[rows], missing, rcond=None)[0]
        local = scene.at(scene.point(x.tolist()))
    return x


def _point(scene: Scene, ode: AugmentedODE, x: Vector, depths: Mapping[str, float]) -> Point:
    point = start(ode)
    for state in scene.inclusion.states:
        offset, span = scene.states[state.name]
        count = 1 if span is None else len(span)
        point.set(state.name, span, x[offset : offset + count].tolist())
    for element in scene.elements:  # the paper's e follows the gap, at rest all the way
        if element.name in depths and element.term.approximation.law == LAW:
            e = f"{element.term.name}.e"
            place = 0 if element.term.range is None else element.rows[0] - _first(scene, element)
            point.values[e][place] = depths[element.name]
    point.define(ode.bindings)
    return point


def _first(scene: Scene, element: Element) -> int:
    return scene.multipliers[element.term.multiplier[0]].offset


def _matrix(ode: AugmentedODE, derivatives: Jacobian, point: Point) -> Matrix:
    point.define(derivatives.definitions)
    slots = layout(ode.states)
    return assemble(derivatives.entries, point, slots, slots)
