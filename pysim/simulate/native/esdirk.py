"""Diagonally implicit Runge-Kutta steps: Newton in each stage, with one Jacobian and one factorisation per step."""

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

_ITERATIONS = 10  # of Newton in a stage; slower, a shorter step is cheaper
_ENOUGH = 1e-2  # of the tolerated error of a step: what Newton may leave
_SLOWEST = 0.9  # ratio of two corrections above which Newton will not arrive


@native
def attempt_esdirk(job: Any, h: float) -> tuple[int, float]:
    """One step of length h (s): fills k, stages, x_new and dx_new; the worst status and the error norm.

    The norm is infinite where Newton does not converge.
    """
    run, work, method, n = job.run, job.work, job.method, job.work.n
    status = OK
    if run.jacobian_at != run.t:
        status = take_jacobian(job, run.t, work.x)
        if status > WARNING:
            return status, np.nan
        run.jacobian_at, run.matrix_step = run.t, 0.0
    if run.matrix_step != h and not factorise_shifted(job, 1.0 / (h * method.gamma)):
        run.matrix_step = 0.0
        return status, np.nan
    run.matrix_step = h
    copy(work.dx, work.k, n)
    copy(work.x, work.stages, n)
    for i in range(1, method.stages):
        found, converged = _stage(job, i, h)
        status = max(status, found)
        if status > WARNING:
            return status, np.nan
        if not converged:
            return status, np.inf
    last = 8 * n * (method.stages - 1)
    copy(work.stages + last, work.x_new, n)
    copy(work.k + last, work.dx_new, n)
    estimate(job, method.stages, h)
    return status, error_norm(job, work.error, work.x, work.x_new)


@native
def _stage(job: Any, i: int, h: float) -> tuple[int, bool]:
    """Solve X = x + h sum_{j<i} a_ij k_j + h gamma f(t + c_i h, X) for row i of stages; the status, and whether found.

    The stage's derivative k_i follows from X and not from f, which would enlarge what Newton leaves of stiff parts.
    """
    work, method, n = job.work, job.method, job.work.n
    place, width = 8 * n * i, 8 * method.stages
    t, reach = job.run.t + doubles(method.c)[i] * h, h * method.gamma
    combine(job, method.a + width * i, i, h, work.right)
    add_rows(work.right, work.k, method.predict + width * i, i, reach, work.stages + place, n)  # where Newton starts
    x, k, right, change = (
        doubles(work.stages + place),
        doubles(work.k + place),
        doubles(work.right),
        doubles(work.error),
    )
    before, status, shift = 0.0, OK, 1.0 / reach
    for count in range(_ITERATIONS):
        status = max(status, evaluate(job, t, work.stages + place, work.k + place))
        if status > WARNING:
            return status, False
        for r in range(n):
            change[r] = (right[r] - x[r]) * shift + k[r]
        solve_shifted(job, work.error)
        for r in range(n):
            x[r] += change[r]
        size = error_norm(job, work.error, work.x, work.stages + place)
        if not size < 1e100:
            return status, False
        ratio = size / before if count > 0 and before > 0.0 else 0.5
        before = size
        if size <= 1e-3 * _ENOUGH or (count > 0 and size * ratio <= (1.0 - ratio) * _ENOUGH):
            for r in range(n):
                k[r] = (x[r] - right[r]) * shift
            return status, True
        if count > 0 and ratio > _SLOWEST:
            return status, False
    return status, False
