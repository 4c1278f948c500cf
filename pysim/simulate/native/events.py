"""Events: where an indicator changes its sign, and what the model does about it."""

from __future__ import annotations

from typing import Any

from pysim.simulate.native.compiled import doubles, native
from pysim.simulate.native.fmu_calls import (
    OK,
    WARNING,
    enter_continuous_mode,
    enter_event_mode,
    get_indicators,
    get_nominals,
    get_states,
    update_discrete,
)
from pysim.simulate.native.inputs import set_inputs
from pysim.simulate.native.point import copy, set_point
from pysim.simulate.native.recording import interpolate
from pysim.simulate.native.state import MODEL_ERROR, RUNNING, TERMINATED, TOO_MANY_EVENTS

_EPS = 2.220446049250313e-16
_ROUNDS = 1000  # of one event iteration
_CROWD = 1000  # events without time moving on
_SEARCH = 200  # evaluations to locate one event; every third one halves the bracket


@native
def crossed(job: Any, before: int, after: int) -> bool:
    """Whether an indicator changed between > 0 and <= 0."""
    a, b = doubles(before), doubles(after)
    changes = 0
    for i in range(job.work.m):
        changes += (a[i] > 0.0) != (b[i] > 0.0)
    return changes > 0


@native
def _first_secant(job: Any, low: float, high: float) -> float:
    """First crossing in [low, high], by straight lines through work.z_low and work.z_new."""
    a, b, first = doubles(job.work.z_low), doubles(job.work.z_new), high
    for i in range(job.work.m):
        if (a[i] > 0.0) != (b[i] > 0.0):
            first = min(first, low + (high - low) * a[i] / (a[i] - b[i]))
    return first


@native
def locate(job: Any, h: float) -> tuple[int, float]:
    """Share of the step just after its first sign change; the worst status. work.z_new is taken there.

    The bracket is narrowed by secants kept half a tolerance away from its ends, so that both ends close in, and in
    every third round by its middle, so that they always do. work.z, work.z_new and work.dense are filled; work.x_try
    changes.
    """
    run, work, low, high = job.run, job.work, 0.0, 1.0
    width = 4.0 * _EPS * max(abs(run.t), abs(run.t + h)) / h
    copy(work.z, work.z_low, work.m)
    for count in range(_SEARCH):
        if high - low <= width:
            break
        theta = 0.5 * (low + high) if count % 3 == 2 else _first_secant(job, low, high)
        theta = min(max(theta, low + 0.5 * width), high - 0.5 * width)
        interpolate(job, theta)
        status = max(set_point(job, run.t + theta * h, work.x_try), get_indicators(job.fmu, work.z_try, work.m))
        if status > WARNING:
            return status, high
        if crossed(job, work.z, work.z_try):
            high = theta
            copy(work.z_try, work.z_new, work.m)
        else:
            low = theta
            copy(work.z_try, work.z_low, work.m)
    return OK, high


@native
def settle(job: Any) -> int:
    """Event iteration, from event mode to continuous-time mode; RUNNING, or the outcome if the run ends here."""
    fmu, run, work = job.fmu, job.run, job.work
    states, nominals, rounds = 0, 0, 0
    fmu.again = 1
    while fmu.again != 0:
        run.status = max(run.status, update_discrete(fmu))
        if run.status > WARNING:
            return MODEL_ERROR
        if fmu.terminate != 0:
            return TERMINATED
        states, nominals, rounds = states | fmu.states_changed, nominals | fmu.nominals_changed, rounds + 1
        if rounds > _ROUNDS:
            return TOO_MANY_EVENTS
        if fmu.next_time <= run.t:  # due at once, as some FMUs say instead of asking for another round
            fmu.again = 1
    status = enter_continuous_mode(fmu)
    if states != 0:
        status = max(status, get_states(fmu, work.x, work.n))
    if nominals != 0:
        status = max(status, get_nominals(fmu, work.nominal, work.n))
    run.next_event = fmu.next_time
    run.status = max(run.status, status)
    return MODEL_ERROR if run.status > WARNING else RUNNING


@native
def handle_event(job: Any) -> int:
    """Event at run.t, where the FMU stands; inputs take their values to the right of it."""
    run = job.run
    run.events += 1
    run.crowd += 1
    if run.crowd > _CROWD:
        return TOO_MANY_EVENTS
    status = enter_event_mode(job.fmu)
    if status <= WARNING:
        status = max(status, set_inputs(job, run.t))
    run.status = max(run.status, status)
    return settle(job) if status <= WARNING else MODEL_ERROR
