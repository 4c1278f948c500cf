"""The sampling interval of a log whose times are printed with few digits, and which may lack samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_GAP = 1.5  # sampling intervals: a longer one lacks samples
# So much of an interval the last printed digit may be: nobody can tell a coarser one from uneven sampling.
_PRINTED = 0.2
_DIGITS = 9
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
    intervals = np.diff(time)
    wide = intervals > _GAP * float(np.median(intervals))
    step = float(np.mean(intervals[~wide]))
    return Sampling(step, _last_digit(time, step), np.flatnonzero(wide))


def _last_digit(time: Array, step: float) -> float:
    for digits in range(_DIGITS):
        unit = 10.0**-digits
        counts = time / unit
        if np.all(np.abs(counts - np.round(counts)) < _ROUNDING + _DOUBLE * np.abs(counts)):
            return unit if unit <= _PRINTED * step else 0.0
    return 0.0
