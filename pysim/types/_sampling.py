"""The sampling interval of a log whose times are printed with few digits, and which may lack samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_GAP = 1.5  # sampling intervals: a longer one lacks samples
# So much of an interval the last printed digit may be: nobody can tell a coarser one from uneven sampling.
_PRINTED = 0.2
# A coarser one makes intervals of two lengths out of even ones. They are no gaps where the longer are more than this
# share and all of the times are, by so many digits, on a line.
_OFTEN, _LINE = 0.02, 1.5
_DIGITS = 9
_GLANCE = 64  # times that mostly show that a digit is not the last
_ROUNDING, _DOUBLE = 1e-6, 1e-12  # of a count of digits, and of its size


@dataclass(frozen=True)
class Sampling:
    """How the times of a log follow each other.

    Args:
        step: s, mean interval without the gaps; the median of printed times may be off by half their last digit.
        digit: s, the last one that the times are printed with; 0 where it is too coarse for the step, or there is none.
        gaps: (n_g,) numbers of the intervals that lack samples.
    """

    step: float
    digit: float
    gaps: NDArray[np.int64]


def sampling(time: Array) -> Sampling:
    """Of the times (n_t,) of a log in s, two or more."""
    intervals, digit = np.diff(time), _last_digit(time)
    median = float(np.median(intervals))
    wide = intervals > _GAP * median
    if digit > _PRINTED * median and np.mean(wide) > _OFTEN:
        wider = intervals > _GAP * median + digit * (1 + _ROUNDING)
        wide = wider if _on_a_line(time, wider, digit) else wide
    step = float(np.mean(intervals[~wide]))
    return Sampling(step, digit if digit <= _PRINTED * step else 0.0, np.flatnonzero(wide))


def _on_a_line(time: Array, gaps: NDArray[np.bool_], digit: float) -> bool:
    """Whether the longest stretch without gaps is an even clock, rounded to a digit."""
    edges = np.concatenate([[0], np.flatnonzero(gaps) + 1, [time.size]])
    longest = int(np.argmax(np.diff(edges)))
    stretch = time[edges[longest] : edges[longest + 1]]
    count = np.arange(stretch.size)
    off = stretch - np.polyval(np.polyfit(count, stretch - stretch[0], 1), count)
    return bool(stretch.size > 2 and np.ptp(off) <= _LINE * digit)


def _last_digit(time: Array) -> float:
    """Unit of the last digit that all times (n_t,) are printed with, s; 0 where there is none."""
    return next((10.0**-d for d in range(_DIGITS) if _whole(time[:_GLANCE] * 10.0**d) and _whole(time * 10.0**d)), 0.0)


def _whole(counts: Array) -> bool:
    return bool(np.all(np.abs(counts - np.round(counts)) < _ROUNDING + _DOUBLE * np.abs(counts)))
