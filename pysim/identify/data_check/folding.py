"""Signal power close to half the sampling rate, a sign of aliasing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.data_check.settings import LogCheckSettings

Array = NDArray[np.float64]

_SETTINGS = LogCheckSettings()


def share_near_nyquist(values: Array, noise: float) -> float:
    """Share of a signal's variance close to half the sampling rate, after subtraction of the noise.

    Args:
        values: (n_t,) evenly spaced samples.
        noise: standard deviation of white noise from sensor and quantisation, in the signal's unit.
    """
    if values.size < _SETTINGS.fewest_in_spectrum:
        return 0.0
    window = np.hanning(values.size)
    moved = (values - np.polyval(np.polyfit(np.arange(values.size), values, 1), np.arange(values.size))) * window
    power = np.abs(np.fft.rfft(moved)) ** 2
    power -= noise**2 * float(window @ window)
    top = power[int(np.ceil(_SETTINGS.near_nyquist * (power.size - 1))) :]
    whole = float(power.sum())
    spread = noise**2 * float(window @ window) * np.sqrt(power.size)  # standard deviation of the noise's total power
    clear = whole > _SETTINGS.clear_power * spread and whole > 0
    return max(0.0, float(top.sum())) / whole if clear else 0.0
