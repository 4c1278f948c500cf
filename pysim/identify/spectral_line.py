"""A line in a residual's spectrum that stands out of the lines beside it, and the periodogram of several logs.

The spectrum of noise, of any colour, is nearly level over a few lines. A rotating shaft or the mains makes a line that
stands out.

Source: Fisher 1929, Proceedings of the Royal Society A 125:54; here each line is tested against the lines beside it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types.setting import setting

Array = NDArray[np.float64]


@dataclass(frozen=True)
class LineSettings:
    """When one line of a spectrum stands out of those beside it."""

    lobe: int = setting(
        2, unit="1", meaning="lines on either side that belong to a tone", source="main lobe of Hann's window"
    )
    beside: int = setting(
        8, unit="1", meaning="further lines, on either side, that give the noise level", source="noise is level there"
    )
    worth: int = setting(
        8, unit="1", meaning="independent lines that these are worth", source="half, as Hann's window joins two"
    )
    false_alarm: float = setting(
        1e-3, unit="1", meaning="chance of such a line in noise, below which it is named where a model fails",
        source="as `diagnosis.Settings.false_alarm`",
    )  # fmt: skip
    even: float = setting(
        0.01,
        unit="1",
        meaning="share of the mean by which sampling intervals may differ",
        source="half a percent of the shortest period",
    )


_LINE = LineSettings()


def spectral_line(times: Array, rest: Array) -> tuple[float, float] | None:
    """The most significant spectral line of a residual (n_t,); zero takes the place of one that is not-a-number.

    Returns:
        its p-value, corrected for the number of lines, and Hz; None for a short log or uneven sampling.
    """
    step = np.diff(times)
    lobe, worth = _LINE.lobe, _LINE.worth
    far = lobe + _LINE.beside
    if rest.size != times.size or rest.size < 8 * far or np.ptp(step) > _LINE.even * step.mean():
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
