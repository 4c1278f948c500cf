"""Single samples far off their neighbours."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from pysim.io.prepare.step import each_log, signals_of, with_columns
from pysim.types import Dataset, MeasuredRecord, Record

Array = NDArray[np.float64]

_BESIDE = 3  # samples to either side that tell where one should be
_GAP = 1.3  # of the usual span of seven samples: some of them are missing
_NORMAL = 1.4826  # standard deviations of a normal distribution in its median absolute deviation
_SMALL = 0.03  # of the signal's usual range: what is off by less is no outlier
_SHADOW = 0.4  # of the largest distance nearby: an outlier shifts the medians beside it as well, by less
_CUBIC = np.array([0.0, -1.0, 4.0, 0.0, 4.0, -1.0, 0.0]) / 6  # a cubic through the two samples on either side


@dataclass(frozen=True)
class DropOutliers:
    """Take out samples that are far off their neighbours, up to three in a row.

    What an output lacks then is not compared. Inputs get a straight line there, as a simulation needs all of them.

    Args:
        sigmas: how far from the median of the seven samples around it, in standard deviations of all such distances
            (by their median), and at least three percent of the signal's range: Hampel's filter. So that the top of a
            fast sine is none, the sample must be as far from a cubic through its neighbours.
            The three samples at either end are left alone.
        signals: their names; all outputs where there are none. A command may jump.
    Source: F. R. Hampel, The influence curve and its role in robust estimation, J. Am. Stat. Assoc. 69 (1974).
    """

    word: ClassVar[str] = "drop_outliers"
    star: ClassVar[str] = "signals"
    sigmas: float = 8.0
    signals: tuple[str, ...] = ()

    def apply(self, dataset: Dataset) -> Dataset:
        names = signals_of(dataset, self.signals, role="output")

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            columns = {}
            for name in names:
                wrong = outliers(log.time, log[name], self.sigmas) if name in log.names else np.zeros(0, dtype=bool)
                if wrong.any():
                    column = log[name].copy()
                    good = ~wrong & np.isfinite(column)
                    is_input = dataset.signal(name).role == "input"
                    column[wrong] = np.interp(log.time[wrong], log.time[good], column[good]) if is_input else np.nan
                    columns[name] = column
            yield with_columns(record, log, columns) if columns else record

        return each_log(dataset, change)


def outliers(time: Array, values: Array, sigmas: float) -> NDArray[np.bool_]:
    """(n_t,) which samples are far off their neighbours, see `DropOutliers`; none beside a gap, and none missing."""
    found = np.zeros(values.size, dtype=bool)
    there = np.flatnonzero(np.isfinite(values))
    width = 2 * _BESIDE + 1
    if there.size < 2 * width:
        return found
    own = values[there]
    near = sliding_window_view(own, width)
    limit = _SMALL * float(np.subtract(*np.quantile(own, [0.99, 0.01])))
    middle, cubic = (np.abs(near[:, _BESIDE] - expected) for expected in (np.median(near, axis=1), near @ _CUBIC))
    far = middle > _SHADOW * sliding_window_view(np.pad(middle, _BESIDE), width).max(axis=1)
    span = sliding_window_view(time[there], width)[:, [0, -1]] @ np.array([-1.0, 1.0])
    far &= span < _GAP * np.median(span)
    for away in (middle, cubic):
        far &= away > max(sigmas * _NORMAL * float(np.median(away)), limit)
    found[there[_BESIDE:-_BESIDE]] = far
    return found
