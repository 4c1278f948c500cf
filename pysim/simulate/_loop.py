"""The native loop: step, locate, record, handle events. Python calls `integrate` and nothing else of it."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate._events import crossed, handle_event, iterate, locate, restart
from pysim.simulate._fmu_calls import (
    DISCARD,
    OK,
    WARNING,
    completed_step,
    get_indicators,
    get_nominals,
    get_states,
)
from pysim.simulate._method import attempt_step, dense_coefficients
from pysim.simulate._native import entry, native
from pysim.simulate._point import all_finite, error_norm, evaluate, set_point
from pysim.simulate._recording import interpolate, record_here, record_inside
from pysim.simulate._state import (
    DONE,
    MODEL_ERROR,
    NOT_FINITE,
    RUNNING,
    STEP_TOO_SMALL,
    TERMINATED,
    TOO_MANY_STEPS,
)

_EPS = 2.220446049250313e-16
_SAFETY, _SHRINK, _GROW, _FAILED = 0.9, 0.2, 5.0, 0.25


@entry
def integrate(method: Any, control: Any, fmus: Any, inputs: Any, breaks: Any, runs: Any, work: Any, rows: Any, all_asks: Any, budget: int) -> int:
    """Go on with a run for at most `budget` accepted steps; RUNNING or how it ended.

    Everything a run knows is in its arguments, so that Python may look in between (and be interrupted there).
    """
    fmu, run, asks = fmus[0], runs[0], all_asks[0]
    code = _begin(method, control, fmu, inputs, breaks, run, work, rows, asks) if run.segment < 0 else RUNNING
    for _ in range(budget):
        if code != RUNNING:
            break
        code = _advance(method, control, fmu, inputs, breaks, run, work, rows, asks)
    return code


@native
def _begin(method: Any, control: Any, fmu: Any, inputs: Any, breaks: Any, run: Any, work: Any, rows: Any, asks: Any) -> int:
    """First event iteration, states and derivatives; the FMU has left initialisation mode."""
    run.segment, run.horizon = 0, breaks.times[0]
    code = iterate(fmu, run, work, asks)
    if code != RUNNING:
        return code
    status = max(get_states(fmu, work.x), get_nominals(fmu, work.nominal))
    code = _resume(method, control, fmu, inputs, run, work)
    if status > WARNING or code != RUNNING:
        return MODEL_ERROR if status > WARNING else code
    return _record_point(fmu, inputs, breaks, run, work, rows)


@native
def _resume(method: Any, control: Any, fmu: Any, inputs: Any, run: Any, work: Any) -> int:
    """Start afresh at run.t: derivatives, indicators, and a first step that suits them."""
    code = restart(fmu, inputs, run, work)
    if code == RUNNING and control.step == 0.0:
        run.error_before = 1.0
        run.h = _first_step(method, control, fmu, inputs, run, work)
    return code


@native
def _norm(control: Any, work: Any, values: Any) -> float:
    work.error[:] = values
    work.x_new[:] = work.x
    return error_norm(control, work)


@native
def _first_step(method: Any, control: Any, fmu: Any, inputs: Any, run: Any, work: Any) -> float:
    """A step from the size of x, of dx, and of what an Euler step changes (Hairer, Norsett, Wanner I, II.4)."""
    span = min(run.horizon, run.next_event) - run.t
    size, rate = _norm(control, work, work.x), _norm(control, work, work.dx)
    h = min(1e-3 * span if rate * span < 1e-5 * size or rate == 0.0 else 0.01 * max(size, 1e-3) / rate, span, control.max_step)
    work.x_try[:] = work.x + h * work.dx
    status = evaluate(fmu, inputs, run, min(run.t + h, run.horizon), work.x_try, work.k[0])
    if status > WARNING or not all_finite(work.k[0]):
        return 0.01 * h
    curvature = _norm(control, work, work.k[0] - work.dx) / h
    largest = max(rate, curvature)
    reach = 100.0 * h if largest <= 0.0 else (0.01 / largest) ** (1.0 / method.error_order)
    return min(100.0 * h, reach, span, control.max_step)


@native
def _next_target(control: Any, run: Any) -> float:
    """The time that the next step must not pass: a break, a time event, or the next point of a fixed grid."""
    target = min(run.horizon, run.next_event)
    if control.step == 0.0:
        return target
    margin = 1e-9 * control.step
    while run.start + (run.grid + 1) * control.step <= run.t + margin:
        run.grid += 1
    grid = run.start + (run.grid + 1) * control.step
    return grid if grid + margin < target else target


@native
def _limit(control: Any, run: Any, target: float) -> tuple[float, bool]:
    """Length of the next step, and whether it ends at the target; no sliver is left for the step after."""
    left = target - run.t
    if control.step > 0.0 or left <= 1.01 * run.h:
        return left, True
    return min(run.h, 0.5 * left) if left < 2.0 * run.h else run.h, False


@native
def _factor(method: Any, run: Any, error: float) -> float:
    """Growth of the step by a proportional-integral rule (Hairer, Wanner II, IV.2)."""
    integral, proportional = 0.7 / method.error_order, 0.4 / method.error_order
    wanted = _SAFETY * max(error, 1e-10) ** -integral * max(run.error_before, 1e-4) ** proportional
    return min(max(wanted, _SHRINK), _GROW)


@native
def _step(method: Any, control: Any, fmu: Any, inputs: Any, run: Any, work: Any, target: float) -> tuple[int, float, bool]:
    """Attempt steps until one is accepted; outcome or RUNNING, its length, whether it ends at the target."""
    stages = work.k.shape[0] - 1
    while True:
        h, hits = _limit(control, run, target)
        status, error = attempt_step(method, control, fmu, inputs, run, work, h)
        if status <= WARNING and error <= 1.0 and not method.end_in_error:
            t_new = target if hits else run.t + h
            status = evaluate(fmu, inputs, run, t_new, work.x_new, work.k[stages])
        usable = status <= WARNING and error == error and all_finite(work.k[stages])
        if usable and error <= 1.0:
            break
        run.rejected += 1
        run.status = max(run.status, status)
        if status > DISCARD:
            return MODEL_ERROR, h, hits
        run.h = h * (max(_SAFETY * error ** (-1.0 / method.error_order), _SHRINK) if usable else _FAILED)
        if control.step > 0.0 or run.h <= 4.0 * _EPS * max(abs(run.t), abs(target)):
            return _why_stuck(status, usable), h, hits
    if control.step == 0.0:
        grown = h * _factor(method, run, error)
        run.h = min(max(grown, run.h) if hits else grown, control.max_step)
        run.error_before = error
    return RUNNING, h, hits


@native
def _why_stuck(status: int, usable: bool) -> int:
    return STEP_TOO_SMALL if usable or status > WARNING else NOT_FINITE


@native
def _record_point(fmu: Any, inputs: Any, breaks: Any, run: Any, work: Any, rows: Any) -> int:
    status = record_here(fmu, inputs, run, work, rows)
    run.status = max(run.status, status)
    if status > WARNING:
        return MODEL_ERROR
    return DONE if run.t >= breaks.times[-1] else RUNNING


@native
def _advance(method: Any, control: Any, fmu: Any, inputs: Any, breaks: Any, run: Any, work: Any, rows: Any, asks: Any) -> int:
    """One accepted step with all that happens in it and at its end."""
    target = _next_target(control, run)
    code, h, hits = _step(method, control, fmu, inputs, run, work, target)
    if code != RUNNING:
        return code
    run.steps += 1
    t_new, moved = target if hits else run.t + h, False
    status, event = get_indicators(fmu, work.z_new), crossed(work.z, work.z_new)
    inside = run.row < rows.times.size and rows.times[run.row] < t_new
    if event or inside:
        dense_coefficients(method, work, h)
        moved = True
    if event:
        status, theta = locate(fmu, inputs, run, work, h)
        if theta < 1.0:
            interpolate(work, theta)
            work.x_new[:] = work.x_try
            t_new, hits = run.t + theta * h, False
    status = max(status, record_inside(fmu, inputs, run, work, rows, h, t_new))
    if moved:
        status = max(status, set_point(fmu, inputs, run, t_new, work.x_new))
    status = max(status, completed_step(fmu, asks, work.flags))
    run.status = max(run.status, status)
    if status > WARNING:
        return MODEL_ERROR
    return _arrive(method, control, fmu, inputs, breaks, run, work, rows, asks, t_new, event)


@native
def _arrive(method: Any, control: Any, fmu: Any, inputs: Any, breaks: Any, run: Any, work: Any, rows: Any, asks: Any, t_new: float, event: bool) -> int:
    """Make the end of the step the current point; handle what is due there; record it."""
    if t_new - run.t > 1e-12 * max(abs(t_new), 1e-3 * abs(breaks.times[-1] - run.start)):
        run.crowd = 0
    run.t = t_new
    work.x[:] = work.x_new
    work.dx[:] = work.k[-1]
    work.z[:] = work.z_new
    if asks.terminate != 0:
        return TERMINATED
    event = event or asks.event != 0 or run.t >= run.next_event
    kink = False
    if run.t >= run.horizon and run.segment + 1 < breaks.times.size:
        kink, event = True, event or breaks.jumps[run.segment] != 0
        run.segment += 1
        run.horizon = breaks.times[run.segment]
    code = handle_event(fmu, inputs, run, work, asks) if event else RUNNING
    if code == RUNNING and (event or kink) and run.t < breaks.times[-1]:
        code = _resume(method, control, fmu, inputs, run, work)
    if code == RUNNING:
        code = _record_point(fmu, inputs, breaks, run, work, rows)
    if code == RUNNING and run.steps >= control.max_steps:
        return TOO_MANY_STEPS
    return code
