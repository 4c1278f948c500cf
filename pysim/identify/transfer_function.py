"""A rational transfer function with dead time, and its frequency response (thesis Eq. 2.14, 4.1)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, FrequencyResponse, SineTest

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class TransferFunction:
    """G(s) = numerator(s) / denominator(s) exp(-dead_time s), s in rad/s.

    Args:
        numerator: coefficients from the highest power of s down.
        denominator: the same; the first is not zero.
        dead_time: s, not negative.
    """

    numerator: tuple[float, ...]
    denominator: tuple[float, ...]
    dead_time: float = 0.0

    def __post_init__(self) -> None:
        if not self.numerator or not self.denominator or self.denominator[0] == 0:
            raise BadInput("transfer function: needs a numerator and a denominator whose first coefficient is not zero")
        if not (self.dead_time >= 0 and math.isfinite(self.dead_time)):
            raise BadInput(f"transfer function: the dead time must be zero or positive seconds, got {self.dead_time}")

    def at(self, frequency: Array) -> Complex:
        """G(j 2 pi f) at the frequencies (n_f,) in Hz."""
        s = 2j * np.pi * np.asarray(frequency, dtype=np.float64)
        rational = np.polyval(self.numerator, s) / np.polyval(self.denominator, s)
        return np.asarray(rational * np.exp(-self.dead_time * s), dtype=np.complex128)

    def response(self, frequency: Array, test: SineTest, *, origin: str = "transfer function") -> FrequencyResponse:
        """Gain and continuous phase at frequencies (n_f,) in Hz, as the response of one stepped-sine test.

        The phase is the sum of the factors' phases, so it is right for any distance between frequencies.
        """
        frequency = np.asarray(frequency, dtype=np.float64)
        phase = _phase(self.numerator, frequency) - _phase(self.denominator, frequency)
        gain = np.abs(self.at(frequency))
        return FrequencyResponse(frequency, gain, phase - 2 * np.pi * frequency * self.dead_time, test, origin)

    @property
    def poles(self) -> Complex:
        """Roots of the denominator (n_p,), rad/s, by rising magnitude."""
        return _roots(self.denominator)

    @property
    def zeros(self) -> Complex:
        """Roots of the numerator (n_z,), rad/s, by rising magnitude; leading zero coefficients are ignored."""
        return _roots(self.numerator)

    @property
    def gain(self) -> float:
        """Static gain G(0), output unit per input unit; infinite with an integrator."""
        return self.numerator[-1] / self.denominator[-1] if self.denominator[-1] else math.inf

    @property
    def stable(self) -> bool:
        """Whether every pole is left of the imaginary axis."""
        return bool(np.all(self.poles.real < 0))


def _roots(coefficients: tuple[float, ...]) -> Complex:
    """Roots sorted by magnitude; of a conjugate pair, the one with the negative imaginary part is first."""
    roots = np.asarray(np.roots(coefficients), dtype=np.complex128)
    return roots[np.lexsort((roots.imag, np.abs(roots)))]


def _phase(coefficients: tuple[float, ...], frequency: Array) -> Array:
    """Continuous phase of a polynomial along the imaginary axis, (n_f,) rad, between -pi and pi at 0 Hz."""
    omega = 2 * np.pi * np.append(0.0, frequency)
    lead = next((c for c in coefficients if c), 1.0)
    total = np.full(omega.shape, np.angle(lead))
    for root in np.roots(coefficients):  # j omega - root never crosses the imaginary axis, so no factor jumps
        turn = np.arctan2(omega - root.imag, abs(root.real))
        total = total + (turn if root.real <= 0 else np.pi - turn)
    return total[1:] - 2 * np.pi * np.round(total[0] / (2 * np.pi))
