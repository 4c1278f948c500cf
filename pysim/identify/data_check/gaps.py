"""Missing data in logs: lost rows and empty cells, and the longest gaps that are filled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.io.prepare import FillGaps
from pysim.types import Dataset, Record, sampling

Array = NDArray[np.float64]

_FILLED = 10.0  # sampling intervals: longest gap that is filled by a straight line


def fill_of(dataset: Dataset) -> FillGaps | None:
    """The step that fills short gaps in all logs and cuts logs at longer ones; None if nothing is missing."""
    short, steps, any_missing = [0.0], [], False
    for record in dataset.logs():
        log = record.data
        if isinstance(log, Record) and log.time.size > 1:
            step, lengths = sampling(log.time).step, missing_lengths(log)
            any_missing |= bool(lengths)
            steps.append(step)
            short += [length for length in lengths if length <= _FILLED * step * 1.01]
    if not any_missing:
        return None
    return FillGaps(float(f"{max(*short, 1.5 * min(steps)) * 1.05:.2g}"))


def missing_lengths(log: Record) -> list[float]:
    """Duration in s of every gap in time and run of empty cells, between the samples around it; infinite at an end."""
    intervals = np.diff(log.time)
    lengths = [float(intervals[k]) for k in sampling(log.time).gaps]
    for column in log.values.T:
        if np.isnan(column).any():
            there = np.flatnonzero(np.isfinite(column))
            behind = np.flatnonzero(np.diff(there) > 1)
            lengths += [float(log.time[there[k + 1]] - log.time[there[k]]) for k in behind]
            if not there.size or there[0] > 0 or there[-1] < column.size - 1:
                lengths.append(float("inf"))  # at an end, there is no second sample to interpolate to
    return lengths


def whole_rows(log: Record) -> Record:
    """The log without rows in which a cell is empty."""
    whole = np.isfinite(log.values).all(axis=1)
    if whole.all():
        return log
    return Record(log.time[whole], log.values[whole], log.names, log.units, origin=log.origin)
