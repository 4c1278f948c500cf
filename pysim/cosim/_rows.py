"""When a described run writes its rows."""

from __future__ import annotations

import numpy as np

from pysim.cosim._prepare import tick_of
from pysim.cosim.member import Array
from pysim.types import BadInput

_MOST_ROWS = 10_000_000  # of a run; more would fill the memory
_NEAR = 1e-6  # of the distance of two rows: a row so near to the stop is the stop's


def row_times(start: float, stop: float, step: float, every: float) -> Array:
    """Times (n_t,) in s: every so many seconds from the start, and the stop, which ends the run.

    Args:
        step: s, of the communication points.
        every: s, between two rows.
    Raises:
        BadInput: the stop is no communication point, or there are too many rows.
    """
    if not (stop - start) / every <= _MOST_ROWS:
        wanted = (stop - start) / every
        raise BadInput(f"{wanted:.3g} rows are more than {_MOST_ROWS:,}; let rows be further apart (rows_every)")
    count = int((stop - start) / every + _NEAR)
    rows = np.asarray(start + every * np.arange(count + 1), dtype=np.float64)
    if stop - rows[-1] <= _NEAR * every:
        return rows
    tick = tick_of(stop, start, step, "stop =")
    return np.append(rows, start + tick * step)
