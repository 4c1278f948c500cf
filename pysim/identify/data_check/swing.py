"""Frequency, amplitude and offset of the logged command of a stepped sine."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.data_check.settings import LogCheckSettings
from pysim.identify.sine_fit import sine_fit
from pysim.types import sampling

Array = NDArray[np.float64]

_SETTINGS = LogCheckSettings()


@dataclass(frozen=True)
class Swing:
    """A sine that was fitted to a log.

    Args:
        frequency: Hz.
        amplitude, offset: in the signal's unit.
        impurity: root mean square of the residual over that of the sine.
    """

    frequency: float
    amplitude: float
    offset: float
    impurity: float


def swing(time: Array, values: Array, frequency: float) -> Swing:
    """Fit a sine with free frequency to a log (n_t,).

    Args:
        time: s.
        frequency: start in Hz; if its fit is poor, the spectrum's strongest frequency is tried too.
    """
    told = _refined(time, values, frequency)
    if told.impurity < _SETTINGS.poor_fit:
        return told
    found = _refined(time, values, _strongest(time, values))
    return found if found.impurity < told.impurity else told


def _strongest(time: Array, values: Array) -> float:
    """Frequency of the strongest line, Hz; times need not be equidistant by more than jitter."""
    step, padding = sampling(time).step, _SETTINGS.padding
    even = np.interp(np.arange(time[0], time[-1], step), time, values)
    spectrum = np.abs(np.fft.rfft((even - even.mean()) * np.hanning(even.size), padding * even.size))
    return max(float(np.argmax(spectrum)), 1.0) / (padding * even.size * step)


def _refined(time: Array, values: Array, frequency: float) -> Swing:
    """Gauss-Newton iteration on the frequency, with amplitude, phase and offset solved for at each frequency."""
    middle = 0.5 * (time[0] + time[-1])
    duration, first, s = float(time[-1] - time[0]), frequency, time - middle
    longest = _SETTINGS.longest_step / duration
    for _ in range(_SETTINGS.iterations):
        angle = 2 * math.pi * frequency * s
        columns = np.column_stack([np.sin(angle), np.cos(angle), np.ones_like(s)])
        (a, b, _), *_ = np.linalg.lstsq(columns, values, rcond=None)
        slope = 2 * math.pi * s * (a * columns[:, 1] - b * columns[:, 0])
        change = np.linalg.lstsq(np.column_stack([columns, slope]), values, rcond=None)[0][3]
        change = float(np.clip(change, -longest, longest))
        if not abs(frequency + change - first) < 1 / duration or frequency + change <= 0:
            break
        frequency += change
        if abs(change) * duration < 1e-9:
            break
    fit = sine_fit(time, values, frequency)
    impurity = fit.residual / (fit.amplitude / math.sqrt(2)) if fit.amplitude > 0 else math.inf
    return Swing(frequency, fit.amplitude, fit.offset, impurity)
