"""The native loop: step, locate, record, handle events. Python calls `integrate` and nothing else of it."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import doubles, entry, longs, native
from pysim.simulate.native.events import crossed, handle_event, locate, settle
from pysim.simulate.native.fmu_calls import WARNING, completed_step, get_indicators, get_nominals, get_states
from pysim.simulate.native.method import dense_coefficients
from pysim.simulate.native.passage import at_break, ended, next_segment, offset_here
from pysim.simulate.native.point import all_finite, copy, evaluate, set_point
from pysim.simulate.native.recording import interpolate, record_here, record_inside
from pysim.simulate.native.state import MODEL_ERROR, NOT_FINITE, RUNNING, TERMINATED
from pysim.simulate.native.stepping import accepted_step, first_step, next_target, next_time_event

_STANDSTILL = 1e-15  # of the time so far and of the whole run: less is rounding


@entry
def integrate(jobs: Any, budget: int) -> int:
    """Go on with a run for at most `budget` accepted steps; RUNNING or how it ended.

    Everything a run knows is in its record, so that Python may look in between, and be interrupted there.
    """
    job = jobs[0]
    code = _begin(job) if job.run.segment < 0 else RUNNING
    for _ in range(budget):
        if code != RUNNING:
            break
        code = _advance(job)
    return code


@native
def _begin(job: Any) -> int:
    """First event iteration, states and derivatives; the FMU has left initialisation mode."""
    run, work = job.run, job.work
    next_segment(job)
    code = settle(job)
    if code != RUNNING:
        return code
    run.status = max(run.status, get_states(job.fmu, work.x, work.n))
    run.status = max(run.status, get_nominals(job.fmu, work.nominal, work.n))
    if run.status <= WARNING and offset_here(job):
        code = handle_event(job)
    if run.status <= WARNING and code == RUNNING:
        code = resume(job)
    return _finish_point(job) if code == RUNNING else code


@native
def resume(job: Any) -> int:
    """Start afresh at run.t, where something changed: derivatives, indicators, and a first step that suits them."""
    run, work = job.run, job.work
    status = evaluate(job, run.t, work.x, work.dx)
    if status <= WARNING:
        status = max(status, get_indicators(job.fmu, work.z, work.m))
    run.status = max(run.status, status)
    if status > WARNING:
        return MODEL_ERROR
    if not (all_finite(work.x, work.n) and all_finite(work.dx, work.n)):
        return NOT_FINITE
    run.jacobian_at = np.nan
    if job.control.step == 0.0 and run.t < run.end:
        run.error_before = 1.0
        run.h = first_step(job)
    return RUNNING


@native
def _finish_point(job: Any) -> int:
    """Record the point reached, and see whether it is the last one."""
    run = job.run
    run.status = max(run.status, record_here(job))
    if run.status > WARNING:
        return MODEL_ERROR
    return ended(job)


@native
def _advance(job: Any) -> int:
    """One accepted step with all that happens in it and at its end."""
    fmu, run, work = job.fmu, job.run, job.work
    code, h, t_new = accepted_step(job, next_target(job))
    if code != RUNNING:
        return code
    run.steps += 1
    run.status = WARNING if run.status > WARNING else run.status  # what was rejected is forgiven
    status = get_indicators(fmu, work.z_new, work.m)
    event = crossed(job, work.z, work.z_new)
    inside = job.rows.next < job.rows.count and doubles(job.rows.times)[job.rows.next] < t_new
    if event or inside:
        dense_coefficients(job, h)
    if event and status <= WARNING:
        status, theta = locate(job, h)
        if theta < 1.0:
            interpolate(job, theta)
            copy(work.x_try, work.x_new, work.n)
            t_new = run.t + theta * h
    if inside and status <= WARNING:
        status = record_inside(job, h, t_new)
    if (event or inside) and status <= WARNING:
        status = set_point(job, t_new, work.x_new)
    if status <= WARNING:
        status = completed_step(fmu)
    run.status = max(run.status, status)
    return _arrive(job, t_new, event) if status <= WARNING else MODEL_ERROR


@native
def _arrive(job: Any, t_new: float, event: bool) -> int:
    """Make the end of the step the current point; handle what is due there; record it."""
    fmu, run, work = job.fmu, job.run, job.work
    if t_new - run.t > _STANDSTILL * max(abs(t_new), run.end - run.start):
        run.crowd = 0
    run.t = t_new
    copy(work.x_new, work.x, work.n)
    copy(work.dx_new, work.dx, work.n)
    copy(work.z_new, work.z, work.m)
    if fmu.terminate != 0:
        return TERMINATED
    event, restart = event or fmu.event != 0 or run.t >= next_time_event(job), False
    if at_break(job):
        restart, event = True, event or longs(job.breaks.jumps)[run.segment] != 0
        next_segment(job)
    event = offset_here(job) or event
    code = handle_event(job) if event else RUNNING
    if code == RUNNING and (event or restart):
        code = resume(job)
    return _finish_point(job) if code == RUNNING else code
