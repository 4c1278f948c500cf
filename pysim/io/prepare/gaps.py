"""Samples that are missing: filled where they are few, cut out where they are many."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pysim.io.prepare.cut import pieces
from pysim.io.prepare.step import each_log, stands
from pysim.types import BadInput, Dataset, MeasuredRecord, Record, sampling

Array = NDArray[np.float64]

_ROUNDING = 1e-6


@dataclass(frozen=True)
class FillGaps:
    """Fill what is missing by straight lines, up to a length; a log with more missing is cut there.

    Commands that stand between their samples keep the last one.

    Args:
        longest: s, from the sample ahead of what is missing to the one behind it.
        shortest: samples; shorter pieces of a log that is cut are left out.
    """

    word: ClassVar[str] = "fill_gaps"
    star: ClassVar[str] = ""
    longest: float
    shortest: int = 10

    def apply(self, dataset: Dataset) -> Dataset:
        if self.longest < 0:
            raise BadInput(f"the longest gap is {self.longest:g} s; give 0 or more")

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            held = [stands(dataset, record, name) for name in log.names]
            whole, cuts = self._filled(log, held)
            missing = np.asarray(~np.isfinite(whole.values).all(axis=1))
            if not (missing.any() or cuts.size):
                yield record if whole is log else replace(record, data=whole)
                return
            bounds = _pieces(missing, cuts)
            yield from pieces(record, whole, [(a, b) for a, b in bounds if b - a >= max(self.shortest, 2)])

        return each_log(dataset, change)

    def _filled(self, log: Record, held: list[bool]) -> tuple[Record, NDArray[np.intp]]:
        """The log with short gaps filled, and the rows behind which samples are still missing."""
        longest = self.longest * (1 + _ROUNDING)
        found, intervals = sampling(log.time), np.diff(log.time)
        short = [int(k) for k in found.gaps if intervals[k] <= longest]
        if not short and np.isfinite(log.values).all():
            return log, found.gaps
        counts = [max(round(intervals[k] / found.step), 2) - 1 for k in short]
        pairs = zip(short, counts, strict=True)
        added = [t for k, n in pairs for t in np.linspace(log.time[k], log.time[k + 1], n + 2)[1:-1]]
        places = np.repeat(np.array(short, dtype=np.intp) + 1, counts)
        time, values = np.insert(log.time, places, added), np.insert(log.values, places, np.nan, axis=0)
        for column, stays in zip(values.T, held, strict=True):
            _fill(time, column, longest, held=stays)
        cuts = np.flatnonzero(np.isin(time[:-1], log.time[[k for k in found.gaps if k not in short]]))
        return replace(log, time=time, values=values), cuts


def _fill(time: Array, column: Array, longest: float, *, held: bool) -> None:
    """Fill in place the runs that are missing and not longer, between two samples."""
    there = np.flatnonzero(np.isfinite(column))
    if there.size < 2:
        return
    left, right = there[:-1], there[1:]
    runs = (right - left > 1) & (time[right] - time[left] <= longest)
    for a, b in zip(left[runs], right[runs], strict=True):
        inner = slice(a + 1, b)
        column[inner] = column[a] if held else np.interp(time[inner], time[[a, b]], column[[a, b]])


def _pieces(missing: NDArray[np.bool_], cuts: NDArray[np.intp]) -> list[tuple[int, int]]:
    """Rows (first, stop) between those that are missing and the cuts behind rows."""
    edges = sorted({0, missing.size, *(int(k) + 1 for k in cuts)})
    found = []
    for first, stop in pairwise(edges):
        there = np.concatenate([[False], ~missing[first:stop], [False]]).astype(np.int8)
        turns = np.flatnonzero(np.diff(there))
        found += [(first + int(a), first + int(b)) for a, b in turns.reshape(-1, 2)]
    return found
