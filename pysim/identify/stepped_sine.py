"""The frequency-response test of thesis Section 2.1.1: one experiment per frequency, with a closed-form command."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from pysim.excitation import LeadIn, SteppedSineCommand
from pysim.types import BadInput, Experiment, Signal, SineTest


@dataclass(frozen=True)
class SteppedSine:
    """How a stepped-sine test is run; the times are those of thesis Section 2.1.1 and Figure 2.1.

    Args:
        rest: s at zero command.
        ramp: s from zero to the offset, in a straight line.
        hold: s at the offset before the sine starts; the sine starts with phase zero at rest + ramp + hold.
        settle_periods: smallest number of periods of the sine that are left out of the fit.
        settle_time: shortest time in s after the start of the sine that is left out of the fit. The pump's transients
            have decayed to 1e-4 of the amplitude by 0.3 s. `run_until_settled` doubles both if they are too short.
        settle_limit: longest time in s after the start of the sine to which settling is extended.
        fit_periods: whole periods recorded and fitted, the last ones of the test.
        points: samples per fitted period. They are equidistant over whole periods, so that the mean and every harmonic
            below points - 1 are orthogonal to the fitted sine.
    Raises:
        BadInput: a duration that is negative, or too few periods or points for a fit.
    """

    rest: float = 0.5
    ramp: float = 0.5
    hold: float = 1.0
    settle_periods: int = 1
    settle_time: float = 0.5
    settle_limit: float = 60.0
    fit_periods: int = 1
    points: int = 24

    def __post_init__(self) -> None:
        if min(self.rest, self.hold, self.settle_time, self.settle_limit) < 0 or not self.ramp > 0:
            raise BadInput("stepped sine: durations must not be negative, and the ramp must take some time")
        if self.settle_periods < 1:
            raise BadInput(f"stepped sine: leave at least one period out of the fit, got {self.settle_periods}")
        if self.fit_periods < 1 or self.points < 5:
            raise BadInput(
                f"stepped sine: a fit needs one whole period of five points, "
                f"got {self.fit_periods} periods of {self.points} points"
            )

    @property
    def onset(self) -> float:
        """Start of the sine, s from the start of the test."""
        return self.rest + self.ramp + self.hold

    def settling_periods(self, frequency: float) -> int:
        """Whole periods left out at this frequency (Hz): the larger of both limits."""
        return max(self.settle_periods, math.ceil(self.settle_time * frequency - 1e-9))

    def settling_twice_as_long(self) -> SteppedSine:
        """The same plan with twice the settling."""
        return replace(self, settle_periods=2 * self.settle_periods, settle_time=2 * self.settle_time)

    @property
    def lead_points(self) -> int:
        """Samples in the half period before the fitted periods, which shows whether the output is periodic."""
        return self.points // 2


def command(test: SineTest, frequency: float, plan: SteppedSine) -> Signal:
    """The command: rest, ramp, hold, then amplitude sin(2 pi f (t - onset)) + offset without an end; frequency in Hz.

    Source: thesis Eq. 2.1 and Section 2.1.1, steps 1 and 2. The ramp down of step 3 is left out.
    """
    lead = LeadIn(plan.rest, plan.ramp, plan.hold)
    return SteppedSineCommand(test.offset, test.amplitude, frequency, math.inf, lead).signal()


def stepped_sine(
    test: SineTest,
    frequency: float,
    *,
    plan: SteppedSine | None = None,
    rate_input: str | None = None,
    overrides: Mapping[str, float] | None = None,
) -> Experiment:
    """The test at one frequency; only the last whole periods of the output are recorded.

    Args:
        test: offset and amplitude; the model's input and output.
        frequency: Hz, positive.
        plan: durations, periods and sampling; those of the thesis by default.
        rate_input: a second input that gets the command's exact derivative, in the input's unit per s.
        overrides: parameter of the model -> value.
    Raises:
        BadInput: a frequency that is not positive.
    """
    plan = plan or SteppedSine()
    if not (frequency > 0 and math.isfinite(frequency)):
        raise BadInput(f"stepped sine: the frequency must be positive and finite, got {frequency} Hz")
    inputs = {test.input: command(test, frequency, plan)}
    rates = {} if rate_input is None else {rate_input: test.input}
    first = plan.onset + plan.settling_periods(frequency) / frequency
    times = first + np.arange(plan.fit_periods * plan.points) / (plan.points * frequency)
    return Experiment(times, (test.output,), inputs, overrides or {}, rates=rates)
