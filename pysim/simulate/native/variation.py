"""What a small change of the start or of a parameter does: the derivative of every step, next to the step itself.

S is d x / d (start states, parameters): one row per state, one column per direction. Each stage of an implicit step is
an equation of its own, so its derivative solves the linear equation of that stage: with J = df/dx and F = df/dp there,

    (I - h gamma J) S_i = S + h sum_{j<i} a_ij K_j + h gamma F,    K_i = J S_i + F.

The lengths of the steps are taken as they are (internal numerical differentiation, Bock 1981).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from pysim.simulate.native.blocks import add_row, solve_shifted_rows
from pysim.simulate.native.compiled import doubles, longs, native
from pysim.simulate.native.elimination import factorise_shifted
from pysim.simulate.native.fmu_calls import ERROR, OK, WARNING, get_directional
from pysim.simulate.native.jacobian import take_jacobian
from pysim.simulate.native.point import copy
from pysim.simulate.native.vector import add_rows

# Addresses; n states, s stages, c columns: first those of the start states (n or none), then one per parameter, then
# zeros that fill the last vector of the processor.
VARIATION = np.dtype(
    [
        ("columns", np.int64),  # c
        ("by_start", np.int64),  # columns of start states: n or 0
        ("parameters", np.int64),  # n_p
        ("rewind", np.int64),  # 1: the FMU is in continuous-time mode already
        ("start", np.int64),  # (n,) states to start from; 0: those of the FMU
        ("start_by", np.int64),  # (n, c) their derivatives
        ("seeds", np.int64),  # (n_p,) of uint32, references; a start value, which no equation holds, has no seed
        ("seeded", np.int64),  # (n_p,) of int64, 0 where there is no seed
        ("s", np.int64),  # (n, c) at run.t
        ("k", np.int64),  # (s, n, c)
        ("right", np.int64),  # (n, c)
        ("inside", np.int64),  # (n, c) within a step
        ("weights", np.int64),  # (s,)
        ("tolerance", np.float64),  # tolerated error of a step in a column of S, of the column's largest size so far
        ("error", np.int64),  # (n, c)
        ("sizes", np.int64),  # (c,) those sizes
        ("forcing", np.int64),  # (n_p, n) F
        ("rows", np.int64),  # (n_t, n_y, c) derivatives of what is recorded
        ("kinds", np.int64),  # (n_y,) of int64: number of the state a variable is, or one of the kinds below
        ("fixed", np.int64),  # (n_y, c) derivatives of those that no state moves
        ("unknowns", np.int64),  # of the others
        ("unknown_references", np.int64),  # (unknowns,) of uint32
        ("state_references", np.int64),  # (n,) of uint32
        ("gradient", np.int64),  # (unknowns,) their derivatives by one state or parameter
        ("low", np.int64),  # (n,) least and
        ("high", np.int64),  # (n,) largest value of each state so far
    ]
)

# How a recorded variable depends on the states, where it is none of them.
ASKED, FIXED = -1, -2  # the FMU is asked; it does not


@native
def begin_variation(job: Any) -> int:
    """K at run.t, where the derivatives jump: at the start and behind every break of an input."""
    v, work, n, width = job.variation, job.work, job.work.n, job.variation.columns
    status = take_jacobian(job, job.run.t, work.x)
    if status > WARNING:
        return status
    job.run.jacobian_at, job.run.matrix_step = job.run.t, 0.0
    status = max(status, _forcing(job))
    jacobian, k = doubles(work.jacobian), doubles(v.k)
    for i in range(n * width):
        k[i] = 0.0
    _add_forcing(job, v.k, 1.0)
    for i in range(n):
        for j in range(n):
            if jacobian[j * n + i] != 0.0:
                add_row(v.k + 8 * width * i, v.s + 8 * width * j, jacobian[j * n + i], width)
    return status


@native
def vary_step(job: Any, h: float) -> int:
    """Fill k for the step just accepted, whose stages are still there; the worst status.

    Jacobian and factors of the last stage stay, for they are those of the next step.
    """
    status = OK
    for i in range(1, job.method.stages):
        status = max(status, _vary_stage(job, i, h))
        if status > WARNING:
            return status
    job.run.matrix_step = h
    return status


@native
def _vary_stage(job: Any, i: int, h: float) -> int:
    v, work, method, size = job.variation, job.work, job.method, job.work.n * job.variation.columns
    shift = 1.0 / (h * method.gamma)
    t, place = job.run.t + doubles(method.c)[i] * h, 8 * work.n * i
    status = take_jacobian(job, t, work.stages + place)
    if status <= WARNING:
        status = max(status, _forcing(job))
    if status > WARNING:
        return status
    if not factorise_shifted(job, shift):
        return ERROR
    add_rows(v.s, v.k, method.a + 8 * method.stages * i, i, h, v.right, size)
    known, solved, k = doubles(v.right), doubles(v.inside), doubles(v.k + 8 * size * i)
    for r in range(size):
        solved[r] = shift * known[r]
    _add_forcing(job, v.inside, 1.0)
    solve_shifted_rows(job, v.inside, v.columns)
    for r in range(size):
        k[r] = (solved[r] - known[r]) * shift
    return status


@native
def _forcing(job: Any) -> int:
    """F at the point last set: a directional derivative per parameter."""
    v, work, n, status = job.variation, job.work, job.work.n, OK
    for p in range(v.parameters):
        if longs(v.seeded)[p] != 0:
            column = v.forcing + 8 * n * p
            status = max(
                status,
                get_directional(job.fmu, work.derivative_references, n, v.seeds + 4 * p, 1, work.ones, column),
            )
    return status


@native
def _add_forcing(job: Any, target: int, factor: float) -> None:
    """Add factor F to the columns of the parameters in target (n, c)."""
    v, n, forcing, rows = job.variation, job.work.n, doubles(job.variation.forcing), doubles(target)
    for p in range(v.parameters):
        for i in range(n):
            rows[i * v.columns + v.by_start + p] += factor * forcing[p * n + i]


@native
def variation_error(job: Any, h: float) -> float:
    """Largest error of a column of S in the step just taken, over what is tolerated; states weigh as in their own."""
    v, work, control = job.variation, job.work, job.control
    x, nominal = doubles(work.x_new), doubles(work.nominal)
    error, s, sizes, worst = doubles(v.error), doubles(v.inside), doubles(v.sizes), 0.0
    for r in range(work.n * v.columns):
        error[r] = 0.0
    add_rows(v.error, v.k, job.method.error, job.method.stages, h, v.error, work.n * v.columns)
    for c in range(v.by_start + v.parameters):
        wrong, size = 0.0, 0.0
        for i in range(work.n):
            weight = 1.0 / (control.atol * nominal[i] + control.rtol * abs(x[i]))
            wrong += (weight * error[i * v.columns + c]) ** 2
            size += (weight * s[i * v.columns + c]) ** 2
        sizes[c] = max(sizes[c], math.sqrt(size))
        if sizes[c] > 0.0:
            worst = max(worst, math.sqrt(wrong) / sizes[c])
    return worst / v.tolerance


@native
def note_range(job: Any) -> None:
    """Widen low and high to the states at run.t."""
    x, low, high = doubles(job.work.x), doubles(job.variation.low), doubles(job.variation.high)
    for i in range(job.work.n):
        low[i] = min(low[i], x[i])
        high[i] = max(high[i], x[i])


@native
def end_variation(job: Any) -> None:
    """Make the end of the step the current point."""
    v, size = job.variation, job.work.n * job.variation.columns
    copy(v.inside, v.s, size)  # the last stage
    job.run.jacobian_at = job.run.t
    copy(v.k + 8 * size * (job.method.stages - 1), v.k, size)


@native
def vary_inside(job: Any, theta: float, h: float, target: int) -> None:
    """target (n, c) = S at the share theta of the step, by the interpolant of the step itself."""
    v, method, size = job.variation, job.method, job.work.n * job.variation.columns
    dense, weights = doubles(method.dense), doubles(v.weights)
    for i in range(method.stages):
        weight = 0.0
        for p in range(method.terms - 1, -1, -1):
            weight = theta * (dense[i * method.terms + p] + weight)
        weights[i] = weight
    add_rows(v.s, v.k, v.weights, method.stages, h, target, size)


@native
def record_variation(job: Any, row: int, s: int) -> int:
    """Derivatives of what is recorded, at the point last set with S at address s (n, c), as that row."""
    v, n, width, status = job.variation, job.work.n, job.variation.columns, OK
    columns, kinds = job.rows.columns, longs(v.kinds)
    place = v.rows + 8 * row * columns * width
    for y in range(columns):
        if kinds[y] >= 0:
            copy(s + 8 * width * kinds[y], place + 8 * width * y, width)
        else:
            copy(v.fixed + 8 * width * y, place + 8 * width * y, width)
    if v.unknowns == 0:
        return OK
    for j in range(n + v.parameters):
        if j >= n and longs(v.seeded)[j - n] == 0:
            continue
        known = v.state_references + 4 * j if j < n else v.seeds + 4 * (j - n)
        status = max(
            status, get_directional(job.fmu, v.unknown_references, v.unknowns, known, 1, job.work.ones, v.gradient)
        )
        if status > WARNING:
            return status
        _add_gradient(job, place, j, s)
    return status


@native
def _add_gradient(job: Any, place: int, j: int, s: int) -> None:
    """Add what state j, or parameter j - n, does to the variables that the FMU was asked for."""
    v, n, width, gradient, kinds, u = (
        job.variation,
        job.work.n,
        job.variation.columns,
        doubles(job.variation.gradient),
        longs(job.variation.kinds),
        0,
    )
    for y in range(job.rows.columns):
        if kinds[y] != ASKED:
            continue
        if gradient[u] != 0.0:
            if j < n:
                add_row(place + 8 * width * y, s + 8 * width * j, gradient[u], width)
            else:
                doubles(place + 8 * width * y)[v.by_start + j - n] += gradient[u]
        u += 1
