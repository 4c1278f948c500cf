"""Search for the periodic part of a logged command."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Array = NDArray[np.float64]

# Limits of the difference between a command and itself one period ago: shares of its range (for quantisation), and a
# multiple of the median difference (for noise). All are tried, since a small wave may have a large offset.
_OF_RANGE = (1e-9, 1e-6, 1e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3)
_OF_TYPICAL = 8.0
# Largest mean square of that difference over the command's variance, for a periodic part; 2 for an aperiodic one.
_REPEATED = 0.3
# Parts count as equally good if their mean square is within this factor of the best one, plus `_GOOD`: quantisation
# steps may differ here and there.
_AS_GOOD = 4.0
_GOOD = 3e-3


def periodic_stretch(command: Array, size: int) -> slice:
    """The part of a command (n_t,) that is periodic with `size` samples, without lead-in, hold and way back.

    Of parts that are equally periodic, the longest one. A hold does not count, as it has no variance.

    Raises:
        BadInput: no part is periodic over two periods.
    """
    difference = np.abs(command[size:] - command[:-size])
    limits = [share * float(np.ptp(command)) for share in _OF_RANGE] + [_OF_TYPICAL * float(np.median(difference))]
    parts = {_part(command, difference, size, limit) for limit in limits}
    rated = [(_unlikeness(command, difference, size, part), part) for part in parts if part[1] - part[0] >= 2 * size]
    good = [(unlike, part) for unlike, part in rated if unlike <= _REPEATED]
    if not good:
        raise BadInput(
            f"multisine: the command does not repeat itself over two periods of {size} samples; correct the period, or "
            "say where the periods start"
        )
    best = min(good)[0]
    first, last = max(
        (part for unlike, part in good if unlike <= _AS_GOOD * best + _GOOD), key=lambda part: part[1] - part[0]
    )
    return slice(first, last)


def _part(command: Array, difference: Array, size: int, limit: float) -> tuple[int, int]:
    """First sample and end of the run below the limit that has the largest variance times length."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], difference <= limit, [False]])))
    runs = [(first, last + size) for first, last in edges.reshape(-1, 2).tolist()]
    return max(runs, key=lambda run: float(np.var(command[slice(*run)])) * (run[1] - run[0]), default=(0, 0))


def _unlikeness(command: Array, difference: Array, size: int, part: tuple[int, int]) -> float:
    """Mean square difference between a part's periods, over its variance."""
    variance = float(np.var(command[slice(*part)]))
    return float(np.mean(difference[part[0] : part[1] - size] ** 2)) / variance if variance > 0 else np.inf
