"""CasADi's import of an FMU: how it is asked for what the case compares."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io import extracted
from validation.importers.exported import Exported

Array = NDArray[np.float64]


def imported(exported: Exported, fmi: int) -> Any:
    """The DaeBuilder, with the inputs in force before CasADi initialises, and the compared variables as outputs."""
    import casadi as ca

    dae = ca.DaeBuilder("imported", str(extracted(exported.build(fmi))))
    for name, value in exported.inputs.items():
        dae.set(name, value)
    for name in exported.outputs:
        if name not in dae.y():
            dae.set_causality(name, "output")
    return dae


def integrated(exported: Exported, fmi: int) -> Array:
    """Outputs (n_t, n_outputs) by its CVODES, from the states that the FMU itself begins with."""
    import casadi as ca

    dae = imported(exported, fmi)
    inputs = ca.DM([exported.inputs[name] for name in dae.u()])
    begin = dae.create("begin", ["u"], ["x"])(inputs)
    right = dae.create("right", ["t", "x", "u"], ["ode", "y"])
    t, x, u = ca.MX.sym("t"), ca.MX.sym("x", begin.numel()), ca.MX.sym("u", inputs.numel())
    problem = {"t": t, "x": x, "u": u, "ode": right(t, x, u)[0]}
    run = ca.integrator("run", "cvodes", problem, 0.0, list(exported.times), {"reltol": 1e-8, "abstol": 1e-8})
    states = run(x0=begin, u=inputs)["xf"]
    rows = [np.array(right(time, states[:, k], inputs)[1]).ravel() for k, time in enumerate(exported.times)]
    return np.array(rows)[:, [dae.y().index(name) for name in exported.outputs]]
