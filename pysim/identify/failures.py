"""Where a model fails: residuals by log, frequency, offset, amplitude, time window, and range of signals and rates."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.identify.residual_spectrum import FEWEST, residual_spectrum
from pysim.identify.spectral_line import LineSettings, spectral_line
from pysim.types import Dataset, MeasuredRecord, RecordFit
from pysim.types.answer import Failure

Array = NDArray[np.float64]

# Stands for the record's name where a region gathers several records.
ALL_SINES, ALL_LOGS = "all stepped sines", "all logs over time"
_WINDOWS = 6  # time windows of a log
_BANDS = 10  # frequency bands of a log's spectrum, at most
_LINES = 8  # lines of the spectrum in a band, at least; with fewer, chance would lead the list
_RANGES = 5  # ranges of a signal, with equally many samples


def failures(records: Sequence[RecordFit], dataset: Dataset | None = None) -> tuple[Failure, ...]:
    """Root mean square residual by region, in standard deviations of the noise, the worst region first.

    Stepped sines count one by one, and together by frequency, offset and amplitude. Other logs count by time window,
    by frequency band and by a lone tone, and together by the range of each simulated signal and of its rate. If all
    logs are stepped sines, the ranges are of these.

    Args:
        records: logs and a model's residuals.
        dataset: gives offset and amplitude of the stepped sines.
    """
    rows = [row for record in records for row in _own(record)]
    rows += _together(records, {r.source: r for r in dataset.records} if dataset else {})
    rows += _ranges(records)
    return tuple(sorted(rows, key=lambda row: -row.error))


def _own(record: RecordFit) -> Iterator[Failure]:
    """Regions of one record: the frequency of a stepped sine; time windows, frequency bands and a tone of a log."""
    residual = record.residual
    for j, signal in enumerate(residual.names):
        values = residual.values[:, j]
        if record.harmonics:
            yield Failure(record.source, signal, f"{record.harmonics[j].frequency:g} Hz", _size(values))
            continue
        for part in np.array_split(np.arange(values.size), min(_WINDOWS, values.size)):
            window = f"{residual.time[part[0]]:.4g} to {residual.time[part[-1]]:.4g} s"
            if np.isfinite(values[part]).any():
                yield Failure(record.source, signal, window, _size(values[part]))
        if values.size >= FEWEST:
            frequency, power, _ = residual_spectrum(residual.time, values)
            line = spectral_line(residual.time, values)
            if line is not None and line[0] < LineSettings().false_alarm:
                size = float(np.interp(line[1], frequency, power))
                yield Failure(record.source, signal, f"{line[1]:.3g} Hz alone", math.sqrt(size))
            for band in bands(frequency):
                region = f"{frequency[band][0]:.3g} to {frequency[band][-1]:.3g} Hz"
                yield Failure(record.source, signal, region, math.sqrt(float(np.mean(power[band]))))


def bands(frequency: Array) -> Iterator[slice]:
    """Bands of an even frequency axis (n_f,), about equally wide on a logarithmic scale, of _LINES lines or more."""
    edges = np.geomspace(1, frequency.size + 1, _BANDS + 1)
    start = 0
    for edge in edges[1:]:
        stop = round(float(edge)) - 1
        if stop - start >= _LINES or (stop >= frequency.size > start):
            yield slice(start, stop)
            start = stop


def _together(records: Sequence[RecordFit], tests: dict[str, MeasuredRecord]) -> Iterator[Failure]:
    """Regions of several stepped sines: by frequency, offset and amplitude, as far as these differ."""
    sines = [record for record in records if record.harmonics]
    ways: list[tuple[str, Callable[[RecordFit], float | None]]] = [
        ("frequency {:g} Hz", lambda r: r.harmonics[0].frequency),
        ("offset {:g}", lambda r: tests[r.source].offset if r.source in tests else None),
        ("amplitude {:g}", lambda r: tests[r.source].amplitude if r.source in tests else None),
    ]
    for words, of in ways:
        groups: dict[tuple[str, float], list[Array]] = {}
        for record in sines:
            value = of(record)
            if value is not None:
                for j, name in enumerate(record.measured.names):
                    groups.setdefault((name, value), []).append(record.residual.values[:, j])
        if len({value for _, value in groups}) > 1:
            for (name, value), parts in groups.items():
                yield Failure(ALL_SINES, name, words.format(value), _size(np.concatenate(parts)))


def _ranges(records: Sequence[RecordFit]) -> Iterator[Failure]:
    """Regions of a signal: its samples sorted by the simulated value, and by its rate, in fifths."""
    logs = [record for record in records if not record.harmonics] or list(records)
    where = ALL_LOGS if not logs or not logs[0].harmonics else ALL_SINES
    for name, unit in dict.fromkeys(
        (n, u) for r in logs for n, u in zip(r.measured.names, r.measured.units, strict=True)
    ):
        own = [(record, record.measured.names.index(name)) for record in logs if name in record.measured.names]
        residual = np.concatenate([record.residual.values[:, j] for record, j in own])
        value = np.concatenate([record.simulated.values[:, j] for record, j in own])
        rate = np.concatenate([_rate(record, j) for record, j in own])
        there = np.isfinite(residual)
        residual, value, rate = residual[there], value[there], rate[there]
        label = "" if unit == "1" else f" {unit}"
        for what, of, per in ((name, value, label), (f"rate of {name}", rate, f"{label or ' 1'}/s")):
            for part in np.array_split(np.argsort(of, kind="stable"), _RANGES):
                if part.size:
                    region = f"{what} {_three_digits(of[part[0]])} to {_three_digits(of[part[-1]])}{per}"
                    yield Failure(where, name, region, _size(residual[part]))


def _three_digits(value: float) -> str:
    """Three digits, large numbers without an exponent: -1350 and not -1.35e+03."""
    text = f"{value:.3g}"
    return f"{float(text):.0f}" if "e+" in text else text


def _rate(record: RecordFit, column: int) -> Array:
    """Time derivative of a simulated signal, (n_t,)."""
    values = record.simulated.values[:, column]
    return np.asarray(np.gradient(values, record.simulated.time)) if values.size > 1 else np.zeros_like(values)


def _size(values: Array) -> float:
    return math.sqrt(float(np.nanmean(values**2)))
