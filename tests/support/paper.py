"""The paper's equations (19), (27), (29), (37), (45) and (49), coded by hand.

Each takes the states and parameters by their names and returns the rates by name.
Numbers may be floats, arrays, or :class:`Term`, which carries the running term scale.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Values = Mapping[str, Any]
Rates = dict[str, Any]


@dataclass(frozen=True)
class Term:
    """A value and the magnitude of the terms that it was made of."""

    value: NDArray
    scale: NDArray

    def __add__(self, other: Any) -> Term:
        other = term(other)
        return Term(self.value + other.value, self.scale + other.scale)

    def __sub__(self, other: Any) -> Term:
        other = term(other)
        return Term(self.value - other.value, self.scale + other.scale)

    def __rsub__(self, other: Any) -> Term:
        return term(other) - self

    def __mul__(self, other: Any) -> Term:
        other = term(other)
        return Term(self.value * other.value, self.scale * other.scale)

    def __truediv__(self, other: Any) -> Term:
        other = term(other)
        return Term(
            self.value / other.value, self.scale * other.scale / np.square(np.abs(other.value))
        )

    def __neg__(self) -> Term:
        return Term(-self.value, self.scale)

    __radd__ = __add__
    __rmul__ = __mul__

    def __pow__(self, k: int) -> Term:
        return Term(self.value**k, self.scale**k)


def term(value: Any) -> Term:
    """Return a plain number with its own magnitude as scale."""
    return value if isinstance(value, Term) else Term(np.asarray(value), np.abs(value))


def maximum(a: Any, b: Any) -> Any:
    if isinstance(a, Term) or isinstance(b, Term):
        a, b = term(a), term(b)
        return Term(np.maximum(a.value, b.value), np.maximum(a.scale, b.scale))
    return np.maximum(a, b)


def magnitude(a: Any) -> Any:
    return Term(np.abs(a.value), a.scale) if isinstance(a, Term) else np.abs(a)


def sat(level: Any, x: list[Any]) -> list[Any]:
    """Return the paper's (2) for a vector of any length."""
    if not isinstance(level, Term):
        n = np.sqrt(sum(c * c for c in x))
        return [np.where(n > level, level * c / np.where(n > 0, n, 1), c) for c in x]
    n = np.sqrt(sum(c.value**2 for c in x))
    wide = np.sqrt(sum(c.scale**2 for c in x))
    out = n > level.value
    safe = np.where(n > 0, n, 1)
    return [
        Term(
            np.where(out, level.value * c.value / safe, c.value),
            # the direction c/n inherits the relative error of both c and n
            np.where(out, (level.scale + level.value * wide / safe) * c.scale / safe, c.scale),
        )
        for c in x
    ]


def dio_force(K: Any, alpha: Any, beta: Any, e: Any, psi: Any) -> Any:
    """Return (25)."""
    return K * maximum(0, e - beta * (psi + e) / alpha)


def dio_rate(alpha: Any, beta: Any, e: Any, psi: Any) -> Any:
    """Return (24)."""
    return maximum(-e / beta, -(psi + e) / alpha)


def sgn_force(chi: Any, K: Any, beta: Any, a: list[Any], theta: list[Any]) -> list[Any]:
    """Return (18b)."""
    moved = [ai + beta * ti for ai, ti in zip(a, theta, strict=True)]
    return [K * s for s in sat(chi / K, moved)]


def sgn_rate(force: list[Any], K: Any, beta: Any, a: list[Any]) -> list[Any]:
    """Return (18a), with the force of (18b) in it."""
    return [(f / K - ai) / beta for f, ai in zip(force, a, strict=True)]


def load(t: float) -> float:
    """Return the external force of (20)."""
    return min(0.52, 0.8 * t) if t < 2 else 0.336 + 0.144 * np.cos(100 * t)


def dry_friction(t: float, x: Values, p: Values) -> Rates:
    """Return (19) under the load (20)."""
    (f,) = sgn_force(p["F0"], p["F.K"], p["F.beta"], [x["F.a"]], [x["v"]])
    (a,) = sgn_rate([f], p["F.K"], p["F.beta"], [x["F.a"]])
    rise = np.minimum if not isinstance(p["top"], Term) else _least
    early, late = rise(p["top"], p["ramp"] * t), p["mean"] + p["swing"] * _cos(p["omega"] * t)
    return {"v": ((early if t < 2 else late) - f) / p["M"], "p": x["v"], "F.a": a}


def _least(a: Any, b: Any) -> Any:
    return -maximum(-term(a), -term(b))


def _cos(a: Any) -> Any:
    # the slope of cos is at most 1, so an error of the angle comes through whole
    return Term(np.cos(a.value), 1 + a.scale) if isinstance(a, Term) else np.cos(a)


def bouncing_mass(t: float, x: Values, p: Values) -> Rates:
    """Return (27)."""
    constants = p["f.K"], p["f.alpha"], p["f.beta"]
    f = dio_force(*constants, x["f.e"], x["p"])
    e = dio_rate(*constants[1:], x["f.e"], x["p"])
    return {"v": (p["fe"] + f) / p["M"], "p": x["v"], "f.e": e}


def _floor_contact(x: Values, p: Values, psi: Any, theta: list[Any]) -> tuple[Any, list, Rates]:
    normal = p["N.K"], p["N.alpha"], p["N.beta"]
    fz = dio_force(*normal, x["N.e"], psi)
    a = [x["F.a.x"], x["F.a.y"]]
    fxy = sgn_force(p["mu"] * fz, p["F.K"], p["F.beta"], a, theta)
    rate = sgn_rate(fxy, p["F.K"], p["F.beta"], a)
    rates = {"N.e": dio_rate(*normal[1:], x["N.e"], psi), "F.a.x": rate[0], "F.a.y": rate[1]}
    return fz, fxy, rates


def frictional_contact(t: float, x: Values, p: Values) -> Rates:
    """Return (29) with (30)."""
    fz, fxy, rates = _floor_contact(x, p, x["p.z"], [x["v.x"], x["v.y"]])
    return rates | {
        "p.x": x["v.x"], "p.y": x["v.y"], "p.z": x["v.z"],
        "v.x": -fxy[0] / p["M"], "v.y": -fxy[1] / p["M"], "v.z": fz / p["M"],
    }  # fmt: skip


def rolling_sphere(t: float, x: Values, p: Values) -> Rates:
    """Return (37) with (34), (35) and (36)."""
    R, M = p["R"], p["M"]
    v = [x["v.x"] - x["w.y"] * R, x["v.y"] + x["w.x"] * R]
    psi, theta, rates = _floor_contact(x, p, x["p.z"] - R, v)
    factor = term(5) / (2 * M * R**2) if isinstance(M, Term) else 5 / (2 * M * R**2)
    # d x [-theta; psi] with d = (0, 0, -R)
    wx, wy, wz = x["w.x"], x["w.y"], x["w.z"]
    q1, q2, q3, q4 = (x[f"q[{k}]"] for k in (1, 2, 3, 4))
    return rates | {
        "p.x": x["v.x"], "p.y": x["v.y"], "p.z": x["v.z"],
        "v.x": -theta[0] / M, "v.y": -theta[1] / M, "v.z": psi / M - p["g"],
        "w.x": factor * (-(R * theta[1])), "w.y": factor * (R * theta[0]), "w.z": 0 * wz,
        "q[1]": 0.5 * (-(wx * q2) - wy * q3 - wz * q4),
        "q[2]": 0.5 * (wx * q1 + wy * q4 - wz * q3),
        "q[3]": 0.5 * (wy * q1 + wz * q2 - wx * q4),
        "q[4]": 0.5 * (wz * q1 + wx * q3 - wy * q2),
    }  # fmt: skip


def two_blocks_conveyor(t: float, x: Values, p: Values) -> Rates:
    """Return (45) with (39) to (44)."""
    gaps = [x["p1.x"], x["p2.x"] - x["p1.x"], x["p2.y"]]
    slips = [x["v1.y"], x["v1.y"] - x["v2.y"], x["v2.x"] + p["u"]]
    psi, theta, rates = [], [], {}
    for k in (1, 2, 3):
        K, alpha, beta = p[f"N{k}.K"], p[f"N{k}.alpha"], p[f"N{k}.beta"]
        e, gap = x[f"N{k}.e"], gaps[k - 1]
        psi.append(dio_force(K, alpha, beta, e, gap))
        rates[f"N{k}.e"] = dio_rate(alpha, beta, e, gap)
    for k in (1, 2, 3):
        K, beta, a = p[f"F{k}.K"], p[f"F{k}.beta"], [x[f"F{k}.a"]]
        force = sgn_force(p[f"mu{k}"] * psi[k - 1], K, beta, a, [slips[k - 1]])
        theta += force
        (rates[f"F{k}.a"],) = sgn_rate(force, K, beta, a)
    M1, M2 = p["M1"], p["M2"]
    return rates | {
        "p1.x": x["v1.x"], "p1.y": x["v1.y"], "p2.x": x["v2.x"], "p2.y": x["v2.y"],
        "v1.x": (psi[0] - psi[1]) / M1,
        "v1.y": (-(p["Ks"] * x["p1.y"]) - theta[0] - theta[1]) / M1,
        "v2.x": (-theta[2] + psi[1]) / M2,
        "v2.y": (theta[1] + psi[2]) / M2 - p["g"],
    }  # fmt: skip


def belt_oscillator(t: float, x: Values, p: Values) -> Rates:
    """Return (49)."""
    pos, w = x["p"], x["w"]
    K, beta, a = p["Fc.K"], p["Fc.beta"], x["Fc.a"]
    chi = p["F"] / (p["V"] + magnitude(w))
    (s,) = sat(chi, [K * a + K * beta * w])
    (sa,) = sat(chi / K, [a + beta * w])
    return {
        "p": p["u"] - w,
        "w": (p["k2"] * pos**3 - p["k1"] * pos - s) / p["M"],
        "Fc.a": sa / beta - a / beta,
    }


#: Each model of the paper with its equations.
EQUATIONS: dict[str, Callable[[float, Values, Values], Rates]] = {
    "dry_friction": dry_friction,
    "bouncing_mass": bouncing_mass,
    "frictional_contact": frictional_contact,
    "rolling_sphere": rolling_sphere,
    "two_blocks_conveyor": two_blocks_conveyor,
    "belt_oscillator": belt_oscillator,
}
