"""Growth of the difference of two runs inside an active set, with the emitted NumPy code.

The state of the first run is made a resting point by subtracting its own rates, which
changes no difference; so both runs stay inside the set for as long as one likes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import nsode
from nsode.analysis.local import Element
from nsode.analysis.scene import Scene
from nsode.backends import Options, emit
from nsode.ode import AugmentedODE, element_names

CLOSED, OPEN = -1e-5, 1e-3
APART = 1e-9


@dataclass
class Inside:
    """A model's right-hand side at a state inside an active set."""

    code: dict[str, Any]
    x: NDArray
    jacobian: NDArray

    def growth(self, method: str, step: float, near: complex, steps: int = 200) -> float:
        """Return by how much, per step, the mode near an eigenvalue grows (its logarithm).

        The difference is measured by the left eigenvector, to which no other mode counts;
        only a few steps are taken where one of those is unstable itself, by rounding.
        """
        right, left = _nearest(self.jacobian, near), _nearest(self.jacobian.T, near)
        first, second = self.x.copy(), self.x + APART * right.real / np.abs(right).max()
        before = abs(left @ (second - first))
        advance = self.code[f"step_{method}"]
        for n in range(1, steps + 1):  # noqa: B007
            first, second = advance(0.0, step, first), advance(0.0, step, second)
            after = abs(left @ (second - first))
            if not 1e-3 < after / before < 1e3:
                break
        return float(np.log(after / before)) / n


def _nearest(matrix: NDArray, eigenvalue: complex) -> NDArray:
    """Return the eigenvector whose eigenvalue is nearest."""
    values, vectors = np.linalg.eig(matrix)
    return vectors[:, int(np.argmin(np.abs(values - eigenvalue)))]


def inside(model: nsode.Model, modes: tuple[tuple[str, str], ...]) -> Inside:
    """Return a model at a state where its elements do what ``modes`` say."""
    code = code_of(model, model.ode)
    scene = Scene(model.inclusion)
    x = np.zeros(code["NX"])
    x[: len(scene.state_names)] = _place(scene, dict(modes))
    _auxiliary(model, scene, code, x, dict(modes))
    assert observed(model, scene, code, x) == _plain(dict(modes))
    plain = code["rhs"]
    rest = plain(0.0, x)
    jacobian = np.array(
        [(plain(0.0, x + 1e-7 * e) - plain(0.0, x - 1e-7 * e)) / 2e-7 for e in np.eye(len(x))]
    ).T
    code["rhs"] = lambda t, at, u=code["u0"], p=code["p0"]: plain(0.0, at, u, p) - rest
    return Inside(code, x, jacobian)


def code_of(model: nsode.Model, ode: AugmentedODE) -> dict[str, Any]:
    """Return the names of the NumPy module that is emitted for an ODE."""
    code: dict[str, Any] = {}
    (text,) = emit("numpy", ode, Options()).values()
    exec(compile(text, model.name, "exec"), code)
    return code


def _place(scene: Scene, modes: dict[str, str]) -> NDArray:
    """Return the state nearest the start where gaps are closed or open, and nothing slides."""
    x = scene.start_state.copy()
    wanted = {r: 0.0 for e in scene.elements if not e.is_contact for r in e.rows}
    wanted |= {e.rows[0]: CLOSED for e in scene.elements if modes[e.name] == "contact"}
    opened = [e.rows[0] for e in scene.elements if modes[e.name] == "open"]
    for _ in range(20):
        local = scene.at(scene.point(x))
        low = [row for row in opened if local.argument[row] < OPEN / 2]
        wanted |= dict.fromkeys(low, OPEN)
        rows = list(wanted)
        missing = np.array([wanted[row] for row in rows]) - local.argument[rows]
        x = x + np.linalg.lstsq(local.slope[rows], missing, rcond=None)[0]
        if np.abs(missing).max(initial=0.0) < 1e-12:
            break
    return x


def _auxiliary(
    model: nsode.Model, scene: Scene, code: dict[str, Any], x: NDArray, modes: dict[str, str]
) -> None:
    """Set a of each friction: 0 where it sticks, thrice its limit where it slips."""
    names = element_names(model.ode.states)
    forces = _forces(model, code, x)
    loaded = np.zeros(sum(len(e.rows) for e in scene.elements))
    for element in scene.elements:
        if element.is_contact:
            loaded[element.rows[0]] = forces[element.name]
    local = scene.at(scene.point(x[: len(scene.state_names)]), loaded)
    for element in scene.elements:
        if element.is_contact or modes[element.name] == "stick":
            continue
        stiffness = scene.constants[element.number].stiffness
        limit = local.factor[element.number] / stiffness
        for tail, part in zip(
            _tails(element), _direction(modes[element.name], element), strict=True
        ):
            x[names.index(_internal(element, "a", tail))] = part * max(3.0 * limit, 1e-6)


def _direction(mode: str, element: Element) -> tuple[float, ...]:
    if mode == "free":
        return (1.0, *[0.0] * (len(element.rows) - 1))
    sign = 1.0 if "+" in mode else -1.0
    if len(element.rows) == 1:
        return (sign,)
    return (sign, 0.0) if mode.endswith("x") else (0.0, sign)


def _tails(element: Element) -> tuple[str, ...]:
    return ("",) if len(element.rows) == 1 else (".x", ".y")


def _internal(element: Element, letter: str, tail: str) -> str:
    """``F.a.x`` for F and ``F[3].a`` for the third of a family."""
    return f"{element.name}.{letter}{tail}"


def _forces(model: nsode.Model, code: dict[str, Any], x: NDArray) -> dict[str, float]:
    """Return the outputs of the emitted code, among them every force."""
    values = code["out"](0.0, x)
    return dict(zip(element_names(model.ode.outputs), values.tolist(), strict=True))


def observed(model: nsode.Model, scene: Scene, code: dict[str, Any], x: NDArray) -> dict[str, str]:
    """Return what each element does at a state, told by the rates of its auxiliary state."""
    names = element_names(model.ode.states)
    rates = dict(zip(names, code["rhs"](0.0, x), strict=True))
    states = dict(zip(names, x, strict=True))
    local = scene.at(scene.point(x[: len(scene.state_names)]))
    found = {}
    for element, given in zip(scene.elements, scene.constants, strict=True):
        if element.is_contact:
            e = _internal(element, "e", "")
            parts = np.isclose(rates[e], -states[e] / given.beta, rtol=1e-9, atol=1e-12)
            found[element.name] = "open" if parts else "contact"
        else:
            names_of = [_internal(element, "a", tail) for tail in _tails(element)]
            moving = np.array([rates[a] for a in names_of])
            sticks = np.allclose(moving, local.argument[list(element.rows)], atol=1e-9)
            found[element.name] = "stick" if sticks else "slip"
    return found


def _plain(modes: dict[str, str]) -> dict[str, str]:
    return {name: "slip" if m == "free" or m.startswith("slip") else m for name, m in modes.items()}
