"""When a log has its rows."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Array = NDArray[np.float64]

MOST_ROWS = 20_000_000  # of one log
_ROUNDING = 1e-9  # of a sampling interval
_MOST_JITTER = 0.4  # of an interval: neighbouring samples keep their order


@dataclass(frozen=True)
class Logger:
    """How fast a logger samples, how evenly, and how finely it tells the time.

    Args:
        rates: (signals, Hz), more signals from row to row: the highest sampling rate with that many measured signals.
            Between two rows the time per sample grows evenly with the signals, as on a serial line; beyond the last
            row it goes on like that, and a single row holds for any number.
        jitter: s, standard deviation of the instants at which samples are taken; the time stamps tell the true ones.
        tick: s, step of the time stamps; 0 where they are exact.
    Raises:
        BadInput: no row, rows out of order, or a number that is negative, not finite, or longer than an interval.
    """

    rates: tuple[tuple[int, float], ...]
    jitter: float = 0.0
    tick: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "rates", tuple((int(count), float(rate)) for count, rate in self.rates))
        counts = [count for count, _ in self.rates]
        if not counts or counts[0] < 1 or any(b <= a for a, b in pairwise(counts)):
            raise BadInput(f"logger: rates for {counts} signals; name at least one number, increasing from 1")
        for count, rate in self.rates:
            if not (rate > 0 and math.isfinite(rate)):
                raise BadInput(f"logger: {rate:g} Hz for {count} signals; a rate must be positive and finite")
        for what, value in (("jitter", self.jitter), ("tick", self.tick)):
            if not 0 <= value < min(1 / rate for _, rate in self.rates):
                raise BadInput(f"logger: {what} is {value:g} s; it must be between 0 and a sampling interval")

    def rate(self, signals: int) -> float:
        """Hz with that many measured signals."""
        counts = np.array([count for count, _ in self.rates], dtype=np.float64)
        intervals = np.array([1 / rate for _, rate in self.rates])
        if signals <= counts[-1] or counts.size == 1:
            return float(1 / np.interp(signals, counts, intervals))
        slope = (intervals[-1] - intervals[-2]) / (counts[-1] - counts[-2])
        return float(1 / (intervals[-1] + slope * (signals - counts[-1])))

    def instants(self, start: float, end: float, signals: int, random: np.random.Generator) -> Array:
        """When samples are taken from start to end (s), both included where they fall on one: (n_t,) s, increasing.

        Raises:
            BadInput: more rows than a log can have.
        """
        rate = self.rate(signals)
        if not (end - start) * rate < MOST_ROWS:
            raise BadInput(
                f"logger: {(end - start) * rate:.3g} rows at {rate:.4g} Hz are more than {MOST_ROWS:,}; make the test "
                "shorter, or log more slowly"
            )
        count = math.floor((end - start) * rate + _ROUNDING) + 1
        times = start + np.arange(count) / rate
        if not self.jitter:
            return times
        away = np.clip(random.normal(0.0, self.jitter, count), -_MOST_JITTER / rate, _MOST_JITTER / rate)
        away[0] = 0.0
        return np.asarray(times + away)

    def stamps(self, instants: Array) -> Array:
        """What the log writes for those instants, s; where two fall on one tick the later one counts up."""
        if not self.tick:
            return instants
        ticks = np.round(instants / self.tick)
        return np.asarray((np.maximum.accumulate(ticks - np.arange(ticks.size)) + np.arange(ticks.size)) * self.tick)


# Section 3.1.3: the host's program reads the controller card over RS232 at most 250 times per second for one signal,
# 70 times for four. That the time per sample grows evenly in between is our assumption.
THESIS_LOGGER = Logger(((1, 250.0), (4, 70.0)))
