"""The model as a function: derivatives at a point, and whether they can be used."""

from __future__ import annotations

import math
from typing import Any

from pysim.simulate._fmu_calls import WARNING, get_derivatives, set_states, set_time
from pysim.simulate._inputs import set_inputs
from pysim.simulate._native import inlined, native


@inlined
def set_point(fmu: Any, inputs: Any, run: Any, t: float, x: Any) -> int:
    """Move the FMU to time t (s) and states x (n,), with the inputs of that time; the worst status."""
    status = set_time(fmu, t)
    status = max(status, set_states(fmu, x))
    return max(status, set_inputs(fmu, inputs, t, run.horizon))


@inlined
def evaluate(fmu: Any, inputs: Any, run: Any, t: float, x: Any, dx: Any) -> int:
    """dx (n,) at time t (s) and states x (n,); the worst status."""
    run.derivatives += 1
    status = set_point(fmu, inputs, run, t, x)
    return status if status > WARNING else max(status, get_derivatives(fmu, dx))


@native
def all_finite(a: Any) -> bool:
    total = 0.0
    for i in range(a.size):
        total += 0.0 * a[i]  # NaN or infinity times zero is NaN, which stays
    return total == 0.0


@native
def error_norm(control: Any, work: Any) -> float:
    """Root mean square of work.error over what is tolerated; 1 is just accepted."""
    n = work.error.size
    total = 0.0
    for i in range(n):
        size = max(abs(work.x[i]), abs(work.x_new[i]))
        ratio = work.error[i] / (control.atol * work.nominal[i] + control.rtol * size)
        total += ratio * ratio
    return math.sqrt(total / max(n, 1))
