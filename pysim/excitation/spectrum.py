"""The Pierson-Moskowitz wave spectrum (thesis Appendix A)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pysim.excitation._check import check_positive
from pysim.types import BadInput

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PiersonMoskowitz:
    """One-sided spectrum over angular frequency: S(omega) = a omega^-5 exp(-b omega^-4).

    With H the significant height and T the peak period, a = 5 pi^4 H^2 / T^4 and b = 20 pi^4 / T^4: the largest value
    is at 2 pi / T, and the variance is (H / 4)^2.

    Args:
        significant_height: in the command's unit; four standard deviations of the wave.
        peak_period: s.
    Raises:
        BadInput: a number that is not positive and finite.
    Source: thesis Appendix A, Eq. 1.
    """

    significant_height: float
    peak_period: float

    def __post_init__(self) -> None:
        check_positive("wave spectrum: the significant height", self.significant_height, "")
        check_positive("wave spectrum: the peak period", self.peak_period, "s")

    @property
    def _a(self) -> float:
        return 5 * math.pi**4 * self.significant_height**2 / self.peak_period**4

    @property
    def _b(self) -> float:
        return 20 * math.pi**4 / self.peak_period**4

    def density(self, omega: ArrayLike) -> Array:
        """S at angular frequencies (n,) in rad/s, in the command's unit squared times s; zero at and below zero."""
        omega = np.asarray(omega, dtype=np.float64)
        positive = np.where(omega > 0, omega, 1.0)
        return np.where(omega > 0, self._a * positive**-5 * np.exp(-self._b * positive**-4), 0.0)

    def energy_below(self, omega: ArrayLike) -> Array:
        """Share of the variance below angular frequencies (n,) in rad/s: exp(-b omega^-4)."""
        omega = np.asarray(omega, dtype=np.float64)
        return np.where(omega > 0, np.exp(-self._b * np.where(omega > 0, omega, 1.0) ** -4), 0.0)

    def frequency_of_energy(self, share: float) -> float:
        """Angular frequency in rad/s below which that share of the variance lies.

        Raises:
            BadInput: a share that is not between 0 and 1.
        """
        if not 0 < share < 1:
            raise BadInput(f"wave spectrum: {share:g} is no share of its variance; give a number between 0 and 1")
        return float((self._b / -math.log(share)) ** 0.25)

    def moment(self, order: float) -> float:
        """The integral of omega^order S(omega): a/4 b^(order/4 - 1) Gamma(1 - order/4).

        Raises:
            BadInput: an order of 4 or more, for which the integral diverges.
        """
        if not order < 4:
            raise BadInput(f"wave spectrum: its moment of order {order:g} is infinite; only orders below 4 exist")
        return self._a / 4 * self._b ** (order / 4 - 1) * math.gamma(1 - order / 4)
