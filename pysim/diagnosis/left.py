"""What a model leaves: whether the model's own signals predict the residual, and whether it holds a tone.

Source: Ljung 1999, Lecture Notes in Control and Information Sciences 245:97 (the model-error model).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.floors import logs
from pysim.diagnosis.refit import FinalFit
from pysim.identify.greybox.residuals import Channel
from pysim.identify.spectral_line import periodogram, spectral_line
from pysim.types import Dataset, Record

Array = NDArray[np.float64]

# Of the regression: lags of the signals in samples, ridge penalties over the information of a block on a regressor,
# and the fewest samples per regressor.
_LAGS = (0, 1, 2, 4, 8, 16, 32, 64)
_RIDGES = (1e-3, 1e-2, 1e-1, 1.0, 10.0)
_SAMPLES = 30


@dataclass(frozen=True)
class Follows:
    """How far the model's own signals predict a residual.

    Args:
        share: of the residual's sum of squares that a regression predicts on blocks left out, 0 ... 1.
        t: t statistic of that share, from its scatter over the blocks.
    """

    share: float
    t: float


def follows(fit: FinalFit, dataset: Dataset, blocks: int) -> Follows | None:
    """Regress the residuals of logs over time on the model's own inputs and outputs (model-error model).

    Args:
        dataset: the fitted data set, with its inputs.
        blocks: number of contiguous pieces over which the regression is cross-validated.
    Returns:
        the channel with the largest t; None where all have too few samples.
    """
    tables = list(_regressors(fit, dataset))
    if not tables:
        return None
    names = {channel for _, rests in tables for channel in rests}
    found = [one for name in sorted(names) if (one := _regression(tables, name, blocks)) is not None]
    return max(found, key=lambda one: one.t, default=None)


def _regressors(fit: FinalFit, dataset: Dataset) -> Iterator[tuple[Array, dict[Channel, Array]]]:
    """Per log the regressors (n_t, m), made of signals that every log has, and the residuals by channel."""
    records = {record.source: record.data for record in dataset.records}
    found = []
    for source, rests in logs(fit):
        record = records[source]
        if not isinstance(record, Record) or any(rest.size != record.time.size for rest in rests.values()):
            continue
        simulated = {name: record[name] - rest for (_, name), rest in rests.items() if name in record.names}
        others = {name: record[name] for name in record.names if name not in simulated}
        simulated = {name: _bridged(record.time, values) for name, values in simulated.items()}
        others = {name: _bridged(record.time, values) for name, values in others.items() if np.isfinite(values).any()}
        found.append((others | simulated, rests))
    if not found:
        return
    names = [name for name in found[0][0] if all(name in signals for signals, _ in found)]
    tables = [np.column_stack([signals[name] for name in names]) for signals, _ in found]
    lags = [lag for lag in _LAGS if lag < min(map(len, tables)) // 4]
    whole = np.concatenate(tables)
    scale = whole.mean(axis=0), np.maximum(whole.std(axis=0), np.finfo(float).tiny)
    for table, (_, rests) in zip(tables, found, strict=True):
        yield _features((table - scale[0]) / scale[1], lags), rests


def _bridged(time: Array, values: Array) -> Array:
    """A regressor (n_t,), with straight lines where nothing was measured: there, the residual has no sample either."""
    there = np.isfinite(values)
    return values if there.all() else np.interp(time, time[there], values[there])


def _features(signals: Array, lags: Sequence[int]) -> Array:
    """Regressors (n_t, m): lagged, squared, absolute and signed copies of scaled signals (n_t, k), and their rates."""
    n = len(signals)
    parts = [np.ones((n, 1))]
    parts += [np.vstack([np.repeat(signals[:1], lag, axis=0), signals[: n - lag]]) for lag in lags]
    rate = np.gradient(signals, axis=0)
    rate = rate / np.maximum(rate.std(axis=0), np.finfo(float).tiny)
    sign = np.tanh(3 * rate)
    parts += [rate, sign, np.abs(rate), signals**2, signals**3, rate * np.abs(rate), np.abs(signals)]
    parts += [np.maximum(signals - 1, 0), np.minimum(signals + 1, 0), signals * np.abs(rate), sign * signals]
    return np.column_stack(parts)


def _regression(tables: list[tuple[Array, dict[Channel, Array]]], channel: Channel, count: int) -> Follows | None:
    """Ridge regression of one channel's residual; penalty and gain come from cross-validation over blocks."""
    own = [(table, rests[channel]) for table, rests in tables if channel in rests]
    table = np.concatenate([rows for rows, _ in own])
    rest = np.concatenate([values for _, values in own])
    table, rest = table[np.isfinite(rest)], rest[np.isfinite(rest)]
    n, m = table.shape
    if n < _SAMPLES * m:
        return None
    table = table / np.maximum(np.sqrt(np.mean(table**2, axis=0)), np.finfo(float).tiny)
    blocks = np.arange(n) * count // n
    inner = [table[blocks == b].T @ table[blocks == b] for b in range(count)]
    outer = [table[blocks == b].T @ rest[blocks == b] for b in range(count)]
    best = Follows(0.0, 0.0)
    for ridge in _RIDGES:
        gains = np.empty(count)
        for b in range(count):
            kept = sum(inner) - inner[b] + ridge * n / count * np.eye(m)
            moved = np.linalg.solve(kept, sum(outer) - outer[b])
            part = rest[blocks == b]
            gains[b] = float(part @ part) - float(np.sum((part - table[blocks == b] @ moved) ** 2))
        spread = float(gains.std(ddof=1)) * math.sqrt(count)
        share = float(gains.sum()) / max(float(rest @ rest), np.finfo(float).tiny)
        if share > best.share:
            best = Follows(share, float(gains.sum()) / spread if spread > 0 else 0.0)
    return best


def tone(fit: FinalFit, dataset: Dataset, false_alarm: float) -> float | None:
    """Frequency in Hz of the most significant tone in a model's residuals of logs over time; None without a tone.

    Args:
        dataset: the fitted data set.
        false_alarm: chance of finding a tone in noise.
    """
    times = {record.source: record.data.time for record in dataset.records if isinstance(record.data, Record)}
    lines = [spectral_line(times[source], rest) for source, rests in logs(fit) for rest in rests.values()]
    found = [line for line in lines if line is not None]
    if not found:
        return None
    chance, frequency = min(found)
    return frequency if chance * len(found) < false_alarm else None


def tone_rate(fit: FinalFit, dataset: Dataset, false_alarm: float) -> float | None:
    """Angular frequency in rad/s of the tone on the clock of all logs, as exactly as all of them together show it.

    It is the highest point of the residuals' periodogram over all logs, near the frequency that one log shows.
    """
    about = tone(fit, dataset, false_alarm)
    if about is None:
        return None
    clock = {
        record.source: (record.begin or 0.0) + record.data.time - record.data.time[0]
        for record in dataset.records
        if isinstance(record.data, Record)
    }
    pairs: dict[Channel, list[tuple[Array, Array]]] = {}
    for source, own in logs(fit):
        for channel, rest in own.items():
            if rest.size == clock[source].size:
                pairs.setdefault(channel, []).append((clock[source], np.nan_to_num(rest - np.nanmean(rest))))
    whole = np.concatenate([t for own in pairs.values() for t, _ in own])
    lengths = [float(np.ptp(t)) for own in pairs.values() for t, _ in own]
    rates = [2 * np.pi * np.arange(about - 1 / min(lengths), about + 1 / min(lengths), 1 / (8 * one))
             for one in (max(lengths), float(np.ptp(whole)))]  # fmt: skip
    power = np.sum([periodogram(own, *rates) for own in pairs.values()], axis=0)
    best = int(np.clip(np.argmax(power), 1, power.size - 2))
    low, middle, high = power[best - 1 : best + 2]
    bend = low - 2 * middle + high
    return float(rates[1][best] + (0.5 * (low - high) / bend if bend < 0 else 0.0) * (rates[1][1] - rates[1][0]))
