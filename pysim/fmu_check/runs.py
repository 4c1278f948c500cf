"""Runs: co-simulation against model exchange under a tight solver, over step sizes, and the order of convergence."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from fmpy import simulate_fmu
from numpy.typing import NDArray

from pysim.fmu_check.instance import CallFailed, opened
from pysim.fmu_check.points import Points
from pysim.fmu_check.result import DOUBTFUL, FAILS, HOLDS, CheckResult, none_of, skipped, within
from pysim.fmu_check.stepping import stepped
from pysim.fmu_check.subject import CO_SIMULATION, MODEL_EXCHANGE, Subject, limit, references

Array = NDArray[np.float64]
RUNS, STEPS, ORDER = "runs", "step size", "order"
_TIGHT, _LOOSER = 1e-9, 1e-7  # CVODE's relative tolerance; the two runs tell what the reference itself is worth
_CLOSE, _FAR = 1e-3, 1e-2  # of a variable's range: good agreement, and what no step size may leave
_PARTS = (4, 32)  # of the smallest communication step, to see a solver's own
_GRID = 50  # points at which runs are compared
_SMALLEST_ORDER, _FIRST_ORDER = 1.6, 0.7
_STAGES = (32, 64, 128)
_SHORTER = (1.0, 0.1, 0.01, 1e-3)  # of the span, as a model may get faster on its way
_LOST = 0.01  # error as a share of a state's size from which on a method is far from converging


def check_runs(subject: Subject) -> Iterator[CheckResult]:
    """Both kinds of the FMU give one answer, whatever the communication step."""
    if CO_SIMULATION not in subject.kinds:
        yield skipped(RUNS, "co-simulation runs", "the FMU has none")
        return
    if not subject.shown:
        yield skipped(RUNS, "co-simulation runs", "no real variable of the FMU changes with time")
        return
    fine, middle, coarse = (_co_simulated(subject, parts) for parts in (4, 2, 1))
    steps = [_off(subject, run, fine) for run in (coarse, middle)]
    claim = "co-simulation gives the same with steps four times as large"
    if steps[0] > _CLOSE and steps[1] < 0.75 * steps[0]:
        detail = (
            f"steps of {4 * _size(subject):.2g} s differ, half of that by {steps[1]:.1e}: a solver bound to the step"
        )
        yield CheckResult(STEPS, claim, DOUBTFUL, detail, steps[0], _CLOSE, "of the range")
    else:
        yield within(STEPS, claim, steps[0], _CLOSE, "of the range")
    claim = "co-simulation follows model exchange under a tight solver"
    if MODEL_EXCHANGE not in subject.kinds:
        yield skipped(RUNS, claim, "the FMU has no model exchange")
        return
    try:
        reference, looser = (_reference(subject, tolerance) for tolerance in (_TIGHT, _LOOSER))
    except RuntimeError as error:  # of CVODE, that is, not of the FMU
        yield skipped(RUNS, claim, f"the reference solver gives up: {str(error).splitlines()[0][:150]}")
        return
    doubt = _off(subject, looser, reference)
    if not doubt < _CLOSE:
        yield skipped(RUNS, claim, f"the reference itself moves by {doubt:.1e} of the range with its tolerance")
        return
    errors = [_off(subject, run, reference) for run in (coarse, middle, fine)]
    shrinks = errors[2] < 0.75 * errors[1] < 0.6 * errors[0]
    told = ", ".join(f"{e:.1e}" for e in errors)
    verdict = HOLDS if errors[2] <= _CLOSE else DOUBTFUL if errors[2] <= _FAR or shrinks else FAILS
    detail = f"with steps h, h/2, h/4: {told}"
    if verdict == FAILS and _has_fixed_steps(subject):
        verdict, detail = DOUBTFUL, f"{detail}; its solver takes steps of a fixed size, whatever the communication step"
    yield CheckResult(RUNS, claim, verdict, detail, errors[2], _CLOSE, "of the range")


def _size(subject: Subject) -> float:
    """s: the smallest communication step of the runs."""
    return max(subject.step, (subject.stop - subject.start) / (40 * _GRID))


def _co_simulated(subject: Subject, parts: int) -> Array:
    """Shown variables (n_t, n) at the times all runs share; `parts` communication steps between two of them."""
    rows, size = references(subject.shown), _size(subject) * 4 / parts
    count = max(4, int((subject.stop - subject.start) / (4 * _size(subject)) + 1e-6)) * parts
    with opened(subject, CO_SIMULATION) as instance:
        instance.begin(references(subject.inputs), subject.excitation())
        instance.finish()
        run = stepped(subject, instance, rows, size, count, subject.excitation())
    return run[parts - 1 :: parts]


def _has_fixed_steps(subject: Subject) -> bool:
    """Whether nothing changes in most of the communication steps once these are short enough."""
    rows, inputs = references(subject.shown), subject.excitation()
    for parts in _PARTS:
        with opened(subject, CO_SIMULATION) as instance:
            instance.begin(references(subject.inputs), inputs)
            instance.finish()
            run = stepped(subject, instance, rows, _size(subject) / parts, 8 * parts, inputs)
        changes = int(np.any(np.diff(run, axis=0) != 0, axis=1).sum())
        if 0 < changes <= len(run) // 2:
            return True
    return False


def _reference(subject: Subject, tolerance: float) -> Array:
    """The same by model exchange and CVODE, as far as the FMU goes."""
    size = 4 * _size(subject)
    count = max(4, int((subject.stop - subject.start) / size + 1e-6))
    names = [v.name for v in subject.inputs]
    kinds = np.dtype([("time", np.float64), *((name, np.float64) for name in names)])
    signals = np.array([(subject.start, *subject.excitation())], dtype=kinds) if names else None
    result = simulate_fmu(
        str(subject.folder),
        validate=False,
        fmi_type="ModelExchange",
        model_description=subject.description,
        start_time=subject.start,
        stop_time=subject.start + count * size,
        output_interval=size,
        relative_tolerance=tolerance,
        input=signals,
        output=[v.name for v in subject.shown],
        record_events=False,
        step_finished=lambda time, recorder: _goes_on(subject),
    )
    wanted = subject.start + size * np.arange(1, count + 1)
    wanted = wanted[wanted <= result["time"][-1] + 1e-3 * size]  # the FMU may end the simulation
    return np.column_stack([np.interp(wanted, result["time"], result[v.name]) for v in subject.shown])


def _goes_on(subject: Subject) -> bool:
    subject.alive()
    return True


def _off(subject: Subject, run: Array, reference: Array) -> float:
    """Largest difference of any shown variable, as a share of its range or, where it stands still, of its size."""
    n = min(len(run), len(reference))
    if n == 0:
        return 0.0
    difference = np.abs(run[:n] - reference[:n]).max(axis=0, initial=0.0)
    nominal = np.array([abs(limit(v, "nominal") or 1.0) for v in subject.shown])
    still = np.maximum(np.abs(reference).max(axis=0, initial=0.0), nominal) * 1e-3
    return float((difference / np.maximum(np.ptp(reference, axis=0), still)).max(initial=0.0))


def check_order(subject: Subject) -> Iterator[CheckResult]:
    """Heun's method of order two over a short time: a right-hand side that is none would not converge."""
    claim = "a method of order two converges with order two"
    if MODEL_EXCHANGE not in subject.kinds or not subject.states:
        yield skipped(ORDER, claim, "the FMU has no model exchange, or no states")
        return
    with opened(subject, MODEL_EXCHANGE) as instance:
        points = Points(subject, instance.start())
        points.instance.set(references(subject.inputs), subject.excitation(0.05))
        start, span = points.around(1, 0.05)[0][: len(subject.states)], _span(points)
        if not np.isfinite(span):
            yield skipped(ORDER, claim, "the derivatives do not move with the states")
            return
        span, errors = _errors(points, start, span)
    if not max(errors) < _LOST:
        yield skipped(ORDER, claim, f"an explicit method gets lost within {span:.1e} s")
        return
    if errors[0] <= 1e-9:
        yield none_of(ORDER, claim, [], note="nothing moves so fast that an error would show")
        return
    order = float(np.log2(errors[0] / errors[-1]) / 2) if errors[-1] > 0 else np.inf
    verdict = HOLDS if order >= _SMALLEST_ORDER else DOUBTFUL if order >= _FIRST_ORDER else FAILS
    detail = f"errors {', '.join(f'{e:.1e}' for e in errors)} over {span:.1e} s" + (
        "" if verdict == HOLDS else "; kinks and events lower it"
    )
    yield CheckResult(ORDER, claim, verdict, detail, order, None, "")


def _errors(points: Points, start: Array, span: float) -> tuple[float, list[float]]:
    """A span, the given one or a shorter one in which Heun's method does not get lost, and the errors at its end.

    The method may leave the region where the model can be evaluated; only the shortest span has to be obeyed.
    """
    size = points.sizes[: start.size]
    errors = [np.inf]
    for shorter in _SHORTER:
        try:
            ends = [_heun(points, start, shorter * span, n) for n in (*_STAGES, 16 * _STAGES[-1])]
        except CallFailed:
            if shorter == _SHORTER[-1]:
                raise
            continue
        errors = [float((np.abs(end - ends[-1]) / size).max()) for end in ends[:-1]]
        if max(errors) < _LOST:
            return shorter * span, errors
    return _SHORTER[-1] * span, errors


def _span(points: Points) -> float:
    """s: ten steps of the fastest rate at the start, from differences."""
    n = len(points.knowns) - len(points.instance.subject.inputs)
    with np.errstate(all="ignore"):
        jacobian = np.array([points.slope(points.home, k, 1e-6)[:n] for k in range(n)]).T
    if not np.isfinite(jacobian).all():
        return np.inf
    fastest = np.abs(np.linalg.eigvals(jacobian)).max(initial=0.0)
    return 10.0 / float(fastest) if fastest > 0 else np.inf


def _heun(points: Points, start: Array, span: float, count: int) -> Array:
    """States (n_x,) after `count` steps."""
    instance, x, h = points.instance, start.copy(), span / count
    for k in range(count):
        first = _rate(points, points.instance.subject.start + k * h, x)
        second = _rate(points, points.instance.subject.start + (k + 1) * h, x + h * first)
        x = x + h / 2 * (first + second)
    instance.raw.setTime(points.instance.subject.start)
    return x


def _rate(points: Points, time: float, x: Array) -> Array:
    points.instance.raw.setTime(time)
    points.instance.set_states(x)
    return points.instance.dx
