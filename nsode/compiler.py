"""The driver, and the model that people hold."""

from __future__ import annotations

import gc
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from nsode.backends import Options
from nsode.backends import emit as emit_target
from nsode.diagnostics import Diagnostic, ModelError
from nsode.files import write_generated
from nsode.inclusion.build import build
from nsode.integrators import REGISTRY
from nsode.integrators.pairs import PAIRS
from nsode.integrators.splittings import SPLITTINGS
from nsode.limits import DEFAULT_LIMITS, Limits
from nsode.ode import AugmentedODE, DifferentialInclusion, Run, element_names
from nsode.regularizations import Kind
from nsode.rewrite import rewrite
from nsode.rewrite.start import at_start, initial_state, pressed_at_start
from nsode.rewrite.switch import with_laws
from nsode.source import Source
from nsode.syntax import decode, parse, read

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from nsode.analysis import Analysis
    from nsode.backends.casadi.model import CasadiModel
    from nsode.backends.sympy import SymbolicSystem
    from nsode.explain import Explanation
    from nsode.simulate import Trajectory
    from nsode.simulate.inputs import Signal
    from nsode.simulate.parameters import Value


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """A compiled model.

    ``inclusion`` is the differential inclusion in normal form, ``ode`` its augmented
    ODE, ``diagnostics`` the warnings and notes that it drew, ``limits`` what it may take.
    """

    inclusion: DifferentialInclusion
    ode: AugmentedODE
    diagnostics: tuple[Diagnostic, ...]
    limits: Limits = DEFAULT_LIMITS

    @property
    def name(self) -> str:
        """The name of the model, an identifier."""
        return self.ode.name

    @property
    def source(self) -> Source:
        """The text that the model was compiled from."""
        return self.ode.source

    @property
    def x_names(self) -> tuple[str, ...]:
        """The names of the states, auxiliary ones last; also the order of ``x0``."""
        return tuple(element_names(self.ode.states))

    @property
    def u_names(self) -> tuple[str, ...]:
        """The names of the inputs."""
        return tuple(element_names(self.ode.inputs))

    @property
    def p_names(self) -> tuple[str, ...]:
        """The names of the parameters, constants of the laws last; the order of ``p0``."""
        return tuple(element_names(self.ode.parameters))

    @property
    def y_names(self) -> tuple[str, ...]:
        """The names of the outputs: the declared ones, then every force."""
        return tuple(element_names(self.ode.outputs))

    @property
    def x0(self) -> NDArray[np.float64]:
        """The states at the start, shape (NX,), in SI; NaN where a constant is missing."""
        import numpy as np

        return np.array(initial_state(self.ode))

    @property
    def p0(self) -> NDArray[np.float64]:
        """The parameters, shape (NP,), in SI: the model's own, then the constants."""
        import numpy as np

        return np.array([value for p in self.ode.parameters for value in p.values])

    def with_parameters(self, values: Mapping[str, Value]) -> Model:
        """Return the model with other parameters, as ``{"N.K": 1e6, "mu": 0.2}``.

        Constants that are formulas of what changed follow.

        Raises
        ------
        ModelError
            NS101 for an unknown name, NS307 for a value that breaks what was proved
            with the old one, NS501 for one that is not finite.
        """
        from nsode.simulate.parameters import replaced

        ode = replaced(self.ode, values)
        own = tuple(p for p in ode.parameters if p.constant_of is None)
        return replace(self, inclusion=replace(self.inclusion, parameters=own), ode=ode)

    def with_law(self, *, friction: str | None = None, contact: str | None = None) -> Model:
        """Return the model with other published laws for its friction and contact.

        K keeps its value, and a damper B is K*beta. Other constants have the defaults of
        their law or no value: see the model's ``p0``, and :meth:`with_parameters`.

        Parameters
        ----------
        friction
            The law for every ``sgn``: ``xiong2013``, ``lugre`` or ``smoothing``.
        contact
            The law for every ``dio``: ``xiong2013``, ``kelvin_voigt``,
            ``clipped_kelvin_voigt`` or ``hunt_crossley``.

        Raises
        ------
        ModelError
            NS306 for a name that is no such law, or a term that it cannot represent.
        """
        chosen: dict[Kind, str] = {}
        if friction is not None:
            chosen["sgn"] = friction
        if contact is not None:
            chosen["dio"] = contact
        if not chosen:
            return self
        earlier = _remarks(self.inclusion, self.ode)
        try:
            inclusion = with_laws(self.inclusion, self.ode.parameters, chosen)
            ode = rewrite(inclusion)
            lasting = (d for d in self.diagnostics if d not in earlier)
            return Model(inclusion, ode, (*lasting, *_remarks(inclusion, ode)), self.limits)
        except ModelError as error:
            raise ModelError(error.diagnostics, self.source) from None

    def emit(self, target: str, options: Options = Options()) -> dict[str, str]:
        """Return the files of a target by name, without writing them.

        Raises
        ------
        ValueError
            If there is no such target; the message names all.
        """
        with _without_collector():
            return emit_target(target, self.ode, options)

    def compile(self, target: str, folder: str | Path, options: Options = Options()) -> list[Path]:
        """Write the files of a target into ``folder``, all of them or none.

        Parameters
        ----------
        target
            ``c``, ``numpy``, ``casadi``, ``latex`` or ``markdown``.
        folder
            Made if need be.
        options
            The prefix of names, and whether the C computes in double or float.

        Returns
        -------
        list of Path
            The files written.

        Raises
        ------
        OSError
            If they cannot be written, or would replace a file that nsode did not write;
            nothing half written stays behind.
        """
        return write_generated(self.emit(target, options), Path(folder))

    def only(self, outputs: Sequence[str]) -> Model:
        """Return the model with just some outputs and the states that they depend on.

        Raises
        ------
        ModelError
            NS101 for an output or a state that there is not.
        """
        from nsode.passes.prune import prune

        return replace(self, ode=prune(self.ode, outputs))

    def with_ledger(self) -> Model:
        """Return the model with the energy of each element as further outputs.

        ``N.stored`` in J, ``N.dissipated`` and ``N.given`` in W; see
        :mod:`nsode.analysis.energy`.
        """
        from nsode.analysis.energy import ledger

        return replace(self, ode=ledger(self.ode, self.inclusion))

    def baked(self, values: Mapping[str, float]) -> Model:
        """Return the model with some parameters as numbers, for good.

        Raises
        ------
        ModelError
            As :meth:`with_parameters`; NS101 for a name that is no scalar parameter.
        """
        from nsode.passes.bake import bake

        chosen = self.with_parameters(values)
        return replace(chosen, ode=bake(chosen.ode, values))

    def casadi(self, method: str = "rk4") -> CasadiModel:
        """Return CasADi functions ``rhs``, ``out``, ``step`` and ``init``; needs casadi.

        ``step`` is one step of ``method``, an explicit Runge-Kutta method by name. What is
        returned goes on to ``casadi.integrator``, do-mpc and acados.
        """
        from nsode.backends.casadi import functions

        return functions(self.ode, method)

    def sympy(self) -> SymbolicSystem:
        """Return the augmented ODE as SymPy objects, and W; needs sympy."""
        from nsode.analysis.formulas import symbolic_mass
        from nsode.backends.sympy import system

        found = system(self.ode)
        names, W = symbolic_mass(self.inclusion, found.symbols)
        return replace(found, multipliers=names, W=W)

    def analyze(
        self,
        *,
        along: Iterable[Sequence[float]] = (),
        impact_speed: float | None = None,
    ) -> Analysis:
        """Return what is known before a run: W, stable steps, restitution, energy.

        Parameters
        ----------
        along
            States, such as the rows of a run, at which the steps are looked at too.
        impact_speed
            In m/s; the first impact from the start unless given.
        """
        from nsode.analysis import analyze

        return analyze(
            self.inclusion, self.ode, along=along, impact_speed=impact_speed, limits=self.limits
        )

    def explain(self) -> Explanation:
        """Return how the inclusion becomes the ODE, step by step; a notebook shows it typeset."""
        from nsode.explain import explain

        return explain(self.inclusion, self.ode)

    def _repr_mimebundle_(
        self, include: Container[str] | None = None, exclude: Container[str] | None = None
    ) -> dict[str, str]:
        return self.explain()._repr_mimebundle_(include, exclude)

    def __repr__(self) -> str:
        return (
            f"<nsode.Model {self.name}: {len(self.ode.states)} states, "
            f"{len(self.inclusion.terms)} set-valued terms>"
        )

    def simulate(
        self,
        duration: float | None = None,
        step: float | None = None,
        *,
        every: int | None = None,
        method: str | None = None,
        parameters: Mapping[str, Value] | None = None,
        inputs: Mapping[str, Signal] | None = None,
        x0: Mapping[str, float] | None = None,
        start: float = 0.0,
        tolerance: float | None = None,
        strict: bool = False,
        guard: bool = True,
    ) -> Trajectory:
        """Run the model as compiled C and return what happened.

        Parameters
        ----------
        duration, step
            In seconds; as the model's ``simulate`` says unless given.
        every
            Steps from one stored row to the next.
        method
            The name of an integrator.
        parameters, x0
            Values for this run by name, in SI: parameters, and states at the start.
        inputs
            By name: a number, recorded ``(times, values)``, or a function of an array of
            times. Values are read at the start of a step and held over it.
        start
            The time at which the run starts.
        tolerance
            The relative error of a step, for a method that chooses its own; ``step`` is
            then the grid on which inputs are read and rows may lie.
        strict
            Refuse what would draw a warning before the run.
        guard
            Stop where energy comes from nothing.

        Raises
        ------
        ModelError
            Before the run, if it cannot be made.
        RunError
            If it goes wrong; ``error.trajectory`` holds the rows before that.
        """
        from nsode.simulate import Manner, Wish, simulate

        return simulate(
            self.inclusion,
            self.ode,
            Wish(duration, step, every, method, start, tolerance),
            overrides=parameters,
            signals=inputs,
            start=x0,
            manner=Manner(strict=strict, guard=guard, limits=self.limits),
        )


def load(path: str | Path, *, limits: Limits = DEFAULT_LIMITS) -> Model:
    """Compile the model in a file; ``limits`` say how large it may be.

    Raises
    ------
    ModelError
        If the file cannot be read or the model is refused.
    """
    return compile_source(read(Path(path), limits), limits)


def loads(text: str | bytes, name: str = "<string>", *, limits: Limits = DEFAULT_LIMITS) -> Model:
    """Compile a model from its text; ``limits`` say how large it may be.

    Raises
    ------
    ModelError
        If the model is refused.
    """
    data = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    return compile_source(decode(name, data, limits), limits)


def compile_source(source: Source, limits: Limits = DEFAULT_LIMITS) -> Model:
    """Compile a model from its source; ``limits`` say how large it may be.

    Raises
    ------
    ModelError
        If the model is refused; it names the source.
    """
    with _without_collector():
        try:
            inclusion, diagnostics = build(parse(source, limits), limits)
            _check_method(inclusion.run)
            ode = rewrite(inclusion)
            return Model(inclusion, ode, (*diagnostics, *_remarks(inclusion, ode)), limits)
        except ModelError as error:
            raise ModelError(error.diagnostics, source) from None


def _check_method(run: Run) -> None:
    """Refuse a method that there is not; its own are known without waiting for what runs them."""
    if run.method not in (None, *REGISTRY, *SPLITTINGS, *PAIRS):
        from nsode.simulate.settings import check_method

        check_method(run)


def _remarks(inclusion: DifferentialInclusion, ode: AugmentedODE) -> tuple[Diagnostic, ...]:
    """Return what is to be said of a model under its laws."""
    from nsode.analysis import warnings

    pressed = pressed_at_start(inclusion.terms, ode)
    return (*at_start(ode), *pressed, *warnings(inclusion))


@contextmanager
def _without_collector() -> Iterator[None]:
    # Trees hold no cycles; walking a million live nodes again and again costs a third.
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
