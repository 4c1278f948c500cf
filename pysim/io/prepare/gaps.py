"""Samples that are missing: filled where they are few, cut out where they are many, refused where a step needs all.

A simulation needs every sample of its inputs. Where an output was not measured, nothing is compared, and nothing needs
to be filled: what is made up would be fitted as if it had been measured.
"""

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
from pysim.io.prepare.step import call, each_log, signals_of, stands
from pysim.types import BadInput, Dataset, MeasuredRecord, Record, sampling

Array = NDArray[np.float64]

_ROUNDING = 1e-6
_FILLED = 10.0  # sampling intervals: longest gap that is filled by a straight line


@dataclass(frozen=True)
class FillGaps:
    """Fill what is missing of inputs by straight lines, up to a length; a log with more missing is cut there.

    Commands that stand between their samples keep the last one. Outputs stay as they are, and samples that are added
    in a gap have none: nothing is compared there.

    Args:
        longest: s, from the sample ahead of what is missing to the one behind it.
        signals: outputs that are filled as well, for a filter that needs all samples. They count as measured.
        shortest: samples; shorter pieces of a log that is cut are left out.
    """

    word: ClassVar[str] = "fill_gaps"
    star: ClassVar[str] = "signals"
    longest: float
    signals: tuple[str, ...] = ()
    shortest: int = 10

    def apply(self, dataset: Dataset) -> Dataset:
        if self.longest < 0:
            raise BadInput(f"the longest gap is {self.longest:g} s; give 0 or more")
        names = {*signals_of(dataset, self.signals), *inputs_of(dataset)} if self.signals else {*inputs_of(dataset)}

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            held = {k: stands(dataset, record, name) for k, name in enumerate(log.names) if name in names}
            whole, cuts = self._filled(log, held)
            missing = np.asarray(~np.isfinite(whole.values[:, [*held]]).all(axis=1))
            if not (missing.any() or cuts.size):
                yield record if whole is log else replace(record, data=whole)
                return
            bounds = _pieces(missing, cuts)
            yield from pieces(record, whole, [(a, b) for a, b in bounds if b - a >= max(self.shortest, 2)])

        return each_log(dataset, change)

    def _filled(self, log: Record, held: dict[int, bool]) -> tuple[Record, NDArray[np.intp]]:
        """The log with short gaps filled, and the rows behind which samples are still missing.

        Args:
            held: columns to fill, and whether each stands between its samples.
        """
        longest = self.longest * (1 + _ROUNDING)
        found, intervals = sampling(log.time), np.diff(log.time)
        short = [int(k) for k in found.gaps if intervals[k] <= longest]
        if not short and np.isfinite(log.values[:, [*held]]).all():
            return log, found.gaps
        counts = [max(round(intervals[k] / found.step), 2) - 1 for k in short]
        pairs = zip(short, counts, strict=True)
        added = [t for k, n in pairs for t in np.linspace(log.time[k], log.time[k + 1], n + 2)[1:-1]]
        places = np.repeat(np.array(short, dtype=np.intp) + 1, counts)
        time, values = np.insert(log.time, places, added), np.insert(log.values, places, np.nan, axis=0)
        for k, stays in held.items():
            _fill(time, values[:, k], longest, held=stays)
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


def inputs_of(dataset: Dataset) -> tuple[str, ...]:
    """Names of the inputs."""
    return tuple(signal.name for signal in dataset.signals if signal.role == "input")


def fill_of(dataset: Dataset, outputs: tuple[str, ...] = ()) -> FillGaps | None:
    """The step that fills short gaps in all logs and cuts logs at longer ones; None if nothing is missing.

    Args:
        outputs: to be filled like the inputs.
    """
    names = (*inputs_of(dataset), *outputs)
    short, steps, any_missing = [0.0], [], False
    for record in dataset.logs():
        log = record.data
        if isinstance(log, Record) and log.time.size > 1:
            step, lengths = sampling(log.time).step, _missing_lengths(log, names)
            any_missing |= bool(lengths)
            steps.append(step)
            short += [length for length in lengths if length <= _FILLED * step * 1.01]
    if not any_missing:
        return None
    return FillGaps(float(f"{max(*short, 1.5 * min(steps)) * 1.05:.2g}"), outputs)


def _missing_lengths(log: Record, names: tuple[str, ...]) -> list[float]:
    """Duration in s of every gap in time and run of empty cells in these columns, between the samples around it;
    infinite at an end."""
    intervals = np.diff(log.time)
    lengths = [float(intervals[k]) for k in sampling(log.time).gaps]
    for column in (log[name] for name in names if name in log.names):
        if np.isnan(column).any():
            there = np.flatnonzero(np.isfinite(column))
            behind = np.flatnonzero(np.diff(there) > 1)
            lengths += [float(log.time[there[k + 1]] - log.time[there[k]]) for k in behind]
            if not there.size or there[0] > 0 or there[-1] < column.size - 1:
                lengths.append(float("inf"))  # at an end, there is no second sample to interpolate to
    return lengths


def even_step(dataset: Dataset, record: MeasuredRecord, log: Record, names: tuple[str, ...] = ()) -> float:
    """The sampling interval in s of a log that lacks no samples.

    Args:
        names: of the columns that must be whole; all where there are none.
    Raises:
        BadInput: it has gaps.
    """
    refuse_missing_in(dataset, record, log, names)
    found = sampling(log.time)
    if found.gaps.size:
        all_outputs = tuple(name for name in log.names if name not in inputs_of(dataset))
        cure = _cure(dataset, all_outputs)  # a sample that is added in a gap has no output
        raise BadInput(f"{record.source} lacks samples after {log.time[found.gaps[0]]:.6g} s; {cure}")
    return found.step


def refuse_missing_in(dataset: Dataset, record: MeasuredRecord, log: Record, names: tuple[str, ...] = ()) -> None:
    """A log whose cells are all there.

    Args:
        names: of the columns; all where there are none.
    Raises:
        BadInput: one is empty, with its place and what fills it.
    """
    own = [name for name in names or log.names if name in log.names]
    missing = ~np.isfinite(np.column_stack([log[name] for name in own]))
    if missing.any():
        row, column = (int(index[0]) for index in np.nonzero(missing))
        count = counted(int(missing[:, column].sum()), "sample")
        where = f"{short_name(dataset, record)}: {own[column]} lacks {count}, the first at {log.time[row]:.6g} s"
        inputs = inputs_of(dataset)
        outputs = [name for name, lacks in zip(own, missing.T, strict=True) if lacks.any() and name not in inputs]
        raise BadInput(f"{where}; {_cure(dataset, tuple(outputs))}")


def refuse_missing_samples(dataset: Dataset, *, outputs: bool = False) -> None:
    """A data set whose inputs have no empty cells; nothing can be simulated with those.

    Args:
        outputs: whether outputs may have none either, as for an analysis that needs all samples.
    Raises:
        BadInput: a log has one, with its place and what fills it.
    """
    for record in dataset.logs():
        if isinstance(record.data, Record) and (outputs or dataset.columns(record, "input")):
            names = record.data.names if outputs else tuple(dataset.columns(record, "input"))
            refuse_missing_in(dataset, record, record.data, names)


def _cure(dataset: Dataset, outputs: tuple[str, ...]) -> str:
    """What to type where samples are missing."""
    step = fill_of(dataset, outputs)
    assert step is not None
    names = ", ".join(f'"{name}"' for name in outputs)
    more = f", signals = [{names}]" if names else ""
    return (
        f"data = data.{call(step)} fills short gaps and cuts logs at longer ones; in dataset.toml, preparation = "
        f'[{{ step = "fill_gaps", longest = {step.longest:g}{more} }}] below [dataset] does it'
    )
