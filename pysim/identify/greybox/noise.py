"""How much a measured signal trembles: told by the data set, or seen in the log itself."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, MeasuredSignal

Array = NDArray[np.float64]

# Fourth differences of white noise of variance 1 have the variance 1 + 16 + 36 + 16 + 1.
_GAIN = 70.0


def told_noise(signal: MeasuredSignal) -> float | None:
    """Standard deviation of noise and quantisation together, in the signal's unit; None where the noise is not told."""
    if signal.noise is None:
        return None
    size = math.hypot(signal.noise, (signal.resolution or 0.0) / math.sqrt(12))
    if not size > 0:
        raise BadInput(f"signal {signal.name!r}: a noise of {signal.noise} gives no weight; leave it out or correct it")
    return size


def seen_noise(values: Array) -> float:
    """Standard deviation of white noise on a smooth signal (n_t,), from its fourth differences.

    Robust against single events by the median; too large where the signal itself changes from sample to sample.
    """
    differences = np.diff(values, 4)
    if differences.size == 0:
        return math.nan
    middle = float(np.median(np.abs(differences))) / 0.6745
    return (middle or float(np.sqrt(np.mean(differences**2)))) / math.sqrt(_GAIN)


def signal_noise(signal: MeasuredSignal, logs: list[Array], given: Mapping[str, float]) -> tuple[float, str]:
    """The noise of one signal, and a note where it had to be estimated; the caller's own number goes first.

    Raises:
        BadInput: neither told nor to be seen.
    """
    size = given.get(signal.name) or told_noise(signal)
    if size is not None:
        return size, ""
    seen = [value for log in logs if math.isfinite(value := seen_noise(log)) and value > 0]
    if not seen:
        raise BadInput(f"signal {signal.name!r}: its noise is neither told nor seen in the logs; give noise = a number")
    size = float(np.median(seen))
    return size, f"noise of {signal.name} not told by the data set; {size:.3g} {signal.unit} seen in the logs"
