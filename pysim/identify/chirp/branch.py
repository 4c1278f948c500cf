"""Frequency response by one kind of extreme, tops or bottoms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Branch:
    """Tops, bottoms, or their mean; frequencies increase.

    Args:
        frequency: (n,) Hz, of the command at its own extreme; Eq. 2.21 for the mean.
        gain: (n,) output unit per input unit, Eq. 2.15-2.17.
        phase: (n,) rad, unwrapped, Eq. 2.18-2.20.
        gain_deviation, phase_deviation: (n,) standard deviations due to noise.
    """

    frequency: Array
    gain: Array
    phase: Array
    gain_deviation: Array
    phase_deviation: Array

    @property
    def magnitude_db(self) -> Array:
        """20 log10 of the gain, (n,)."""
        return np.asarray(20 * np.log10(self.gain))

    @property
    def magnitude_deviation_db(self) -> Array:
        """Standard deviation of `magnitude_db`, (n,)."""
        return np.asarray(20 / np.log(10) * self.gain_deviation / self.gain)

    @property
    def phase_deg(self) -> Array:
        """Phase in degrees, (n,)."""
        return np.degrees(self.phase)

    def at(self, frequency: Array) -> tuple[Array, Array]:
        """Magnitude in dB and phase in degrees at frequencies (m,) in Hz, by linear interpolation between the points;
        NaN outside."""
        outside = {"left": np.nan, "right": np.nan}
        return (
            np.interp(frequency, self.frequency, self.magnitude_db, **outside),
            np.interp(frequency, self.frequency, self.phase_deg, **outside),
        )


def mean_branch(top: Branch, bottom: Branch) -> Branch:
    """The mean of pairs of neighbouring tops and bottoms.

    Their errors are taken as fully correlated, since neighbouring fits share samples; this is an upper bound.

    Source: thesis Eq. 2.17, 2.20, 2.21; the mean of decibels is the geometric mean of gains.
    """
    gain = np.sqrt(top.gain * bottom.gain)
    relative = 0.5 * (top.gain_deviation / top.gain + bottom.gain_deviation / bottom.gain)
    return Branch(
        frequency=0.5 * (top.frequency + bottom.frequency),
        gain=gain,
        phase=0.5 * (top.phase + bottom.phase),
        gain_deviation=gain * relative,
        phase_deviation=0.5 * (top.phase_deviation + bottom.phase_deviation),
    )
