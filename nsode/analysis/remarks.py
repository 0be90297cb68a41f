"""What is said of the step of a model: unstable, or too long for its impacts."""

from __future__ import annotations

import math
from collections.abc import Mapping

from nsode.analysis.bounces import Stepper, gate, speeds
from nsode.analysis.elements import degree, inverse_mass
from nsode.analysis.mass import EffectiveMass
from nsode.analysis.report import active_text
from nsode.analysis.restitution import mapped_restitution
from nsode.analysis.scene import Scene
from nsode.analysis.steps import StableStep
from nsode.diagnostics import Diagnostic, Label
from nsode.integrators import REGISTRY
from nsode.integrators.splittings import SPLITTINGS
from nsode.ode import DifferentialInclusion

#: Error of a speed after an impact, as a share of that before, which is worth a note.
NOTABLE = 0.05
_LOOKS = 4  # contacts, each unlike the others, whose impacts are computed


def unresolved(scene: Scene, mass: EffectiveMass) -> list[Diagnostic]:
    """Return NS409 where a whole step is too long for the impacts of a contact.

    It is a note, and a warning where more speed may come back than went in.
    """
    run = scene.inclusion.run
    scheme = {**REGISTRY, **SPLITTINGS}.get(run.method or "rk4")
    if run.step is None or not isinstance(scheme, Stepper):
        return []
    coarse: dict[tuple[str, float], str] = {}
    for element, given in zip(scene.elements, scene.constants, strict=True):
        if not (element.is_contact and given.known and degree(element, mass) == 2):
            continue
        frequency = math.sqrt(given.stiffness * max(0.0, inverse_mass(element, mass)))
        if gate(scheme) < run.step * frequency < math.inf:
            coarse.setdefault((element.term.name, float(f"{frequency:.3g}")), element.name)
    stiffest = sorted(coarse.items(), key=lambda item: -item[0][1])[:_LOOKS]
    constants = {e.name: c for e, c in zip(scene.elements, scene.constants, strict=True)}
    found: list[Diagnostic] = []
    for (_, frequency), name in stiffest:
        given = constants[name]
        ratio, kappa = given.beta / given.alpha, given.alpha * frequency
        exact = mapped_restitution(ratio, kappa)
        least, most = speeds(scheme, run.step * frequency, ratio, kappa)
        if not (exact - least <= NOTABLE and most - exact <= NOTABLE):
            found.append(_unresolved(scene, name, frequency, (exact, least, most)))
    return found


def _unresolved(
    scene: Scene, name: str, frequency: float, restitution: tuple[float, float, float]
) -> Diagnostic:
    exact, least, most = restitution
    run = scene.inclusion.run
    term = next(e.term for e in scene.elements if e.name == name)
    seen = f"of the speed before, {least:.3g} to {most:.3g} comes back"
    why = f"it depends on where in a step the contact begins; {exact:.3g} is exact"
    gains = most > 1.0
    return Diagnostic(
        "NS409",
        f"a step of {run.step:g} s does not resolve the impacts of `{name}`: {seen}",
        (Label(term.span, "this term"),),
        notes=(why, "more than all of it is energy from nothing") if gains else (why,),
        help=f"take a step of at most {_below(0.3 / frequency)} {{s}}, or lower `{term.name}.K`",
        severity="warning" if gains else "note",
    )


def unstable(inclusion: DifferentialInclusion, steps: Mapping[str, StableStep]) -> list[Diagnostic]:
    """Return a warning where the model's own step is beyond its method's limit."""
    method, chosen = inclusion.run.method or "rk4", inclusion.run.step
    limit = steps.get(method)
    if chosen is None or limit is None:
        return []
    if chosen > limit.found:
        return [_beyond(inclusion, limit, chosen)]
    if limit.own is not None and 0 < limit.own < chosen:
        return [_beyond_own(inclusion, limit.own, chosen)]
    return []


def _beyond(inclusion: DifferentialInclusion, limit: StableStep, chosen: float) -> Diagnostic:
    mode = f"a mode of {limit.frequency:.4g} rad/s with damping ratio {limit.damping:.2g}"
    where = active_text(limit.modes) or "no element active"
    told = f"the step {chosen:g} s is beyond what {limit.method} can take: {limit.found:.3g} s"
    ways = ["choose another method, such as rk4"]
    if limit.found > 0:
        ways = [f"take a step of at most {_below(limit.found)} {{s}}"]
    else:
        told = f"{limit.method} can take no step: it feeds what nothing damps"
    for constant, power in limit.change[:1]:
        ways.append(f"{'lower' if power < 0 else 'raise'} `{constant}`")
    return Diagnostic(
        "NS407",
        told,
        (Label(inclusion.run.span, "where this set occurs, finite and wrong"),),
        notes=(f"the limit is set by {mode}, while {where}",),
        help=", or ".join(ways),
        severity="warning",
    )


def _beyond_own(inclusion: DifferentialInclusion, own: float, chosen: float) -> Diagnostic:
    method = inclusion.run.method or "rk4"
    return Diagnostic(
        "NS407",
        f"the step {chosen:g} s is beyond what {method} can take: {own:.3g} s",
        (Label(inclusion.run.span, "finite and wrong, or not even finite"),),
        notes=("the limit is set by the model's own equations, not by its approximation",),
        help=f"take a step of at most {_below(own)} {{s}}",
        severity="warning",
    )


def _below(step: float) -> str:
    """Return the step with two digits, rounded down."""
    power = 10.0 ** (math.floor(math.log10(step)) - 1)
    return f"{math.floor(step / power * (1 + 1e-12)) * power:.2g}"
