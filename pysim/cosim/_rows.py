"""When a described run writes its rows."""

from __future__ import annotations

import numpy as np

from pysim.cosim._prepare import tick_of
from pysim.cosim.member import Array

_NEAR = 1e-6  # of the distance of two rows: a row so near to the stop is the stop's


def row_times(start: float, stop: float, step: float, every: float) -> Array:
    """Times (n_t,) in s: every so many seconds from the start, and the stop, which ends the run.

    Args:
        step: s, of the communication points.
        every: s, between two rows.
    Raises:
        BadInput: the stop is no communication point.
    """
    count = int((stop - start) / every + _NEAR)
    rows = np.asarray(start + every * np.arange(count + 1), dtype=np.float64)
    if stop - rows[-1] <= _NEAR * every:
        return rows
    tick = tick_of(stop, start, step, "stop =")
    return np.append(rows, start + tick * step)
