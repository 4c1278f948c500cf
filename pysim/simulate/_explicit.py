"""Explicit Runge-Kutta steps."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate._fmu_calls import OK, WARNING
from pysim.simulate._native import doubles, native
from pysim.simulate._point import copy, error_norm, evaluate


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
    _estimate(job, h)
    return OK, error_norm(job, work.error, work.x, work.x_new)


@native
def combine(job: Any, weights: int, count: int, scale: float, result: int) -> None:
    """result = x + scale sum_i weights_i k_i over the first `count` stages."""
    work, n = job.work, job.work.n
    w, k, y = doubles(weights), doubles(work.k), doubles(result)
    copy(work.x, result, n)
    for i in range(count):
        weight = scale * w[i]
        if weight != 0.0:
            for j in range(n):
                y[j] += weight * k[i * n + j]


@native
def _estimate(job: Any, h: float) -> None:
    work, n = job.work, job.work.n
    weights, k, error = doubles(job.method.error), doubles(work.k), doubles(work.error)
    for j in range(n):
        error[j] = 0.0
    for i in range(job.method.stages + job.method.end_in_error):
        weight = h * weights[i]
        for j in range(n):
            error[j] += weight * k[i * n + j]
