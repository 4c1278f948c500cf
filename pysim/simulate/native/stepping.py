"""How long the next step is, and attempts until one is accepted."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import doubles, native
from pysim.simulate.native.fmu_calls import DISCARD, WARNING
from pysim.simulate.native.method import attempt_step
from pysim.simulate.native.point import all_finite, error_norm, evaluate
from pysim.simulate.native.state import MODEL_ERROR, NOT_FINITE, RUNNING, STEP_TOO_SMALL

_EPS = 2.220446049250313e-16
_SAFETY, _SHRINK, _GROW, _FAILED = 0.9, 0.2, 5.0, 0.25
_GRID = 1e-9  # of a fixed step: nearer than that, two points are one


@native
def next_time_event(job: Any) -> float:
    """Time (s) of the model's next time event; infinite where it is left to who drives the run."""
    run = job.run
    return run.next_event if run.next_event < run.leaves else np.inf


@native
def first_step(job: Any) -> float:
    """A step (s) from the size of x, of dx, and of what an Euler step changes (Hairer, Norsett, Wanner I, II.4)."""
    run, work, control = job.run, job.work, job.control
    span = min(min(run.horizon, next_time_event(job)) - run.t, control.max_step)
    size, rate = error_norm(job, work.x, work.x, work.x), error_norm(job, work.dx, work.x, work.x)
    h = 0.01 * size / rate if min(size, rate) > 1e-5 else 1e-6 * span
    h = min(h, span)
    x, dx, moved, difference = doubles(work.x), doubles(work.dx), doubles(work.x_try), doubles(work.error)
    for i in range(work.n):
        moved[i] = x[i] + h * dx[i]
    status = evaluate(job, run.t + h, work.x_try, work.error)
    if status > WARNING or not all_finite(work.error, work.n):
        return 0.01 * h
    for i in range(work.n):
        difference[i] = (difference[i] - dx[i]) / h
    largest = max(rate, error_norm(job, work.error, work.x, work.x))
    reach = (0.01 / largest) ** (1.0 / job.method.error_order) if largest > 1e-15 else 1e-3 * span
    return min(min(100.0 * h, reach), span)


@native
def next_target(job: Any) -> float:
    """The time (s) that the next step must not pass: a break, a time event, or the next point of a fixed grid."""
    run, step = job.run, job.control.step
    target = min(run.horizon, next_time_event(job))
    if step == 0.0:
        return target
    while run.start + (run.grid + 1) * step <= run.t + _GRID * step:
        run.grid += 1
    grid = run.start + (run.grid + 1) * step
    return grid if grid + _GRID * step < target else target


@native
def _limit(job: Any, target: float) -> tuple[float, float]:
    """Length of the next step and the time of its end; no sliver is left for the step after."""
    run = job.run
    left = target - run.t
    if job.control.step > 0.0 or left <= 1.01 * run.h:
        return left, target
    h = 0.5 * left if left < 2.0 * run.h else run.h
    return h, run.t + h


@native
def _growth(job: Any, error: float) -> float:
    """Factor for the next step, by a proportional-integral rule (Hairer, Wanner II, IV.2)."""
    order = job.method.error_order
    wanted = _SAFETY * max(error, 1e-10) ** (-0.7 / order) * max(job.run.error_before, 1e-4) ** (0.4 / order)
    return min(max(wanted, _SHRINK), _GROW)


@native
def _attempt(job: Any, h: float, t_new: float) -> tuple[int, float]:
    """A step with the derivative at its end; status, and the error norm: NaN where a value is not finite."""
    work = job.work
    status, error = attempt_step(job, h)
    if status <= WARNING and error <= 1.0 and job.method.end_in_error == 0:
        status = evaluate(job, t_new, work.x_new, work.dx_new)
    if not (all_finite(work.x_new, work.n) and all_finite(work.dx_new, work.n)):
        error = error * 0.0 + float("nan")
    return status, error


@native
def accepted_step(job: Any, target: float) -> tuple[int, float, float]:
    """Attempt steps until one is accepted: RUNNING or the outcome, its length, the time of its end."""
    run, control = job.run, job.control
    while True:
        h, t_new = _limit(job, target)
        status, error = _attempt(job, h, t_new)
        if status <= WARNING and error <= 1.0:
            break
        run.rejected += 1
        run.status = max(run.status, status)
        if status > DISCARD:
            return MODEL_ERROR, h, t_new
        finite = status > WARNING or error == error
        run.h = h * (max(_SAFETY * error ** (-1.0 / job.method.error_order), _SHRINK) if error > 1.0 else _FAILED)
        if control.step > 0.0 or run.h <= 4.0 * _EPS * max(abs(run.t), abs(target)):
            return STEP_TOO_SMALL if finite else NOT_FINITE, h, t_new
    if control.step == 0.0:
        wanted = h * _growth(job, error)
        run.h = min(max(wanted, run.h) if t_new == target else wanted, control.max_step)
        run.error_before = error
    return RUNNING, h, t_new
