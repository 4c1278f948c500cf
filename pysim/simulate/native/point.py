"""The model as a function: derivatives at a point, and whether they can be used."""

from __future__ import annotations

import math
from typing import Any

from pysim.simulate.native.compiled import doubles, native
from pysim.simulate.native.fmu_calls import WARNING, get_derivatives, set_states, set_time
from pysim.simulate.native.inputs import set_inputs


@native
def set_point(job: Any, t: float, x: int) -> int:
    """Move the FMU to time t (s) and the states at address x, with the inputs of that time; the worst status."""
    status = set_time(job.fmu, t)
    status = max(status, set_states(job.fmu, x, job.work.n))
    return max(status, set_inputs(job, t))


@native
def evaluate(job: Any, t: float, x: int, dx: int) -> int:
    """Derivatives to address dx at time t (s) and the states at address x; the worst status."""
    job.run.derivatives += 1
    status = set_point(job, t, x)
    return status if status > WARNING else max(status, get_derivatives(job.fmu, dx, job.work.n))


@native
def copy(source: int, target: int, n: int) -> None:
    """target = source, n doubles."""
    a, b = doubles(source), doubles(target)
    for i in range(n):
        b[i] = a[i]


@native
def all_finite(values: int, n: int) -> bool:
    """Whether n doubles are all finite."""
    a = doubles(values)
    total = 0.0
    for i in range(n):
        total += 0.0 * a[i]  # NaN or infinity times zero is NaN, which stays
    return total == 0.0


@native
def error_norm(job: Any, values: int, x: int, y: int) -> float:
    """Root mean square of n values over what is tolerated between the states x and y; 1 is just accepted."""
    v, a, b, nominal = doubles(values), doubles(x), doubles(y), doubles(job.work.nominal)
    rtol, atol, n = job.control.rtol, job.control.atol, job.work.n
    total = 0.0
    for i in range(n):
        ratio = v[i] / (atol * nominal[i] + rtol * max(abs(a[i]), abs(b[i])))
        total += ratio * ratio
    return math.sqrt(total / max(n, 1))
