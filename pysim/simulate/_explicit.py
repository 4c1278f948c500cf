"""Explicit Runge-Kutta steps; the method is data."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pysim.simulate._fmu_calls import OK, WARNING
from pysim.simulate._native import native
from pysim.simulate._point import all_finite, error_norm, evaluate


class ExplicitMethod(NamedTuple):
    """Coefficients with s stages: k_i = f(t + c_i h, x + h sum_j a_ij k_j), x_new = x + h sum_i b_i k_i.

    k_s stands for the derivative at the end of the step, which is the first stage of the next one.
    """

    order: int
    a: Any  # (s, s) lower triangle
    b: Any  # (s,)
    c: Any  # (s,)
    error: Any  # (s + 1,) weights of the error estimate; zero for a fixed step
    error_order: int  # the estimate falls with this power of the step
    dense: Any  # (s + 1, d) weights of theta^1 ... theta^d in (x(t + theta h) - x) / h
    end_in_error: bool  # the error estimate needs k_s


@native
def attempt_explicit(method: Any, control: Any, fmu: Any, inputs: Any, run: Any, work: Any, h: float) -> tuple[int, float]:
    """One step of length h (s) from run.t: fills k and x_new; the worst status and the error norm."""
    n, stages = work.x.size, method.b.size
    work.k[0, :] = work.dx
    for i in range(1, stages):
        _combine(work, method.a[i], i, h, work.x_try)
        status = evaluate(fmu, inputs, run, run.t + method.c[i] * h, work.x_try, work.k[i])
        if status > WARNING:
            return status, np.nan
    _combine(work, method.b, stages, h, work.x_new)
    if control.step > 0.0:
        return OK, 0.0 if all_finite(work.x_new) else np.nan
    if method.end_in_error:
        status = evaluate(fmu, inputs, run, run.t + h, work.x_new, work.k[stages])
        if status > WARNING:
            return status, np.nan
    work.error[:] = 0.0
    for i in range(stages + 1):
        if method.error[i] != 0.0:
            for j in range(n):
                work.error[j] += h * method.error[i] * work.k[i, j]
    return OK, error_norm(control, work)


@native
def _combine(work: Any, weights: Any, count: int, h: float, result: Any) -> None:
    """result = x + h sum_i weights_i k_i."""
    result[:] = work.x
    for i in range(count):
        if weights[i] != 0.0:
            step = h * weights[i]
            for j in range(result.size):
                result[j] += step * work.k[i, j]


@native
def explicit_dense(method: Any, work: Any, h: float) -> None:
    """Coefficients of the interpolant over the step just taken."""
    work.dense[:] = 0.0
    for i in range(method.dense.shape[0]):
        for p in range(method.dense.shape[1]):
            if method.dense[i, p] != 0.0:
                weight = h * method.dense[i, p]
                for j in range(work.x.size):
                    work.dense[p, j] += weight * work.k[i, j]
