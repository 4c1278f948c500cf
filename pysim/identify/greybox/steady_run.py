"""The model's run for a steady sine: its periodic orbit, and the same test simulated over time as a transient."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.context import Context
from pysim.identify.greybox.observation import Run
from pysim.identify.greybox.settings import SteadySettings
from pysim.identify.greybox.sine_log import Sine
from pysim.identify.greybox.time_log import from_rest
from pysim.simulate import Periodic, Rodas, simulate
from pysim.types import Experiment, Model, Outcome, Signal, SineTest

Array = NDArray[np.float64]

_SETTINGS = SteadySettings()


def steady_run(
    context: Context,
    source: str,
    column: str,
    sine: Sine,
    outputs: tuple[str, ...],
    others: Mapping[str, Signal],
    settle: float,
    middle: float | None = None,
) -> Run:
    """The orbit of a stepped sine, and the same test as a transient, both recorded over one period from phase zero.

    Args:
        settle: shortest duration in s of the sine before the transient is recorded.
        middle: middle of the compared periods, s on the common clock of all records; None if not known.
    """
    plan, period = context.treatment.sine, 1 / sine.frequency
    name = context.variable(column)
    swing = Signal(
        np.zeros(1),
        np.array([[sine.offset, 0.0, 0.0, 0.0]]),
        np.array([[[sine.amplitude, 0.0, 2 * np.pi * sine.frequency, 0.0]]]),
    )
    rest, inputs = context.treatment.rest, {context.variable(c): signal for c, signal in others.items()}
    approached, start = swing, 0.0
    if rest is not None and sine.offset != context.first_value(name):
        approached, start = from_rest(swing, 0.0, context.first_value(name), rest.times(context.settling))
    settling = max(plan.settle_periods, int(np.ceil(settle / period - 1e-9)))
    times = (settling + np.arange(plan.points) / plan.points) * period
    later = 0.0 if middle is None else middle - float(np.mean(times))
    transient = context.experiment(times, outputs, {**inputs, name: approached}, start, later)
    if context.treatment.steady == "transient":
        return Run(source, transient)
    commands = {**inputs, name: swing}
    orbit = Periodic(
        period=period,
        points=plan.points,
        record=transient.record,
        inputs=commands,
        overrides=context.overrides,
        rates=context.model.rate_inputs(commands),
    )
    return Run(source, transient, orbit)


def settled_run(context: Context, source: str, test: SineTest, sine: Sine) -> Run:
    """The run for one frequency of a table, which does not say how long the bench let the plant settle.

    A transient settles for twice the time until the nominal model is periodic, since with other parameters it may be
    slower. If it never becomes periodic, it settles for the planned time.
    """

    def run(settle: float) -> Run:
        return steady_run(context, source, test.input, sine, (test.output,), {}, settle)

    planned = context.treatment.sine.settle_time
    planned = context.settling if planned is None else planned
    if context.treatment.steady == "transient":
        settle = planned
        while settle * sine.frequency < _SETTINGS.patience:
            if _repeats(context.model, run(settle).experiment, 1 / sine.frequency):
                return run(2 * settle)
            settle = 2 * max(settle, 1 / sine.frequency)
    return run(planned)


def _repeats(model: Model, experiment: Experiment, period: float) -> bool:
    """Whether the period after the recorded one is equal to it, within `SteadySettings.repeated`."""
    times = np.concatenate([experiment.times, experiment.times + period])
    record = simulate(model, replace(experiment, times=times), solver=Rodas(), check=False)
    if record.outcome is not Outcome.DONE:
        return False
    first, second = np.split(record.values, 2)
    return bool(np.max(np.abs(second - first)) <= _SETTINGS.repeated * np.ptp(second))
