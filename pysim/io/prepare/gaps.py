"""Samples that are missing: filled where they are few, cut out where they are many, refused where a step needs all."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pysim.io.counted import counted
from pysim.io.prepare.cut import pieces
from pysim.io.prepare.log_names import short_name
from pysim.io.prepare.step import call, each_log, stands
from pysim.types import BadInput, Dataset, MeasuredRecord, Record, sampling

Array = NDArray[np.float64]

_ROUNDING = 1e-6
_FILLED = 10.0  # sampling intervals: longest gap that is filled by a straight line


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


def fill_of(dataset: Dataset) -> FillGaps | None:
    """The step that fills short gaps in all logs and cuts logs at longer ones; None if nothing is missing."""
    short, steps, any_missing = [0.0], [], False
    for record in dataset.logs():
        log = record.data
        if isinstance(log, Record) and log.time.size > 1:
            step, lengths = sampling(log.time).step, _missing_lengths(log)
            any_missing |= bool(lengths)
            steps.append(step)
            short += [length for length in lengths if length <= _FILLED * step * 1.01]
    if not any_missing:
        return None
    return FillGaps(float(f"{max(*short, 1.5 * min(steps)) * 1.05:.2g}"))


def _missing_lengths(log: Record) -> list[float]:
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


def even_step(dataset: Dataset, record: MeasuredRecord, log: Record) -> float:
    """The sampling interval in s of a log that lacks no samples.

    Raises:
        BadInput: it has gaps.
    """
    refuse_missing_in(dataset, record, log)
    found = sampling(log.time)
    if found.gaps.size:
        raise BadInput(f"{record.source} lacks samples after {log.time[found.gaps[0]]:.6g} s; {_cure(dataset)}")
    return found.step


def refuse_missing_in(dataset: Dataset, record: MeasuredRecord, log: Record) -> None:
    """A log whose cells are all there.

    Raises:
        BadInput: one is empty, with its place and what fills it.
    """
    missing = ~np.isfinite(log.values)
    if missing.any():
        row, column = (int(index[0]) for index in np.nonzero(missing))
        count = counted(int(missing[:, column].sum()), "sample")
        where = f"{short_name(dataset, record)}: {log.names[column]} lacks {count}, the first at {log.time[row]:.6g} s"
        raise BadInput(f"{where}; {_cure(dataset)}")


def refuse_missing_samples(dataset: Dataset) -> None:
    """A data set without empty cells; nothing can be fitted to those.

    Raises:
        BadInput: a log has one, with its place and what fills it.
    """
    for record in dataset.logs():
        if isinstance(record.data, Record):
            refuse_missing_in(dataset, record, record.data)


def _cure(dataset: Dataset) -> str:
    """What to type where samples are missing."""
    step = fill_of(dataset)
    assert step is not None
    return (
        f"data = data.{call(step)} fills short gaps and cuts logs at longer ones; "
        f'in dataset.toml, preparation = [{{ step = "fill_gaps", longest = {step.longest:g} }}] below [dataset] does it'
    )
