"""The native loop of a run with its derivatives. It stops where an event would make them jump."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import doubles, entry, longs, native
from pysim.simulate.native.events import crossed, handle_event, settle
from pysim.simulate.native.fmu_calls import WARNING, completed_step, get_indicators, get_nominals, get_states
from pysim.simulate.native.loop import resume
from pysim.simulate.native.method import dense_coefficients
from pysim.simulate.native.passage import at_break, ended, next_segment, offset_here
from pysim.simulate.native.point import copy, set_point
from pysim.simulate.native.recording import interpolate, read_row
from pysim.simulate.native.state import MODEL_ERROR, NOT_FINITE, RUNNING, TERMINATED
from pysim.simulate.native.stepping import accepted_step, next_target
from pysim.simulate.native.variation import (
    begin_variation,
    end_variation,
    note_range,
    record_variation,
    variation_error,
    vary_inside,
    vary_step,
)

EVENT = 100  # how a run may end besides the outcomes: at an event, which is not differentiated


@entry
def integrate_variations(jobs: Any, budget: int) -> int:
    """Go on with a run for at most `budget` accepted steps; RUNNING, EVENT or how it ended."""
    job = jobs[0]
    code = _begin(job) if job.run.segment < 0 else RUNNING
    for _ in range(budget):
        if code != RUNNING:
            break
        code = _advance(job)
    return code


@native
def _begin(job: Any) -> int:
    """First event iteration unless the FMU is past it, states, derivatives, and S."""
    run, work, v = job.run, job.work, job.variation
    next_segment(job)
    code = RUNNING
    if v.rewind == 0:
        code = settle(job)
    else:
        run.next_event = np.inf
    if code != RUNNING:
        return code
    if v.start == 0:
        run.status = max(run.status, get_states(job.fmu, work.x, work.n))
    else:
        copy(v.start, work.x, work.n)
    run.status = max(run.status, get_nominals(job.fmu, work.nominal, work.n))
    copy(v.start_by, v.s, work.n * v.columns)
    if run.status > WARNING:
        return MODEL_ERROR
    if offset_here(job):
        code = _offset(job)
    if code == RUNNING:
        code = _restart(job)
    return _finish_point(job) if code == RUNNING else code


@native
def _offset(job: Any) -> int:
    """The states have been offset: S gets the derivatives by it, and the model looks for what changes with them."""
    work, s, x = job.work, doubles(job.variation.s), doubles(job.work.x)
    for i in range(job.variation.by_start):
        s[i * job.variation.columns + i] += 1.0
    copy(work.x, work.x_try, work.n)
    code = handle_event(job)
    for i in range(work.n):
        if code == RUNNING and x[i] != doubles(work.x_try)[i]:
            code = EVENT
    return code


@native
def _restart(job: Any) -> int:
    """Start afresh at run.t: derivatives, first step, K."""
    code = resume(job)
    if code == RUNNING and job.variation.columns > 0:
        job.run.status = max(job.run.status, begin_variation(job))
        code = RUNNING if job.run.status <= WARNING else MODEL_ERROR
    return code


@native
def _advance(job: Any) -> int:
    """One accepted step, its derivative, and what is recorded in it."""
    fmu, run, work = job.fmu, job.run, job.work
    while True:
        code, h, t_new = accepted_step(job, next_target(job))
        if code != RUNNING:
            return code
        run.status = WARNING if run.status > WARNING else run.status  # what was rejected is forgiven
        status = get_indicators(fmu, work.z_new, work.m)
        if status <= WARNING and crossed(job, work.z, work.z_new):
            return EVENT
        if status <= WARNING and job.variation.columns > 0:
            status = vary_step(job, h)
        if status > WARNING or not _shorten(job, h):
            break
    run.steps += 1
    if status <= WARNING:
        status = _record_inside(job, h, t_new)
    if status <= WARNING:
        status = set_point(job, t_new, work.x_new)
    if status <= WARNING:
        status = completed_step(fmu)
    run.status = max(run.status, status)
    return _arrive(job, t_new) if status <= WARNING else MODEL_ERROR


@native
def _shorten(job: Any, h: float) -> bool:
    """Whether the step has to be taken again because a derivative is too far off; sets the length to try next."""
    run, v = job.run, job.variation
    if not (v.columns > 0 and v.tolerance < np.inf):
        return False
    error = variation_error(job, h)
    wanted = h * max(0.9 * max(error, 1e-6) ** (-1.0 / job.method.error_order), 0.2)
    if error <= 1.0 or not wanted > 1e-12 * (run.end - run.start):
        run.h = min(run.h, wanted)
        return False
    run.rejected += 1
    run.h = wanted
    run.jacobian_at = np.nan  # what is there belongs to the end of the step
    return True


@native
def _record_inside(job: Any, h: float, t_end: float) -> int:
    """Every row before t_end (s), with its derivatives, in the step of length h from run.t."""
    rows, run, spare, status = job.rows, job.run, job.variation.right, WARNING - WARNING
    times = doubles(rows.times)
    if rows.next >= rows.count or times[rows.next] >= t_end:
        return status
    dense_coefficients(job, h)
    while rows.next < rows.count and times[rows.next] < t_end:
        t = times[rows.next]
        theta = (t - run.t) / h
        interpolate(job, theta)
        vary_inside(job, theta, h, spare)
        status = max(status, set_point(job, t, job.work.x_try))
        if status <= WARNING:
            status = max(status, _record(job, spare))
        if status > WARNING:
            return status
    return status


@native
def _record(job: Any, s: int) -> int:
    """The next row at the point last set, with S at address s."""
    row = job.rows.next
    status = read_row(job)
    return status if status > WARNING else max(status, record_variation(job, row, s))


@native
def _arrive(job: Any, t_new: float) -> int:
    """Make the end of the step the current point, pass a break of the inputs there, record."""
    fmu, run, work = job.fmu, job.run, job.work
    run.t = t_new
    copy(work.x_new, work.x, work.n)
    copy(work.dx_new, work.dx, work.n)
    copy(work.z_new, work.z, work.m)
    if job.variation.columns > 0:
        end_variation(job)
    if fmu.terminate != 0:
        return TERMINATED
    if fmu.event != 0 or run.t >= run.next_event:
        return EVENT
    code = _pass_break(job) if at_break(job) else RUNNING
    return _finish_point(job) if code == RUNNING else code


@native
def _pass_break(job: Any) -> int:
    """Go on behind a break of the inputs. A jump is an event for the model, harmless where nothing of it changes."""
    run, work = job.run, job.work
    jump = longs(job.breaks.jumps)[run.segment] != 0
    next_segment(job)
    if jump:
        code = handle_event(job)
        if code != RUNNING:
            return code
        for i in range(work.n):
            if doubles(work.x)[i] != doubles(work.x_new)[i]:
                return EVENT
    offset = offset_here(job)
    code = _offset(job) if offset else RUNNING
    if code == RUNNING:
        code = _restart(job)
    return EVENT if code == RUNNING and not offset and crossed(job, work.z, work.z_new) else code


@native
def _finish_point(job: Any) -> int:
    """Record the point reached, and see whether it is the last one."""
    run, rows = job.run, job.rows
    if rows.next < rows.count and doubles(rows.times)[rows.next] <= run.t:
        status = set_point(job, run.t, job.work.x)
        if status <= WARNING:
            status = max(status, _record(job, job.variation.s))
        run.status = max(run.status, status)
        if status > WARNING:
            return MODEL_ERROR
    note_range(job)
    if not _finite(job):
        return NOT_FINITE
    return ended(job)


@native
def _finite(job: Any) -> bool:
    s, total = doubles(job.variation.s), 0.0
    for i in range(job.work.n * job.variation.columns):
        total += 0.0 * s[i]
    return total == 0.0
