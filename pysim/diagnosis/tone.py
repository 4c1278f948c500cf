"""A tone that a residual holds: one line of a log's spectrum that stands out of those beside it.

Noise of any colour has a spectrum that is level over a few lines. What turns with a shaft, or hums with the mains, has
not.

Source: Fisher 1929, Proceedings of the Royal Society A 125:54, each line here against the lines beside it.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.rivals import of

Array = NDArray[np.float64]

# Lines on either side that belong to a tone (the main lobe of Hann's window), lines beyond them that tell the level,
# and how many independent ones these are worth, since the window makes neighbours alike.
_LOBE, _BESIDE, _WORTH = 2, 8, 8
_EVEN = 0.01  # of the interval between two samples: how much it may vary


def tone(fit: FinalFit, false_alarm: float) -> float | None:
    """Frequency in Hz of the clearest tone in what a model leaves of the logs over time; None where there is none.

    Args:
        false_alarm: chance of finding one in noise.
    """
    left, series = of(fit), fit.candidate.residuals(fit.simulation).series
    logs = [(k, one.runs[0].experiment.times) for k, (one, name) in enumerate(series) if one.domain == "time" and name]
    found = [line for k, times in logs if (line := clearest(times, left.residual[left.series == k])) is not None]
    if not found:
        return None
    chance, frequency = min(found)
    return frequency if chance * len(found) < false_alarm else None


def clearest(times: Array, rest: Array) -> tuple[float, float] | None:
    """The line that stands out most of a residual (n_t,): chance of it in noise, all lines counted, and Hz.

    Returns:
        None where the log is too short, or its samples are not evenly spaced.
    """
    step = np.diff(times)
    far = _LOBE + _BESIDE
    if rest.size != times.size or rest.size < 8 * far or np.ptp(step) > _EVEN * step.mean():
        return None
    power = np.abs(np.fft.rfft((rest - rest.mean()) * np.hanning(rest.size))) ** 2
    beside = [np.roll(power, shift) for k in range(_LOBE + 1, far + 1) for shift in (k, -k)]
    level = np.median(beside, axis=0) / math.log(2)  # the mean of an exponential law, from its median
    inner = slice(far, power.size - far)
    over = power[inner] / np.maximum(level[inner], np.finfo(float).tiny)
    line = int(np.argmax(over))
    chance = over.size * (1 + over[line] / _WORTH) ** -_WORTH  # F with 2 and 2 times as many degrees of freedom
    return float(chance), (line + far) / (rest.size * float(step.mean()))
