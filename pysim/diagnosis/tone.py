"""A tone in a residual: one line of a log's spectrum that stands out of the lines beside it.

The spectrum of noise, of any colour, is nearly level over a few lines. A rotating shaft or the mains makes a line that
stands out.

Source: Fisher 1929, Proceedings of the Royal Society A 125:54; here each line is tested against the lines beside it.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.left import logs
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.settings import ToneSettings
from pysim.identify.greybox.residuals import Channel
from pysim.types import Dataset, Record

Array = NDArray[np.float64]

_SETTINGS = ToneSettings()


def tone(fit: FinalFit, dataset: Dataset, false_alarm: float) -> float | None:
    """Frequency in Hz of the most significant tone in a model's residuals of logs over time; None without a tone.

    Args:
        dataset: the fitted data set.
        false_alarm: chance of finding a tone in noise.
    """
    times = {record.source: record.data.time for record in dataset.records if isinstance(record.data, Record)}
    lines = [clearest(times[source], rest) for source, rests in logs(fit) for rest in rests.values()]
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


def periodogram(own: list[tuple[Array, Array]], coarse: Array, fine: Array) -> Array:
    """Periodogram of one signal in all its logs, each with its times, at the fine rates in rad/s, over its squares.

    Relative to the middle of its log a spectrum turns slowly with the rate. So it is computed at the coarse rates
    alone, and logs that lie days apart cost no more.
    """
    found = np.zeros(fine.size, dtype=complex)
    for t, rest in own:
        middle = float(t.mean())
        slow = np.array([np.exp(-1j * rate * (t - middle)) @ rest for rate in coarse])
        between = np.interp(fine, coarse, slow.real) + 1j * np.interp(fine, coarse, slow.imag)
        found += np.exp(-1j * fine * middle) * between
    return np.asarray(np.abs(found) ** 2 / max(sum(float(rest @ rest) for _, rest in own), np.finfo(float).tiny))


def clearest(times: Array, rest: Array) -> tuple[float, float] | None:
    """The most significant spectral line of a residual (n_t,); zero takes the place of one that is not-a-number.

    Returns:
        its p-value, corrected for the number of lines, and Hz; None for a short log or uneven sampling.
    """
    step = np.diff(times)
    lobe, worth = _SETTINGS.lobe, _SETTINGS.worth
    far = lobe + _SETTINGS.beside
    if rest.size != times.size or rest.size < 8 * far or np.ptp(step) > _SETTINGS.even * step.mean():
        return None
    there = np.isfinite(rest)
    if not there.any():
        return None
    even = np.where(there, rest - rest[there].mean(), 0.0)
    power = np.abs(np.fft.rfft(even * np.hanning(rest.size))) ** 2
    beside = [np.roll(power, shift) for k in range(lobe + 1, far + 1) for shift in (k, -k)]
    level = np.median(beside, axis=0) / math.log(2)  # mean of an exponential distribution, from its median
    inner = slice(far, power.size - far)
    over = power[inner] / np.maximum(level[inner], np.finfo(float).tiny)
    line = int(np.argmax(over))
    chance = over.size * (1 + over[line] / worth) ** -worth  # F with 2 and 2 times as many degrees of freedom
    return float(chance), (line + far) / (rest.size * float(step.mean()))
