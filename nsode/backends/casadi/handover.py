"""Models of tools for optimal control, made from CasADi functions.

do-mpc is on the package index (``pip install 'nsode[do-mpc]'``). The ``acados_template`` of
acados is not: it comes with acados itself, so no release of it is tested against.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import casadi as ca

from nsode.backends.casadi.model import CasadiModel
from nsode.backends.numpy.names import python_names

if TYPE_CHECKING:
    from acados_template import AcadosModel
    from do_mpc.model import Model as DoMpcModel


def acados_model(model: CasadiModel) -> AcadosModel:
    """See :meth:`CasadiModel.acados`."""
    from acados_template import AcadosModel

    made = AcadosModel()
    made.name = model.name
    made.t, made.x, made.u, made.p = model.t, model.x, model.u, model.p
    made.xdot = ca.SX.sym("xdot", model.x.shape[0])
    made.f_expl_expr = model.dx
    made.f_impl_expr = made.xdot - model.dx
    made.x_labels, made.u_labels = list(model.x_names), list(model.u_names)
    return made


def do_mpc_model(model: CasadiModel) -> DoMpcModel:
    """See :meth:`CasadiModel.do_mpc`."""
    from do_mpc.model import Model

    made = Model("continuous", "SX")
    names = python_names((*model.x_names, *model.u_names, *model.p_names))
    x = [made.set_variable("_x", names[name]) for name in model.x_names]
    u = [made.set_variable("_u", names[name]) for name in model.u_names]
    p = [made.set_variable("_p", names[name]) for name in model.p_names]
    timed = bool(ca.depends_on(model.dx, model.t))
    t = made.set_variable("_tvp", "t") if timed else 0
    rates = model.rhs(t, ca.vertcat(*x), ca.vertcat(*u), ca.vertcat(*p))
    for k, name in enumerate(model.x_names):
        made.set_rhs(names[name], rates[k])
    made.setup()
    return made
