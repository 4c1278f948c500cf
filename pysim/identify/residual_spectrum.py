"""Power spectrum of a log's residual; that of white noise alone is flat at one."""

from __future__ import annotations

import math

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from pysim.types import sampling

Array = NDArray[np.float64]

# Fewest samples for a spectrum.
FEWEST = 128
_SEGMENTS = 8  # number of segments of a log, without counting the overlapping ones between them
_CORRELATED = 18 / 19  # share of the degrees of freedom that remains with Hann windows that overlap by half


def residual_spectrum(time: Array, values: Array) -> tuple[Array, Array, float]:
    """Power of a residual over frequency; white noise of standard deviation one has power 1.

    Args:
        time: (n_t,) in s, evenly spaced.
        values: (n_t,), in standard deviations of the noise; at least FEWEST. Where one is not-a-number, zero takes its
            place, and the power is that of the others: exact for white noise, while a line loses some of its height.
    Returns:
        frequency (n_f,) in Hz, without zero and half the sampling rate, whose lines have half the degrees of freedom;
        power (n_f,); and the degrees of freedom of each value.
    Source: Welch 1967, IEEE Transactions on Audio and Electroacoustics 15:70; Hann windows that overlap by half.
    """
    step, there = sampling(time).step, np.isfinite(values)
    values = np.where(there, values, 0.0) / math.sqrt(max(float(np.mean(there)), 1 / values.size))
    length = min(values.size, max(FEWEST // 2, values.size // _SEGMENTS))
    window = np.sin(np.pi * np.arange(length) / length) ** 2
    segments = sliding_window_view(values, length)[:: length - length // 2]
    density = np.mean(np.abs(np.fft.rfft(window * segments)) ** 2, axis=0) / np.sum(window**2)
    count = 2 * (values.size // length) - 1
    frequency, lines = np.asarray(np.fft.rfftfreq(length, step), dtype=np.float64), slice(1, (length + 1) // 2)
    return frequency[lines], density[lines], 2 * count * _CORRELATED if count > 1 else 2.0
