"""Records of a periodic test, cut into whole periods."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.stretch import periodic_stretch
from pysim.types import BadInput, Record, sampling

Array = NDArray[np.float64]

# Share of a sampling interval by which a sample may be off the grid. At the Nyquist frequency this is a phase noise of
# 1.8 deg on single samples, and far less on lines, which are means over all samples.
_JITTER = 0.01
# The same for the end of the last period, since a period that drifts against the samples leaks into all lines.
_DRIFT = 0.05


@dataclass(frozen=True)
class Periods:
    """Signals of M realisations, P periods and N samples a period.

    Args:
        values: (M, P, N, n_s) in the signals' units.
        names: (n_s) input, output and, if there is one, the noise-free reference.
        units: (n_s).
        period: s.
        origin: origin of the first record.
    Raises:
        BadInput: another shape, or numbers that are not finite.
    """

    values: Array
    names: tuple[str, ...]
    units: tuple[str, ...]
    period: float
    origin: str = ""

    def __post_init__(self) -> None:
        values = np.array(self.values, dtype=np.float64)
        values.setflags(write=False)
        object.__setattr__(self, "values", values)
        if values.ndim != 4 or values.shape[3] != len(self.names) or len(self.names) not in (2, 3):
            raise BadInput(f"periods: need values (M, P, N, n_s) of two or three signals, got {values.shape}")
        if not np.isfinite(values).all():
            raise BadInput(f"periods of {self.origin or 'a record'}: every sample must be finite")

    def without_first(self, count: int) -> Periods:
        """The periods without the first ones of every realisation."""
        left = self.values.shape[1] - count
        if count < 0 or left < 1:
            raise BadInput(f"periods: of {self.values.shape[1]}, {count} cannot be left out; record more periods")
        return Periods(self.values[:, count:], self.names, self.units, self.period, self.origin)


def periods_of(
    records: Sequence[Record],
    period: float,
    columns: Sequence[str],
    *,
    start: float | None = None,
    count: int | None = None,
) -> Periods:
    """Cut records into periods.

    Args:
        records: one per realisation of the random phases, on the same sampling grid.
        period: s, a whole number of samples.
        columns: names of input and output; if the input is measured with noise, also of its command, which is known
            exactly.
        start: start of the first period, s. None searches for the periodic part of the command and takes its last whole
            periods; of a record shorter than two periods, the last period is taken.
        count: periods of each record; None takes as many as the shortest record has.
    Raises:
        BadInput: times that are not equidistant, a period that is no whole number of samples, fewer periods than
            `count`, or a command that is not periodic.
    """
    if not records:
        raise BadInput("multisine: there is no record; give one per realisation")
    names = checked_columns(columns)
    cuts = [_cut(record, period, names, start) for record in records]
    samples = {cut.shape[1] for cut in cuts}
    if len(samples) > 1:
        raise BadInput(
            f"multisine: the records have {sorted(samples)} samples per period; log all of them at the same rate"
        )
    fewest = min(cut.shape[0] for cut in cuts)
    count = fewest if count is None else count
    if not 1 <= count <= fewest:
        raise BadInput(f"multisine: {count} periods are asked for and {fewest} are there; record longer")
    first = records[0]
    units = tuple(first.units[first.names.index(name)] for name in names)
    return Periods(
        np.stack([cut[-count:] if start is None else cut[:count] for cut in cuts]), names, units, period, first.origin
    )


def checked_columns(columns: Sequence[str]) -> tuple[str, ...]:
    """Names of input and output, and of the reference if there is one.

    Raises:
        BadInput: another number of names, or one of them twice.
    """
    names = tuple(columns)
    if len(names) not in (2, 3) or len(set(names)) < len(names):
        raise BadInput(f"multisine: name the columns of input and output (and reference), each once, got {names}")
    return names


def refuse_still(output: Array, name: str) -> None:
    """Reject a constant output.

    Raises:
        BadInput: it is constant; the gain would be zero, and the phase only rounding errors.
    """
    if np.ptp(output) == 0:
        raise BadInput(
            f"multisine: {name} stands still at {float(output.flat[0]):g}; there is no response; name the column that "
            "responds"
        )


def sampling_interval(record: Record) -> float:
    """s between samples.

    Raises:
        BadInput: samples that are not equidistant.
    """
    time = record.time
    if time.size < 8:
        raise BadInput(f"multisine: {record.origin or 'a record'} has {time.size} samples; record at least one period")
    step = float(time[-1] - time[0]) / (time.size - 1)
    off = np.abs(time - time[0] - step * np.arange(time.size))
    worst = int(np.argmax(off))
    # Both ends of the grid may be wrong by half of the last digit, and so may every time between.
    if off[worst] > max(_JITTER * step, sampling(time).digit):
        raise BadInput(
            f"multisine: {record.origin or 'a record'} is not sampled at equal intervals: at {time[worst]:g} s it is "
            f"{off[worst]:.2g} s off a grid of {step:g} s; log at a fixed rate, or resample the log yourself and say so"
        )
    return step


def _cut(record: Record, period: float, names: tuple[str, ...], start: float | None) -> Array:
    """Periods (P, N, n_s) of one record: from `start` on, or up to the end of the periodic part."""
    step = sampling_interval(record)
    columns = np.column_stack([record[name] for name in names])
    where = record.origin or "a record"
    if not period > 0:
        raise BadInput(f"multisine: the period is {period} s; give a positive time")
    size = round(period / step)
    if start is not None:
        columns = columns[record.time >= start - 0.5 * step]
    elif size > 3 and columns.shape[0] >= 2 * size:
        columns = columns[periodic_stretch(columns[:, -1 if len(names) == 3 else 0], size)]
    count = columns.shape[0] // size if size > 3 else 0
    if count < 1:
        since = "" if start is None else f" from {start:g} s on"
        raise BadInput(
            f"multisine: {where} holds {columns.shape[0] * step:g} s{since}, less than one period of {period:g} s or "
            f"than four samples of {step:g} s; correct period or start, or record longer"
        )
    if abs(period / step - size) * count > _DRIFT:
        raise BadInput(
            f"multisine: a period of {period:g} s is {period / step:.6g} samples of {step:.6g} s in {where}; choose a "
            f"period of whole samples, as {size * step:.6g} s, or resample it yourself"
        )
    kept = columns[: count * size] if start is not None else columns[-count * size :]
    return kept.reshape(count, size, len(names))
