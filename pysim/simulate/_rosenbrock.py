"""Rosenbrock steps: linearly implicit, for stiff models."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate._explicit import combine
from pysim.simulate._fmu_calls import OK, WARNING, get_directional
from pysim.simulate._linear import factorise, solve
from pysim.simulate._native import doubles, longs, native
from pysim.simulate._point import copy, error_norm, evaluate, set_point

_ROOT_EPS = 1.4901161193847656e-08
_SLOPE_STEP = 1e-6  # of the step: a compromise between curvature and rounding, both of which a stiff model enlarges


@native
def attempt_rosenbrock(job: Any, h: float) -> tuple[int, float]:
    """One step of length h (s): fills k and x_new; the worst status and the error norm."""
    run, work, method = job.run, job.work, job.method
    status = OK
    if run.jacobian_at != run.t:
        status = _linearise(job, h)
    if status > WARNING or not _prepare(job, h):
        return status, np.nan
    for i in range(method.stages):
        status = _stage(job, i, h)
        if status > WARNING:
            return status, np.nan
    combine(job, method.b, method.stages, 1.0, work.x_new)
    _estimate(job)
    return OK, error_norm(job, work.error, work.x, work.x_new)


@native
def _linearise(job: Any, h: float) -> int:
    """Jacobian and slope at run.t; they serve every attempt from there."""
    run, work = job.run, job.work
    status = _jacobian_exact(job) if work.has_directional != 0 else _jacobian_differences(job)
    if status <= WARNING:
        status = _time_slope(job, h)
    if status <= WARNING:
        run.jacobian_at = run.t
    run.jacobians += 1
    return status


@native
def _jacobian_exact(job: Any) -> int:
    """By directional derivatives, one per group of states that share no derivative."""
    work, n = job.work, job.work.n
    first, members, pattern = longs(work.group_first), longs(work.group_members), doubles(work.pattern)
    jacobian, column = doubles(work.jacobian), doubles(work.error)
    status = set_point(job, job.run.t, work.x)
    for g in range(work.groups):
        if status > WARNING:
            break
        knowns, count = work.group_references + 4 * first[g], first[g + 1] - first[g]
        status = get_directional(job.fmu, work.derivative_references, n, knowns, count, work.ones, work.error)
        for place in range(first[g], first[g + 1]):
            start = members[place] * n
            for i in range(n):
                jacobian[start + i] = column[i] if pattern[start + i] != 0.0 else 0.0
    return status


@native
def _jacobian_differences(job: Any) -> int:
    """One-sided differences, each state moved by the root of the rounding error."""
    work, n = job.work, job.work.n
    x, dx, nominal = doubles(work.x_try), doubles(work.dx), doubles(work.nominal)
    copy(work.x, work.x_try, n)
    for j in range(n):
        before = x[j]
        x[j] = before + _ROOT_EPS * max(abs(before), 1e-3 * abs(nominal[j]))
        column = doubles(work.jacobian + 8 * n * j)
        status = evaluate(job, job.run.t, work.x_try, work.jacobian + 8 * n * j)
        if status > WARNING:
            return status
        for i in range(n):
            column[i] = (column[i] - dx[i]) / (x[j] - before)
        x[j] = before
    return OK


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
def _prepare(job: Any, h: float) -> bool:
    """Factorise I / (h gamma) - J; False if it is singular or not finite."""
    work, n = job.work, job.work.n
    matrix, jacobian = doubles(work.matrix), doubles(work.jacobian)
    diagonal = 1.0 / (h * job.method.gamma)
    for i in range(n * n):
        matrix[i] = -jacobian[i]
    for i in range(n):
        matrix[i * n + i] += diagonal
    return factorise(work.matrix, work.pivots, n)


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
    k, right, slope = doubles(work.k), doubles(row), doubles(work.slope)
    for j in range(i):
        weight = doubles(method.coupling)[i * method.stages + j] / h
        for r in range(n):
            right[r] += weight * k[j * n + r]
    for r in range(n):
        right[r] += h * doubles(method.slope)[i] * slope[r]
    solve(work.matrix, work.pivots, row, n)
    return status


@native
def _estimate(job: Any) -> None:
    work, n = job.work, job.work.n
    weights, k, error = doubles(job.method.error), doubles(work.k), doubles(work.error)
    for j in range(n):
        error[j] = 0.0
        for i in range(job.method.stages):
            error[j] += weights[i] * k[i * n + j]
