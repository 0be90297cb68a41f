"""What a person holds: functions, symbols, names and defaults."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import casadi as ca
    from acados_template import AcadosModel
    from do_mpc.model import Model as DoMpcModel


@dataclass(frozen=True, slots=True, eq=False)
class CasadiModel:
    """An augmented ODE as CasADi functions of ``SX``, with named inputs and outputs.

    Attributes
    ----------
    rhs, out
        ``rhs(t, x, u, p) -> dx`` and ``out(t, x, u, p) -> y``.
    step
        ``step(t, h, x, u, p) -> x_next``, one step of an explicit Runge-Kutta method.
        Unlike the C it leaves tiny magnitudes as they are, so that it stays smooth. Many
        steps in one function, the states after each of them in a column:
        ``run = model.step.mapaccum("run", n, ["x"], ["x_next"])``, and
        ``run(h*np.arange(n), h, model.x0, model.u0, model.p0)``; ``u`` and ``p`` may have a
        column for each step.
    init
        ``init(u, p) -> x``, the states at the start.
    t, x, u, p, dx, y
        The symbols, and rates and outputs as expressions of them.
    x0, u0, p0
        Defaults; NaN where the model gives none.
    """

    name: str
    rhs: ca.Function
    out: ca.Function
    step: ca.Function
    init: ca.Function
    t: ca.SX
    x: ca.SX
    u: ca.SX
    p: ca.SX
    dx: ca.SX
    y: ca.SX
    x_names: tuple[str, ...]
    u_names: tuple[str, ...]
    p_names: tuple[str, ...]
    y_names: tuple[str, ...]
    u0: NDArray[np.float64]
    p0: NDArray[np.float64]

    @property
    def x0(self) -> NDArray[np.float64]:
        """The states at the start, by the default parameters."""
        return np.asarray(self.init(self.u0, self.p0), dtype=float).reshape(-1)

    def dae(self) -> dict[str, ca.SX]:
        """Return what ``casadi.integrator(name, solver, dae, t0, times)`` takes.

        Call the integrator with ``x0=model.x0, p=model.p0`` and, where the model has
        inputs, ``u=model.u0`` or one column for each interval of ``times``.
        """
        inputs = {"u": self.u} if self.u_names else {}
        return {"t": self.t, "x": self.x, "p": self.p, "ode": self.dx, **inputs}

    def do_mpc(self) -> DoMpcModel:
        """Return a continuous do-mpc model that is set up; needs do-mpc.

        States, inputs and parameters have their names as Python identifiers (``N.K`` is
        ``N_K``); a model that reads the time has it as the time-varying parameter ``t``.
        """
        from nsode.backends.casadi.handover import do_mpc_model

        return do_mpc_model(self)

    def acados(self) -> AcadosModel:
        """Return an ``AcadosModel``: explicit and implicit dynamics; needs acados.

        Set ``ocp.parameter_values = model.p0``.
        """
        from nsode.backends.casadi.handover import acados_model

        return acados_model(self)
