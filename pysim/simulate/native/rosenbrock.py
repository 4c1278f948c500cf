"""Rosenbrock steps: linearly implicit, for stiff models."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import doubles, native
from pysim.simulate.native.elimination import factorise_shifted, solve_shifted
from pysim.simulate.native.explicit import combine, estimate
from pysim.simulate.native.fmu_calls import OK, WARNING
from pysim.simulate.native.jacobian import take_jacobian
from pysim.simulate.native.point import copy, error_norm, evaluate
from pysim.simulate.native.vector import add_rows

_SLOPE_STEP = 1e-6  # of the step: a compromise between curvature and rounding, both of which a stiff model enlarges


@native
def attempt_rosenbrock(job: Any, h: float) -> tuple[int, float]:
    """One step of length h (s): fills k and x_new; the worst status and the error norm."""
    run, work, method = job.run, job.work, job.method
    status = OK
    if run.jacobian_at != run.t:
        status = _linearise(job, h)
    if status > WARNING or not factorise_shifted(job, 1.0 / (h * method.gamma)):
        return status, np.nan
    for i in range(method.stages):
        status = _stage(job, i, h)
        if status > WARNING:
            return status, np.nan
    combine(job, method.b, method.stages, 1.0, work.x_new)
    estimate(job, method.stages, 1.0)
    return OK, error_norm(job, work.error, work.x, work.x_new)


@native
def _linearise(job: Any, h: float) -> int:
    """Jacobian and slope at run.t; they serve every attempt from there."""
    run, work = job.run, job.work
    status = take_jacobian(job, run.t, work.x)
    if status <= WARNING:
        status = _time_slope(job, h)
    if status <= WARNING:
        run.jacobian_at = run.t
    return status


@native
def _time_slope(job: Any, h: float) -> int:
    """Partial derivative of dx by time, the inputs' motion included, by a forward difference."""
    work, t = job.work, job.run.t
    later = t + _SLOPE_STEP * h
    status = evaluate(job, later, work.x, work.slope)
    slope, dx = doubles(work.slope), doubles(work.dx)
    for i in range(work.n):
        slope[i] = (slope[i] - dx[i]) / (later - t) if later > t else 0.0
    return status


@native
def _stage(job: Any, i: int, h: float) -> int:
    """Stage i into row i of k."""
    work, method, n, status = job.work, job.method, job.work.n, OK
    row = work.k + 8 * n * i
    if i == 0:
        copy(work.dx, row, n)
    else:
        combine(job, method.a + 8 * method.stages * i, i, 1.0, work.x_try)
        status = evaluate(job, job.run.t + doubles(method.c)[i] * h, work.x_try, row)
    add_rows(row, work.k, method.coupling + 8 * method.stages * i, i, 1.0 / h, row, n)
    right, slope, weight = doubles(row), doubles(work.slope), h * doubles(method.slope)[i]
    if weight != 0.0:
        for r in range(n):
            right[r] += weight * slope[r]
    solve_shifted(job, row)
    return status
