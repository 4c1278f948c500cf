"""Check of every log of a data set."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pysim.identify.data_check.against_model import against_model, names_beside
from pysim.identify.data_check.clipping import plateaus
from pysim.identify.data_check.clock import Clock, clock
from pysim.identify.data_check.finding import Finding, FindingCode, finding
from pysim.identify.data_check.folding import share_near_nyquist
from pysim.identify.data_check.settings import LogCheckSettings
from pysim.identify.data_check.swing import swing
from pysim.identify.logged import logged_wave
from pysim.io.prepare import DropOutliers, Exclude, FillGaps, Resample, Step, fill_of, outliers, short_name
from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Model, Record
from pysim.types.record_kind import CHIRP, KINDS

_SETTINGS = LogCheckSettings()
_HARMONIC = 3  # a symmetric nonlinearity causes this harmonic
_ROUNDING = 1e-6


@dataclass(frozen=True)
class RecordCheck:
    """The check of one record.

    Args:
        source, kind, use: as in `MeasuredRecord`.
        signals: logged signals, or input and output of a table.
        rows: number of samples, or of frequencies of a table.
        clock: time base of a log; None for a table.
        offset, amplitude, frequency: as specified.
        command: input that has these three; empty if none is specified.
        unit: unit of offset and amplitude; empty if no input is specified.
        findings: possible errors in the record.
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
    findings: tuple[Finding, ...]


@dataclass(frozen=True)
class DataCheck:
    """A data set and its checks: `records` in its order, and findings from the comparison with a model."""

    dataset: Dataset
    records: tuple[RecordCheck, ...]
    beside_model: tuple[Finding, ...] = ()

    @property
    def findings(self) -> tuple[Finding, ...]:
        """All findings: those from the model first, then those of the records."""
        return (*self.beside_model, *(found for record in self.records for found in record.findings))


def check_dataset(
    dataset: Dataset,
    answers: Mapping[str, Record] | None = None,
    model: Model | None = None,
    known: Collection[str] = (),
) -> DataCheck:
    """Check a data set; findings do not raise, and have the steps of preparation that correct them.

    Found are: empty cells of inputs, gaps and uneven sampling; outliers; a command whose frequency, offset, amplitude
    or shape is not as specified; fewer than two periods; harmonics beyond half the sampling rate, or much power close
    to it; signals clipped at a limit; with simulated logs also wrong signs, units and columns; with a model also
    signals that it does not have, and inputs without a signal.

    Args:
        answers: source of a log -> simulated log, with columns named like signals or their variables.
        model: model of the plant.
        known: inputs of the model that are set to a constant value.
    """
    limits = {signal.name: _extremes(dataset, signal.name) for signal in dataset.signals}
    fill = fill_of(dataset)
    records = _some_left(tuple(_check(dataset, record, limits, fill) for record in dataset.records))
    names = names_beside(dataset, model, known) if model else ()
    return DataCheck(dataset, records, (*names, *against_model(dataset, answers or {})))


def _some_left(records: tuple[RecordCheck, ...]) -> tuple[RecordCheck, ...]:
    """The same without steps that leave out a whole log, where no log would be left after all of them."""
    if not all(any(_is_whole(step) for found in record.findings for step in found.cure) for record in records):
        return records
    return tuple(
        replace(
            record,
            findings=tuple(replace(f, cure=tuple(s for s in f.cure if not _is_whole(s))) for f in record.findings),
        )
        for record in records
    )


def _is_whole(step: Step) -> bool:
    """Whether a step leaves out a log from end to end."""
    return isinstance(step, Exclude) and step.start is None and step.stop is None


def _extremes(dataset: Dataset, name: str) -> tuple[float, float]:
    """Smallest and largest value over all logs."""
    columns = [r.data[name] for r in dataset.records if isinstance(r.data, Record) and name in r.data.names]
    there = [column[np.isfinite(column)] for column in columns]
    own = [column for column in there if column.size]
    return min((float(c.min()) for c in own), default=0.0), max((float(c.max()) for c in own), default=0.0)


def _check(
    dataset: Dataset, record: MeasuredRecord, limits: dict[str, tuple[float, float]], fill: FillGaps | None
) -> RecordCheck:
    data = record.data
    base = clock(data.time) if isinstance(data, Record) else None
    found: tuple[Finding, ...] = ()
    inputs = dataset.columns(record, "input")
    if isinstance(data, Record) and base:
        found = (
            *_missing(record, data, inputs, base, fill),
            *_of_log(dataset, record, data.whole_rows(inputs), base, limits),
        )
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
        findings=found,
    )


def _missing(
    record: MeasuredRecord, log: Record, inputs: Sequence[str], base: Clock, fill: FillGaps | None
) -> Iterator[Finding]:
    """Findings of empty cells of inputs, and of gaps in time. Where an output was not measured, nothing is compared."""
    cure = () if fill is None else (fill,)
    for name in inputs:
        empty = np.flatnonzero(np.isnan(log[name]))
        if empty.size:
            yield finding(
                FindingCode.EMPTY,
                record.source,
                *cure,
                signal=name,
                count=int(empty.size),
                start=float(log.time[empty[0]]),
            )
    if base.gaps:
        start, length = max(base.gaps, key=lambda gap: gap[1])
        yield finding(FindingCode.GAP, record.source, *cure, count=len(base.gaps), start=start, length=length)


def _of_log(
    dataset: Dataset, record: MeasuredRecord, log: Record, base: Clock, limits: dict[str, tuple[float, float]]
) -> Iterator[Finding]:
    source, own = record.source, short_name(dataset, record)
    if log.time.size < _SETTINGS.fewest_samples:
        yield finding(FindingCode.TOO_SHORT, source, Exclude(own), rows=log.time.size, least=_SETTINGS.fewest_samples)
        return
    if base.rate < _SETTINGS.slow_rate * (1 + _ROUNDING):
        yield finding(FindingCode.SLOW_CLOCK, source, rate=base.rate)
    if base.jitter > _SETTINGS.jitter:
        even = Resample(float(f"{base.rate:.3g}"))
        yield finding(FindingCode.UNEVEN, source, even, jitter=base.jitter, rate=base.rate)
    there = {name: log[name][np.isfinite(log[name])] for name in log.names}
    still = [name for name, values in there.items() if values.size and np.ptp(values) == 0]
    for name in still:
        value = float(there[name][0])
        yield finding(FindingCode.STILL, source, signal=name, value=value, unit=dataset.signal(name).unit)
    inside, broad = _wave_inside(record, log), KINDS[record.kind].broad
    if record.frequency is not None and record.command and record.command not in still:
        yield from _of_sine(record, log, inside, base, dataset.signal(record.command))
    elif record.kind == CHIRP.name and record.command:
        found = log[record.command][inside]
        middle, half = 0.5 * float(found.max() + found.min()), 0.5 * float(np.ptp(found))
        yield from _of_level(record, dataset.signal(record.command), middle, half)
    for name in log.names:
        if dataset.signal(name).role == "output":
            yield from _of_output(dataset, record, log, name, inside, limits[name])
        whole = there[name].size > (1 - _SETTINGS.folded) * log.time.size  # more that are missing fold by themselves
        share = share_near_nyquist(there[name], dataset.signal(name).deviation) if broad and whole else 0.0
        if share > _SETTINGS.folded:
            yield finding(FindingCode.FOLDED, source, signal=name, share=share)


def _of_output(
    dataset: Dataset, record: MeasuredRecord, log: Record, name: str, inside: slice, ends: tuple[float, float]
) -> Iterator[Finding]:
    """Findings of clipped samples and outliers in one output."""
    own, there = short_name(dataset, record), np.isfinite(log[name])
    time = log.time[inside][there[inside]]
    flat = plateaus(log[name][inside][there[inside]], *ends) if time.size else []
    if flat:
        cuts = _joined(flat, time.size)
        cure = [Exclude(own, *map(float, (time[a], time[b - 1]))) for a, b in cuts]
        if len(cuts) > _SETTINGS.most_cuts or cuts == [(0, time.size)]:
            cure = [Exclude(own)]
        yield finding(
            FindingCode.CLIPPED,
            record.source,
            *cure,
            signal=name,
            count=sum(b - a for a, b in flat),
            low=ends[0],
            high=ends[1],
            unit=dataset.signal(name).unit,
        )
    usual = DropOutliers(signals=(name,))
    far = np.flatnonzero(outliers(log.time, log[name], usual.sigmas))
    if far.size:
        yield finding(
            FindingCode.OUTLIERS, record.source, usual, signal=name, count=int(far.size), start=float(log.time[far[0]])
        )


def _joined(flat: Sequence[tuple[int, int]], size: int) -> list[tuple[int, int]]:
    """Samples (first, stop) to leave out, so that no stretch that is left is too short; `size` samples in all."""
    cuts = [(0, 0)]
    for first, stop in (*flat, (size, size)):
        if first - cuts[-1][1] < _SETTINGS.fewest_samples:
            first = cuts.pop()[0]
        cuts.append((first, stop))
    return [(first, stop) for first, stop in cuts if stop > first]


def _wave_inside(record: MeasuredRecord, log: Record) -> slice:
    """Samples of a sine or chirp, without lead-in and ramp back; all samples if no wave can be fitted."""
    try:
        wave = logged_wave(replace(record, data=log), record.command)
    except BadInput:
        return slice(None)
    first, last = np.searchsorted(log.time, [wave.start - _ROUNDING, wave.end + _ROUNDING])
    return slice(int(first), int(last))


def _of_sine(
    record: MeasuredRecord, log: Record, inside: slice, base: Clock, command: MeasuredSignal
) -> Iterator[Finding]:
    """Findings where the command of a stepped sine differs from the record's specification."""
    source, name = record.source, command.name
    told, time, values = float(record.frequency or 0.0), log.time[inside], log[name][inside]
    duration = float(time[-1] - time[0])
    periods = told * (duration + 1 / base.rate)  # the last sample counts as an interval too
    if periods < _SETTINGS.fewest_periods - _ROUNDING:
        yield finding(FindingCode.FEW_PERIODS, source, periods=periods, frequency=told)
    if _HARMONIC * told > 0.5 * base.rate:
        yield finding(FindingCode.ALIASED, source, harmonic=_HARMONIC, frequency=told, rate=base.rate)
    try:
        found = swing(time, values, told)
    except BadInput as error:
        yield finding(FindingCode.NO_SINE, source, signal=name, reason=str(error))
        return
    if abs(found.frequency - told) * duration > _SETTINGS.drift and found.impurity < _SETTINGS.no_sine:
        yield finding(FindingCode.FREQUENCY, source, signal=name, value=found.frequency, told=told)
    if found.impurity > _SETTINGS.impure:
        yield finding(FindingCode.IMPURE, source, signal=name, share=found.impurity)
    yield from _of_level(record, command, found.offset, found.amplitude)


def _of_level(record: MeasuredRecord, command: MeasuredSignal, offset: float, amplitude: float) -> Iterator[Finding]:
    """Findings where offset or amplitude differ from the specified ones."""
    for what, wanted, got in (("offset", record.offset, offset), ("amplitude", record.amplitude, amplitude)):
        if wanted is None:
            continue
        if abs(got - wanted) > _SETTINGS.level_error * float(record.amplitude or abs(wanted) or 1.0):
            yield finding(
                FindingCode.LEVEL,
                record.source,
                what=what,
                signal=command.name,
                value=got,
                told=wanted,
                unit=command.unit,
            )
