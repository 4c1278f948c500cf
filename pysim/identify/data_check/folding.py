"""Signal power close to half the sampling rate, a sign of aliasing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_NEAR = 0.8  # of half the sampling rate


def share_near_nyquist(values: Array, noise: float) -> float:
    """Share of a signal's variance above 80 percent of half the sampling rate, after subtraction of the noise.

    Args:
        values: (n_t,) evenly spaced samples.
        noise: standard deviation of white noise from sensor and quantisation, in the signal's unit.
    """
    if values.size < 16:
        return 0.0
    window = np.hanning(values.size)
    moved = (values - np.polyval(np.polyfit(np.arange(values.size), values, 1), np.arange(values.size))) * window
    power = np.abs(np.fft.rfft(moved)) ** 2
    power -= noise**2 * float(window @ window)
    top = power[int(np.ceil(_NEAR * (power.size - 1))) :]
    whole = float(power.sum())
    spread = noise**2 * float(window @ window) * np.sqrt(power.size)  # standard deviation of the noise's total power
    return max(0.0, float(top.sum())) / whole if whole > 5 * spread and whole > 0 else 0.0
