"""What is said of a model on every compile and before every run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

import numpy as np

from nsode.analysis import looks
from nsode.analysis.late import late
from nsode.analysis.local import Local
from nsode.analysis.mass import feeding
from nsode.analysis.outset import UNDEFINED, at_start, places, unknown
from nsode.analysis.remarks import unresolved, unstable
from nsode.analysis.scene import Scene
from nsode.analysis.stability import bound, half_disc
from nsode.analysis.steps import Method, StableStep, reachable, stable_steps
from nsode.diagnostics import Diagnostic
from nsode.integrators import REGISTRY
from nsode.integrators.splittings import SPLITTINGS, Verlet
from nsode.ode import DifferentialInclusion

#: States and multipliers beyond which a step is not checked on every compile; a splitting
#: wants the eigenvalues of each set at each of many steps.
LARGE, LARGE_FOR_SPLITTINGS = 300, 60
#: What no explicit method takes, in steps of RK4.
_FARTHEST = 1e3
#: Active sets beyond which a compile searches among them instead.
FEW_SETS = 256


@dataclass(frozen=True, slots=True)
class Foreseen:
    """What is known of the step of a model.

    Attributes
    ----------
    diagnostics : tuple of Diagnostic
        NS402, NS407, NS409, NS412.
    limit : float, optional
        A step in seconds up to which the elements are stable, infinite where no step
        matters; None where it is not known.
    unknown : str, optional
        Why it is not known.
    varies : bool
        Whether the limit is that of the start only: W depends on the state, time or an input.
    """

    diagnostics: tuple[Diagnostic, ...] = ()
    limit: float | None = None
    unknown: str | None = None
    varies: bool = False


def warnings(inclusion: DifferentialInclusion) -> tuple[Diagnostic, ...]:
    """Return what every compile should say: NS402, NS407, NS409, NS412.

    Quick: it looks at the model's own method only, and at the sets only where a proven bound
    does not already allow the step. Large models are left out.
    """
    return foresee(inclusion).diagnostics


def _looked(
    scene: Scene, local: Local, load: list[float], scheme: Method, step: float
) -> StableStep | None:
    """Return the limit at a few states: of the method, or of RK4 where that is far exceeded.

    A splitting has none here, and Euler's leaves out what nothing damps.
    """
    usual = REGISTRY["rk4"]
    limit = None if isinstance(scheme, Verlet) else looks.limit(scene, local, load, scheme)
    if scheme == usual or (limit is not None and step > limit.found):
        return limit
    other = looks.limit(scene, local, load, usual)
    return limit if other is None or step <= _FARTHEST * other.found else other


@np.errstate(all="ignore")
def foresee(inclusion: DifferentialInclusion, margin: float = 1.0) -> Foreseen:
    """Return what is known of the model's own step with its own method.

    Parameters
    ----------
    margin : float, optional
        The limit is looked for only where the step is beyond this share of a proven bound.
    """
    if not inclusion.terms:
        return Foreseen(limit=inf)
    count = places(inclusion)
    method, step = inclusion.run.method or "rk4", inclusion.run.step
    if count > (LARGE_FOR_SPLITTINGS if method in SPLITTINGS else LARGE):
        many = f"{count:,} states and multipliers are too many to look at before each run"
        return Foreseen(unknown=many)
    scene = Scene(inclusion)
    begin = at_start(scene)
    if begin is None:
        return Foreseen(unknown=UNDEFINED)
    local, mass, load = begin
    found = (*feeding(scene, mass), *late(scene, local))
    schemes: Mapping[str, Method] = {**REGISTRY, **SPLITTINGS}
    if step is None or method not in schemes:
        return Foreseen(found, inf)
    scheme, why = schemes[method], unknown(scene, local)
    if why is not None:
        looked = _looked(scene, local, load, scheme, step)
        if looked is None:
            return Foreseen(found, unknown=why)
        said = unstable(inclusion, {method: looked})
        return Foreseen((*found, *said), unknown=f"{why}; a few states were looked at")
    if not isinstance(scheme, Verlet):
        fastest = bound(local, scene.elements, scene.constants)
        if step * fastest <= margin * half_disc(scheme):
            limit = half_disc(scheme) / fastest if fastest else inf
            return Foreseen((*found, *unresolved(scene, mass)), limit, varies=mass.varies)
    steps = stable_steps([reachable(scene, local, most=FEW_SETS)], {method: scheme})
    if method not in steps:
        return Foreseen(found, unknown="no active set has finite modes")
    said = unstable(inclusion, steps) or unresolved(scene, mass)
    return Foreseen((*found, *said), steps[method].found, varies=mass.varies)
