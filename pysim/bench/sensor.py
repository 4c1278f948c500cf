"""What a sensor and its converter make of a signal: held samples, noise, limits, steps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, MeasuredSignal

Array = NDArray[np.float64]

_ROUNDING = 1e-9  # of a sampling interval


@dataclass(frozen=True)
class Sensor:
    """How one signal is measured.

    Args:
        signal: SI unit, with the standard deviation of the noise and the quantisation step; None stands for zero.
        low, high: limits of the measured value, in the signal's unit; None where there is none.
        rate: Hz at which it is sampled where that is less often than the log; the log then repeats the last sample.
    Raises:
        BadInput: negative noise, a step or rate that is not positive, or limits that leave nothing between them.
    """

    signal: MeasuredSignal
    low: float | None = None
    high: float | None = None
    rate: float | None = None

    def __post_init__(self) -> None:
        name, noise, step = self.signal.name, self.signal.noise, self.signal.resolution
        for what, value in (("noise", noise), ("resolution", step)):
            if value is not None and not (value >= 0 and math.isfinite(value)):
                raise BadInput(f"sensor {name}: {what} is {value:g}; give a finite number that is not negative")
        if self.rate is not None and not (self.rate > 0 and math.isfinite(self.rate)):
            raise BadInput(f"sensor {name}: rate is {self.rate:g} Hz; it must be positive and finite")
        if not (-math.inf if self.low is None else self.low) < (math.inf if self.high is None else self.high):
            raise BadInput(f"sensor {name}: its limits {self.low} and {self.high} leave nothing between; put low first")

    def sampled_at(self, time: Array) -> Array:
        """When the values were taken that a log shows at its times (n_t,), s."""
        if self.rate is None:
            return time
        return time[0] + np.floor((time - time[0]) * self.rate + _ROUNDING) / self.rate

    def measure(self, values: Array, random: np.random.Generator) -> Array:
        """Readings of true values (n_t,) that were each sampled anew: noise, then the limits, then steps.

        A reading is a whole number of steps and never beyond a limit.
        """
        noisy = values + random.normal(0.0, self.signal.noise, values.shape) if self.signal.noise else values
        clipped = np.clip(noisy, self.low, self.high) if (self.low, self.high) != (None, None) else noisy
        step = self.signal.resolution
        if not step:
            return clipped
        counts = np.round(clipped / step)
        if self.high is not None:
            counts = np.minimum(counts, math.floor(self.high / step + _ROUNDING))
        if self.low is not None:
            counts = np.maximum(counts, math.ceil(self.low / step - _ROUNDING))
        return np.asarray(counts * step)
