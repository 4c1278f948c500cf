"""Explicit Runge-Kutta steps."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import doubles, native
from pysim.simulate.native.fmu_calls import OK, WARNING
from pysim.simulate.native.point import copy, error_norm, evaluate
from pysim.simulate.native.vector import add_rows


@native
def attempt_explicit(job: Any, h: float) -> tuple[int, float]:
    """One step of length h (s): fills k and x_new; the worst status and the error norm."""
    work, method, t = job.work, job.method, job.run.t
    row, stages = 8 * work.n, method.stages
    copy(work.dx, work.k, work.n)
    for i in range(1, stages):
        combine(job, method.a + 8 * stages * i, i, h, work.x_try)
        status = evaluate(job, t + doubles(method.c)[i] * h, work.x_try, work.k + row * i)
        if status > WARNING:
            return status, np.nan
    combine(job, method.b, stages, h, work.x_new)
    if job.control.step > 0.0:
        return OK, 0.0
    if method.end_in_error != 0:
        status = evaluate(job, t + h, work.x_new, work.dx_new)
        if status > WARNING:
            return status, np.nan
    estimate(job, stages + method.end_in_error, h)
    return OK, error_norm(job, work.error, work.x, work.x_new)


@native
def combine(job: Any, weights: int, count: int, scale: float, result: int) -> None:
    """result = x + scale sum_i weights_i k_i over the first `count` stages."""
    add_rows(job.work.x, job.work.k, weights, count, scale, result, job.work.n)


@native
def estimate(job: Any, count: int, scale: float) -> None:
    """work.error = scale sum_i error_i k_i over the first `count` stages."""
    work, n = job.work, job.work.n
    error = doubles(work.error)
    for j in range(n):
        error[j] = 0.0
    add_rows(work.error, work.k, job.method.error, count, scale, work.error, n)
