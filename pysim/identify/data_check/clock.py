"""How fast and how evenly a log was sampled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_GAP = 1.5  # sampling intervals: a longer one lacks samples


@dataclass(frozen=True)
class Clock:
    """The time base of a log.

    Args:
        start, duration: s.
        rate: Hz, from the median interval.
        jitter: standard deviation of the intervals without the gaps, as a share of the median one.
        gaps: (start, length) in s of every interval that lacks samples.
    """

    start: float
    duration: float
    rate: float
    jitter: float
    gaps: tuple[tuple[float, float], ...]


def clock(time: Array) -> Clock:
    """Read it off the times (n_t,) of a log in s, two or more."""
    intervals = np.diff(time)
    usual = float(np.median(intervals))
    wide = np.flatnonzero(intervals > _GAP * usual)
    even = np.delete(intervals, wide)
    return Clock(
        start=float(time[0]),
        duration=float(time[-1] - time[0]),
        rate=1 / usual,
        jitter=float(np.std(even)) / usual,
        gaps=tuple((float(time[k]), float(intervals[k])) for k in wide),
    )
