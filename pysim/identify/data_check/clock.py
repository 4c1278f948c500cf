"""Sampling rate, jitter and gaps of a log."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import sampling

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Clock:
    """The time base of a log.

    Args:
        start, duration: s.
        rate: Hz, from the mean interval without the gaps.
        jitter: standard deviation of these intervals, as a share of the mean, beyond what printing the times explains.
        gaps: (start, length) in s of every interval that lacks samples.
    """

    start: float
    duration: float
    rate: float
    jitter: float
    gaps: tuple[tuple[float, float], ...]


def clock(time: Array) -> Clock:
    """The time base from the times (n_t,) of a log in s, at least two."""
    intervals, found = np.diff(time), sampling(time)
    even = np.delete(intervals, found.gaps)
    printed = found.digit**2 / 4  # largest variance of the intervals that rounding causes
    return Clock(
        start=float(time[0]),
        duration=float(time[-1] - time[0]),
        rate=1 / found.step,
        jitter=math.sqrt(max(float(np.var(even)) - printed, 0.0)) / found.step,
        gaps=tuple((float(time[k]), float(intervals[k])) for k in found.gaps),
    )
