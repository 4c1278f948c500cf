"""A rational transfer function and its frequency response (thesis Eq. 2.14, 4.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, FrequencyResponse, SineTest

Array = NDArray[np.float64]


@dataclass(frozen=True)
class TransferFunction:
    """G(s) = numerator(s) / denominator(s), s in rad/s.

    Args:
        numerator: coefficients from the highest power of s down.
        denominator: the same; the first is not zero.
    """

    numerator: tuple[float, ...]
    denominator: tuple[float, ...]

    def __post_init__(self) -> None:
        if not self.numerator or not self.denominator or self.denominator[0] == 0:
            raise BadInput("transfer function: needs a numerator and a denominator whose first coefficient is not zero")

    def at(self, frequency: Array) -> NDArray[np.complex128]:
        """G(j 2 pi f) at the frequencies (n_f,) in Hz."""
        s = 2j * np.pi * np.asarray(frequency, dtype=np.float64)
        return np.asarray(np.polyval(self.numerator, s) / np.polyval(self.denominator, s), dtype=np.complex128)

    def response(self, frequency: Array, test: SineTest, *, origin: str = "transfer function") -> FrequencyResponse:
        """Gain and unwrapped phase at frequencies (n_f,) in Hz, standing for the response of one stepped-sine test.

        The phase is the sum of the factors' phases, so that it is right however wide the frequencies are apart.
        """
        frequency = np.asarray(frequency, dtype=np.float64)
        phase = _phase(self.numerator, frequency) - _phase(self.denominator, frequency)
        gain = np.abs(self.at(frequency))
        return FrequencyResponse(frequency, gain, phase, test, origin)


def _phase(coefficients: tuple[float, ...], frequency: Array) -> Array:
    """The continuous phase of a polynomial along the imaginary axis, (n_f,) rad, within half a turn of 0 at 0 Hz."""
    omega = 2 * np.pi * np.append(0.0, frequency)
    total = np.full(omega.shape, np.angle(coefficients[0]))
    for root in np.roots(coefficients):  # j omega - root never crosses the imaginary axis, so no factor jumps
        turn = np.arctan2(omega - root.imag, abs(root.real))
        total = total + (turn if root.real <= 0 else np.pi - turn)
    return total[1:] - 2 * np.pi * np.round(total[0] / (2 * np.pi))
