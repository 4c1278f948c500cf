"""Measurement noise and noise floors of signals: specified by the data set, or estimated from the logs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.settings import NoiseSettings
from pysim.types import BadInput, MeasuredSignal
from pysim.types.answer import FloorSource, NoiseFloor

Array = NDArray[np.float64]

# Fourth differences of white noise of variance 1 have the variance 1 + 16 + 36 + 16 + 1.
_GAIN = 70.0
# Variance of a Hann-tapered ordinate averaged over its neighbours, over that of independent ones.
# Source: Percival and Walden 1993, Spectral Analysis for Physical Applications, Section 6.8.
_TAPER = 1.9
_LEVELS = 4  # differences between values; a column with fewer is a switched signal, not a quantised one
_ORDINATES = 8  # fewest ordinates of a periodogram's band


def specified_noise(signal: MeasuredSignal) -> float | None:
    """Standard deviation of noise and quantisation together, in the signal's unit; None if it is not specified."""
    if signal.noise is None:
        return None
    size = signal.deviation
    if not size > 0:
        raise BadInput(f"signal {signal.name!r}: a noise of {signal.noise} gives no weight; leave it out or correct it")
    return size


def seen_noise(values: Array) -> float:
    """Standard deviation of white noise on a smooth signal (n_t,), from its fourth differences.

    The median makes it robust against single events. It is too large if the signal itself changes between samples.
    """
    differences = np.diff(values, 4)
    differences = differences[np.isfinite(differences)]  # five samples in a row, all of them measured
    if differences.size == 0:
        return math.nan
    middle = float(np.median(np.abs(differences))) / 0.6745
    return (middle or float(np.sqrt(np.mean(differences**2)))) / math.sqrt(_GAIN)


def signal_noise(signal: MeasuredSignal, logs: Sequence[Array], settings: NoiseSettings) -> tuple[float, bool]:
    """Standard deviation of one signal's noise, independent of any model, and whether it was estimated from the logs.

    The estimate is the white part of the logs: in some frequency band the plant's own signal is negligible. If all logs
    are too short for that, it comes from their fourth differences. Estimates are never below the noise floor.

    Args:
        logs: columns of the signal, (n_t,) each; not-a-number where nothing was measured.
    Raises:
        BadInput: the noise is not specified and cannot be estimated.
    """
    size = specified_noise(signal)
    if size is not None:
        return size, False
    white = white_floor(logs, settings)
    if not white:
        seen = [value for log in logs if math.isfinite(value := seen_noise(log)) and value > 0]
        if not seen and not any(np.ptp(log) for log in logs):
            raise BadInput(
                f"signal {signal.name!r} stands still in every log, so nothing is known of what moves it; log a test "
                "that excites it, or give noise = a number"
            )
        if not seen:
            raise BadInput(
                f"signal {signal.name!r}: the logs show no noise, and none is specified; give noise = a number"
            )
        white = float(np.median(seen))
    return max(white, noise_floor(signal, logs, settings).sd), True


def noise_floor(signal: MeasuredSignal, logs: Sequence[Array], settings: NoiseSettings) -> NoiseFloor:
    """Smallest level that a signal's residual is divided by; only a floor, so that a wrong noise does not set weights.

    Args:
        logs: columns of the signal, (n_t,) each; not-a-number where nothing was measured.
    """
    logs = [log[np.isfinite(log)] for log in logs]
    spread = max((float(np.ptp(log)) for log in logs), default=0.0)
    size = max((float(np.abs(log).max()) for log in logs), default=0.0)
    step = _step(max(logs, key=len)) if logs else 0.0  # a short log may hold none of the smallest steps
    least = settings.least * (spread or size or 1.0)
    resolution = max((signal.resolution or 0.0) / math.sqrt(12), step / math.sqrt(12), least)
    specified = specified_noise(signal) or 0.0
    if specified >= resolution:
        return NoiseFloor(specified, FloorSource.SPECIFIED)
    return NoiseFloor(resolution, FloorSource.SPECIFIED if specified else FloorSource.RESOLUTION)


def _step(values: Array) -> float:
    """Quantisation step of a column (n_t,): the smallest difference of its values; 0 if it has few different values."""
    gaps = np.diff(np.unique(values))
    return float(gaps.min()) if gaps.size >= _LEVELS else 0.0


def white_floor(residuals: Sequence[Array], settings: NoiseSettings) -> float | None:
    """Standard deviation of the white part of one signal or its residual; None if all logs are too short.

    A log that lacks samples counts by its stretches in which none is missing.

    It is that of the lowest band of the periodogram, pooled with all bands that are as low within their scatter. Slow
    and structured errors lie in the other bands. It is too low if the sensor has a low-pass filter.

    Args:
        residuals: one (n_t,) per log; not-a-number where nothing was measured.
    Source: Welch 1967, IEEE Transactions on Audio and Electroacoustics 15:70."""
    bands = settings.bands
    power, count = np.zeros(bands), np.zeros(bands)
    parts = (part for log in residuals for part in np.split(log, np.flatnonzero(np.isnan(log))))
    for rest in (part[np.isfinite(part)] for part in parts):
        n = rest.size
        if n < _ORDINATES * bands:
            continue
        taper = np.hanning(n)
        ordinates = np.abs(np.fft.rfft((rest - rest.mean()) * taper)) ** 2 / float(taper @ taper)
        band = np.minimum(np.arange(ordinates.size) * bands // ordinates.size, bands - 1)
        power += np.bincount(band, ordinates, bands)
        count += np.bincount(band, minlength=bands)
    if not count.all():
        return None
    order = np.argsort(power / count)
    total, weight = power[order[0]], count[order[0]]
    for band in order[1:]:
        scatter = math.sqrt(_TAPER * (1 / count[band] + 1 / weight))
        if power[band] / count[band] > total / weight * (1 + settings.joined * scatter):
            break
        total, weight = total + power[band], weight + count[band]
    return math.sqrt(total / weight)
