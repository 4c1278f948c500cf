"""Simulation of stepped sines until their output has settled, that is, until it is periodic."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pysim.identify.sine_fit import sine_fit
from pysim.identify.stepped_sine import SteppedSine
from pysim.types import Experiment, Outcome, Record, SineTest

# Share of the response's amplitude by which the output may change over the fitted periods. The remaining transient then
# changes the fit by less than 0.1 dB and 0.6 degrees; that of the pump is below a tenth of this.
TOLERANCE = 0.01
# A fitted amplitude below this share of the output's magnitude is rounding, not motion.
_ROUNDING = 1e-9
_UNSETTLED = "the output has not settled"


@dataclass(frozen=True)
class SteadyRun:
    """The fitted periods of one run, and why they cannot be used; empty if they can."""

    record: Record
    trouble: str = ""


def run_until_settled(
    tests: Sequence[tuple[SineTest, float]],
    make: Callable[[SineTest, float, SteppedSine], Experiment],
    run: Callable[[Sequence[Experiment]], Sequence[Record]],
    plan: SteppedSine,
) -> tuple[SteadyRun, ...]:
    """Run tests, and repeat those that have not settled with twice the settling time, up to the plan's limit.

    Args:
        tests: n pairs of test and frequency in Hz.
        make: returns the experiment of a test at a frequency, as `stepped_sine` builds it.
        run: runs experiments and returns a record for each, in their order.
        plan: plan of the first attempt.
    Returns:
        n runs in the order of the tests.
    """
    results: dict[int, SteadyRun] = {}
    waiting = list(range(len(tests)))
    while waiting:
        records = run([_recorded_earlier(make(*tests[i], plan), tests[i][1], plan) for i in waiting])
        again = []
        for i, record in zip(waiting, records, strict=True):
            test, frequency = tests[i]
            settled_for = plan.settling_periods(frequency) / frequency
            results[i] = _examine(record, test.output, frequency, plan)
            if results[i].trouble == _UNSETTLED and 2 * settled_for <= plan.settle_limit:
                again.append(i)
            elif results[i].trouble == _UNSETTLED:
                results[i] = replace(results[i], trouble=f"{_UNSETTLED} after {settled_for:g} s of the sine")
        waiting, plan = again, plan.settling_twice_as_long()
    return tuple(results[i] for i in range(len(tests)))


def _recorded_earlier(experiment: Experiment, frequency: float, plan: SteppedSine) -> Experiment:
    """The experiment, recorded from half a period before the fitted periods."""
    lead = experiment.times[0] - np.arange(plan.lead_points, 0, -1) / (plan.points * frequency)
    return replace(experiment, times=np.concatenate([lead, experiment.times]))


def _examine(record: Record, output: str, frequency: float, plan: SteppedSine) -> SteadyRun:
    """Cut off the half period before the fitted periods; the output has settled if the last half period equals it."""
    if record.outcome is not Outcome.DONE:
        return SteadyRun(record, f"{record.outcome.value}. {record.message}".strip())
    lead = plan.lead_points
    fitted = replace(record, time=record.time[lead:], values=record.values[lead:])
    values = record[output]
    amplitude = sine_fit(fitted.time, fitted[output], frequency).amplitude
    change = float(np.max(np.abs(values[-lead:] - values[:lead])))
    largest = float(np.max(np.abs(values)))
    if max(amplitude, change) <= _ROUNDING * largest:
        return SteadyRun(fitted, f"{output} does not move; there is no response to compare")
    return SteadyRun(fitted, _UNSETTLED if change > TOLERANCE * amplitude else "")
