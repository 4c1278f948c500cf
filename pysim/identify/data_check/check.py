"""Look at every log of a data set."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from pysim.identify.data_check.clipping import clipped
from pysim.identify.data_check.clock import Clock, clock
from pysim.identify.data_check.folding import share_near_nyquist
from pysim.identify.data_check.swing import swing
from pysim.identify.logged import logged_wave
from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record
from pysim.types.record_kind import CHIRP, KINDS

_PERIODS = 2.0  # whole ones that a sine fit needs after the transients are cut off
_DRIFT = 0.02  # periods that command and told frequency may come apart over a log
_OFF = 0.01  # of the told amplitude: how far offset and amplitude of the command may be from what was told
_IMPURE = 0.02  # of the sine: what may be left over of the command
_JITTER = 0.05  # of the sampling interval
_HARMONIC = 3  # a symmetric nonlinearity answers there
_FOLDED = 0.01  # of a signal's variance close to half the sampling rate
_SLOW = 1.0  # Hz: no faster does a bench log, unless its times are no seconds
_ROUNDING = 1e-6


@dataclass(frozen=True)
class RecordCheck:
    """One record.

    Args:
        source, kind, use: as in `MeasuredRecord`.
        signals: what was logged, or input and output of a table.
        rows: samples, or frequencies of a table.
        clock: of a log; None for a table.
        offset, amplitude, frequency: as told.
        command: input that these three speak of; empty where none is told.
        unit: of offset and amplitude; empty where no input is told.
        warnings: sentences on what should be looked at.
    """

    source: str
    kind: str
    use: str
    signals: tuple[str, ...]
    rows: int
    clock: Clock | None
    offset: float | None
    amplitude: float | None
    frequency: float | None
    command: str
    unit: str
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class DataCheck:
    """A data set and what was found; `records` in its order."""

    dataset: Dataset
    records: tuple[RecordCheck, ...]

    @property
    def warnings(self) -> tuple[tuple[str, str], ...]:
        """(source, sentence) of every warning."""
        return tuple((record.source, text) for record in self.records for text in record.warnings)


def check_dataset(dataset: Dataset) -> DataCheck:
    """What a data set holds, with warnings that are no errors.

    Looked for: gaps and uneven sampling; a command that differs from what the record says, in frequency, offset,
    amplitude or shape; fewer than two periods; harmonics beyond half the sampling rate, or much power close to it;
    signals that stand at a limit.
    """
    limits = {signal.name: _extremes(dataset, signal.name) for signal in dataset.signals}
    return DataCheck(dataset, tuple(_check(dataset, record, limits) for record in dataset.records))


def _extremes(dataset: Dataset, name: str) -> tuple[float, float]:
    """Smallest and largest value over all logs."""
    columns = [r.data[name] for r in dataset.records if isinstance(r.data, Record) and name in r.data.names]
    return min((float(c.min()) for c in columns), default=0.0), max((float(c.max()) for c in columns), default=0.0)


def _check(dataset: Dataset, record: MeasuredRecord, limits: dict[str, tuple[float, float]]) -> RecordCheck:
    data = record.data
    base = clock(data.time) if isinstance(data, Record) else None
    return RecordCheck(
        source=record.source,
        kind=record.kind,
        use=record.use,
        signals=(data.test.input, data.test.output) if isinstance(data, FrequencyResponse) else data.names,
        rows=data.frequency.size if isinstance(data, FrequencyResponse) else data.time.size,
        clock=base,
        offset=record.offset,
        amplitude=record.amplitude,
        frequency=record.frequency,
        command=record.command,
        unit=dataset.signal(record.command).unit if record.command else "",
        warnings=tuple(_warnings(dataset, record, data, base, limits)) if isinstance(data, Record) and base else (),
    )


def _warnings(
    dataset: Dataset, record: MeasuredRecord, log: Record, base: Clock, limits: dict[str, tuple[float, float]]
) -> Iterator[str]:
    yield from _of_clock(base)
    still = [name for name in log.names if np.ptp(log[name]) == 0]
    yield from (f"{name} stands still at {log[name][0]:g} {dataset.signal(name).unit}" for name in still)
    inside = _wave_inside(record, log)
    if record.frequency is not None and record.command and record.command not in still:
        yield from _of_sine(record, log, inside, base, dataset.signal(record.command))
    elif record.kind == CHIRP.name and record.command:
        values = log[record.command][inside]
        middle, half = 0.5 * float(values.max() + values.min()), 0.5 * float(np.ptp(values))
        yield from _of_level(record, dataset.signal(record.command), middle, half)
    for name in log.names:
        signal = dataset.signal(name)
        count = clipped(log[name][inside], *limits[name]) if signal.role == "output" else 0
        if count:
            low, high = limits[name]
            ends = f"({low:g}, {high:g} {signal.unit})"
            yield f"{count} samples of {name} stand at its smallest or largest value {ends}: clipped?"
        share = share_near_nyquist(log[name], signal.deviation) if KINDS[record.kind].broad else 0.0
        if share > _FOLDED:
            yield (
                f"{100 * share:.0f} percent of the variance of {name} lie above 80 percent of half the sampling rate: "
                "faster parts fold back"
            )


def _wave_inside(record: MeasuredRecord, log: Record) -> slice:
    """The samples of a sine or chirp behind its lead-in and before its ramp back; all where that cannot be told."""
    try:
        wave = logged_wave(record, record.command)
    except BadInput:
        return slice(None)
    first, last = np.searchsorted(log.time, [wave.start - _ROUNDING, wave.end + _ROUNDING])
    return slice(int(first), int(last))


def _of_clock(base: Clock) -> Iterator[str]:
    if base.rate < _SLOW * (1 + _ROUNDING):
        yield f'{base.rate:.3g} samples per second: if time is in ms, write time_unit = "ms" below [dataset]'
    if base.gaps:
        start, length = max(base.gaps, key=lambda gap: gap[1])
        count = f"{len(base.gaps)} gaps in time, the longest" if len(base.gaps) > 1 else "a gap in time,"
        yield f"{count} of {length:.3g} s after {start:.6g} s"
    if base.jitter > _JITTER:
        yield f"uneven sampling: the intervals vary by {100 * base.jitter:.0f} percent"


def _of_sine(record: MeasuredRecord, log: Record, inside: slice, base: Clock, command: MeasuredSignal) -> Iterator[str]:
    """A stepped sine against what the record says of it."""
    told, time, values = float(record.frequency or 0.0), log.time[inside], log[command.name][inside]
    duration = float(time[-1] - time[0])
    periods = told * (duration + 1 / base.rate)  # the last sample stands for an interval too
    if periods < _PERIODS - _ROUNDING:
        yield f"{periods:.2g} periods of {told:g} Hz: too few for a fit without the transient; two are the least"
    if _HARMONIC * told > 0.5 * base.rate:
        beyond = f"{_HARMONIC} x {told:g} Hz is beyond half the sampling rate, {base.rate:.4g} Hz"
        yield f"aliasing: {beyond}, and folds back"
    try:
        found = swing(time, values, told)
    except BadInput as error:
        yield f"no sine can be fitted to {command.name}: {error}"
        return
    if abs(found.frequency - told) * duration > _DRIFT and found.impurity < 1:
        yield f"{command.name} swings at {found.frequency:.5g} Hz, not at {told:g} Hz"
    if found.impurity > _IMPURE:
        yield f"{command.name} is no pure sine: {100 * found.impurity:.0f} percent are left over"
    yield from _of_level(record, command, found.offset, found.amplitude)


def _of_level(record: MeasuredRecord, command: MeasuredSignal, offset: float, amplitude: float) -> Iterator[str]:
    """Offset and amplitude that were found against those that were told."""
    for what, wanted, got in (("offset", record.offset, offset), ("amplitude", record.amplitude, amplitude)):
        if wanted is not None and abs(got - wanted) > _OFF * float(record.amplitude or abs(wanted) or 1.0):
            yield f"{what} of the logged {command.name} is {got:.5g}, not {wanted:g} {command.unit} as told"
