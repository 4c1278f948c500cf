"""Periodic steady states the long way: simulate until a period repeats the one before."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Solver
from pysim.simulate._foreign import Opened
from pysim.simulate._pool import Stopped
from pysim.simulate._run import run
from pysim.types import Experiment, Outcome, Record

Array = NDArray[np.float64]

_FIRST = 4  # periods, at least; then twice as many
_FIRST_TIME = 0.5  # s, at least
_LAST = 512  # periods
_LAST_TIME = 60.0  # s, at most, but for one doubling
_REPEATS = 1e-3  # of an output's amplitude: what may change from one period to the next


@dataclass(frozen=True)
class Settled:
    """The last period of a run that repeats itself; or the run, and why it cannot be used."""

    record: Record
    periods: int
    trouble: str = ""


def settle_down(library: Opened, period: Experiment, solver: Solver, stopped: Stopped) -> Settled:
    """Simulate from the model's own start until what is recorded repeats.

    Args:
        period: one period from time 0, its end included; its inputs hold for all times.
    """
    length = float(period.times[-1])
    periods = max(_FIRST, int(np.ceil(_FIRST_TIME / length)))
    while True:
        settled = after(library, period, solver, periods, stopped)
        if not settled.trouble or settled.record.outcome is not Outcome.DONE or stopped():
            return settled
        if 2 * periods > _LAST or 2 * periods * length > max(_LAST_TIME, 4 * _FIRST * length):
            return replace(settled, trouble=f"what is recorded does not repeat after {periods} periods")
        periods *= 2


def after(library: Opened, period: Experiment, solver: Solver, periods: int, stopped: Stopped) -> Settled:
    """The last of that many periods from the model's own start, and whether it repeats the one before."""
    length, points = float(period.times[-1]), period.times.size - 1
    times = np.concatenate([period.times[:-1] + (periods - 2) * length, period.times + (periods - 1) * length])
    record = run(library, replace(period, times=times), solver, stopped)
    if record.outcome is not Outcome.DONE or len(record.values) < times.size:
        return Settled(record, periods, record.message or record.outcome.value)
    before, last = record.values[:points], record.values[points:-1]
    amplitude = 0.5 * np.ptp(last, axis=0)
    change = np.max(np.abs(last - before), axis=0)
    moving = change > 1e-9 * np.max(np.abs(last), axis=0, initial=0.0)
    trouble = "it does not repeat" if np.any(moving & (change > _REPEATS * amplitude)) else ""
    return Settled(replace(record, time=period.times[:-1], values=last), periods, trouble)
