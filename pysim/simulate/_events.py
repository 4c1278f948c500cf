"""Events: where an indicator changes its sign, and what the model does about it."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate._fmu_calls import (
    OK,
    WARNING,
    enter_continuous_mode,
    enter_event_mode,
    get_indicators,
    get_nominals,
    get_states,
    update_discrete,
)
from pysim.simulate._inputs import set_inputs
from pysim.simulate._native import native
from pysim.simulate._point import evaluate, set_point
from pysim.simulate._recording import interpolate
from pysim.simulate._state import MODEL_ERROR, NOT_FINITE, RUNNING, TERMINATED, TOO_MANY_EVENTS

_EPS = 2.220446049250313e-16
_ROUNDS = 1000  # of one event iteration
_CROWD = 1000  # events without time moving on
_SEARCH = 100  # evaluations to locate one event; bisection alone needs 53


@native
def crossed(before: Any, after: Any) -> bool:
    """Whether an indicator changed between > 0 and <= 0."""
    for i in range(before.size):
        if (before[i] > 0.0) != (after[i] > 0.0):
            return True
    return False


@native
def _secant(work: Any, a: float, b: float) -> float:
    """First crossing in [a, b], by straight lines through the indicators work.z at a and work.z_new at b."""
    first = b
    for i in range(work.z.size):
        before, after = work.z[i], work.z_new[i]
        if (before > 0.0) != (after > 0.0) and after != before:
            first = min(first, a + (b - a) * before / (before - after))
    return first


@native
def locate(fmu: Any, inputs: Any, run: Any, work: Any, h: float) -> tuple[int, float]:
    """Share of the step just after its first sign change; work.z and work.z_new hold the indicators at its ends.

    Secant steps kept half a tolerance away from either end of the bracket, so that both ends close in, and every third
    step a bisection, so that they always do. work.dense is filled; changes work.z_new and work.x_try.
    """
    a, b, status = 0.0, 1.0, OK
    z_start = work.z.copy()
    width = 4.0 * _EPS * max(abs(run.t), abs(run.t + h)) / h
    for count in range(_SEARCH):
        if b - a <= width or status > WARNING:
            break
        theta = 0.5 * (a + b) if count % 3 == 2 else _secant(work, a, b)
        theta = min(max(theta, a + 0.5 * width), b - 0.5 * width)
        interpolate(work, theta)
        status = max(status, set_point(fmu, inputs, run, run.t + theta * h, work.x_try))
        status = max(status, get_indicators(fmu, work.z_try))
        if crossed(z_start, work.z_try):
            b = theta
            work.z_new[:] = work.z_try
        else:
            a = theta
            work.z[:] = work.z_try
    work.z[:] = z_start
    return status, b


@native
def enter_event(fmu: Any, run: Any) -> int:
    """Switch to event mode at run.t; counts events that crowd at one time."""
    run.events += 1
    status = enter_event_mode(fmu)
    run.status = max(run.status, status)
    return MODEL_ERROR if status > WARNING else RUNNING


@native
def iterate(fmu: Any, run: Any, work: Any, asks: Any) -> int:
    """Event iteration up to continuous-time mode; the outcome if the run ends here, else RUNNING."""
    states, nominals = 0, 0
    for _ in range(_ROUNDS):
        status = update_discrete(fmu, asks, work.flags, work.time)
        run.status = max(run.status, status)
        if status > WARNING:
            return MODEL_ERROR
        states, nominals = states | asks.states, nominals | asks.nominals
        if asks.terminate != 0:
            return TERMINATED
        if asks.again == 0:
            break
    else:
        return TOO_MANY_EVENTS
    status = enter_continuous_mode(fmu)
    if states != 0:
        status = max(status, get_states(fmu, work.x))
    if nominals != 0:
        status = max(status, get_nominals(fmu, work.nominal))
    run.next_event = asks.next_time
    run.status = max(run.status, status)
    return MODEL_ERROR if status > WARNING else RUNNING


@native
def restart(fmu: Any, inputs: Any, run: Any, work: Any) -> int:
    """Derivatives and indicators at run.t, where something changed."""
    status = evaluate(fmu, inputs, run, run.t, work.x, work.dx)
    if status <= WARNING:
        status = max(status, get_indicators(fmu, work.z))
    run.status = max(run.status, status)
    if status > WARNING:
        return MODEL_ERROR
    for value in work.dx:
        if not np.isfinite(value):
            return NOT_FINITE
    return RUNNING


@native
def handle_event(fmu: Any, inputs: Any, run: Any, work: Any, asks: Any) -> int:
    """Event at run.t, where the FMU stands; the inputs may jump to their values on the right."""
    run.crowd += 1
    if run.crowd > _CROWD:
        return TOO_MANY_EVENTS
    code = enter_event(fmu, run)
    if code == RUNNING:
        status = set_inputs(fmu, inputs, run.t, run.horizon)
        run.status = max(run.status, status)
        code = iterate(fmu, run, work, asks) if status <= WARNING else MODEL_ERROR
    return code
