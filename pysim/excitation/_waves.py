"""Sums of sines as signals."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pysim.excitation.lead_in import LeadIn
from pysim.types import Signal

Array = NDArray[np.float64]

# Samples per period of the fastest sine when zeros and peaks are looked for; what lies between two is refined.
_SAMPLES = 32


def wave_signal(waves: Array, *, offset: float, first: float, onset: float) -> Signal:
    """offset plus all waves, from `first` on.

    Args:
        waves: (n, 3) amplitude, phase at the onset (rad), angular frequency (rad/s).
        offset: in the amplitudes' unit.
        first, onset: s.
    """
    amplitude, phase, omega = waves.T
    sines = np.column_stack([amplitude, phase + omega * (first - onset), omega, np.zeros_like(omega)])
    return Signal(np.array([first]), np.array([[offset, 0.0, 0.0, 0.0]]), sines[None])


def start_in_hold(waves: Array, lead: LeadIn) -> float:
    """The last time before the onset, within the hold, at which the waves (n, 3) add up to zero, s.

    The onset itself where there is no such time: the command then jumps there.
    """
    step = 2 * math.pi / float(waves[:, 2].max()) / _SAMPLES
    back: Array = -step * np.arange(math.ceil(lead.hold / step) + 1, dtype=np.float64)
    back = back[back >= -lead.hold]
    wave = wave_signal(waves, offset=0.0, first=-lead.hold, onset=0.0)
    values = wave.value(back)
    crossed = np.flatnonzero(np.signbit(values[1:]) != np.signbit(values[:-1]))
    if crossed.size == 0:
        return lead.onset
    return lead.onset + _zero(wave, float(back[crossed[0] + 1]), float(back[crossed[0]]))


def _zero(wave: Signal, low: float, high: float) -> float:
    """Where the signal passes zero between two times of different sign, by bisection to the last digit."""
    negative = wave.value(np.array([low]))[0] < 0
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            return middle
        if (wave.value(np.array([middle]))[0] < 0) == negative:
            low = middle
        else:
            high = middle


def largest_value(waves: Array, period: float) -> float:
    """Largest absolute value of the waves (n, 3) over one period (s), between samples by a parabola."""
    count = math.ceil(_SAMPLES * period * float(waves[:, 2].max()) / (2 * math.pi))
    amplitude, phase, omega = waves.T
    lines = np.rint(omega * period / (2 * math.pi)).astype(int)
    spectrum = np.zeros(count // 2 + 1, dtype=complex)
    np.add.at(spectrum, lines, amplitude * np.exp(1j * (phase - math.pi / 2)) * count / 2)
    values = np.abs(np.fft.irfft(spectrum, count))
    before, after = np.roll(values, 1), np.roll(values, -1)
    curvature = before - 2 * values + after
    top = (values >= before) & (values >= after) & (curvature < 0)
    return float(np.max(values[top] - (after[top] - before[top]) ** 2 / (8 * curvature[top])))
