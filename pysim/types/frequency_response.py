"""The response to sines around one working point, over frequency: measured, simulated or from a transfer function."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types.errors import BadInput
from pysim.types.sine_test import SineTest

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FrequencyResponse:
    """Gain and phase of one output to sines on one input (thesis Eq. 2.11-2.13).

    Args:
        frequency: (n_f,) Hz, increasing.
        gain: (n_f,) fitted amplitude divided by the commanded one, output unit per input unit.
        phase: (n_f,) rad, unwrapped; negative where the output lags the command.
        test: what was commanded, and which signals these are.
        origin: "measured", "simulated" or "transfer function", and of what.
        mean: (n_f,) fitted offset of the output (Eq. 2.10), or None where it is not known.
        covariance: (n_f, 3, 3) of fitted amplitude (output unit), phase (rad) and mean, or None where not known.
    Raises:
        BadInput: shapes that do not match, values that are not finite, frequencies that do not increase.
    """

    frequency: Array
    gain: Array
    phase: Array
    test: SineTest
    origin: str
    mean: Array | None = None
    covariance: Array | None = None

    def __post_init__(self) -> None:
        n_f = np.size(self.frequency)
        shapes = {"frequency": (n_f,), "gain": (n_f,), "phase": (n_f,), "mean": (n_f,), "covariance": (n_f, 3, 3)}
        for name, shape in shapes.items():
            value = getattr(self, name)
            if value is None:
                continue
            array = np.array(value, dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, name, array)
            if array.shape != shape:
                raise BadInput(f"frequency response: {name} needs shape {shape}, got {array.shape}")
            if not np.isfinite(array).all():
                raise BadInput(f"frequency response: every number of {name} must be finite")
        if n_f == 0 or self.frequency[0] <= 0 or np.any(np.diff(self.frequency) <= 0):
            raise BadInput("frequency response: frequencies must be positive and increase")
        if np.any(self.gain <= 0):
            raise BadInput("frequency response: gains must be positive")
