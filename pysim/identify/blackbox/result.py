"""A fitted transfer function with covariances and intervals."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtrc, ndtri, stdtrit

from pysim.identify.blackbox.response import ComplexResponse
from pysim.identify.blackbox.structure import Structure
from pysim.identify.transfer_function import TransferFunction
from pysim.types import Note

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class FittedNumber:
    """A coefficient, dead time or gain, in `unit`.

    Args:
        std: standard deviation to first order; infinite if the data do not determine the number.
        interval: ends of the confidence interval.
    """

    name: str
    unit: str
    value: float
    std: float
    interval: tuple[float, float]


@dataclass(frozen=True)
class Root:
    """A pole or zero: its value in rad/s and the covariance (2, 2) of its real and imaginary part, (rad/s)^2."""

    value: complex
    covariance: Array

    @property
    def frequency_hz(self) -> float:
        """Magnitude in Hz; for a conjugate pair, its natural frequency."""
        return abs(self.value) / (2 * np.pi)

    @property
    def frequency_deviation_hz(self) -> float:
        """Standard deviation of `frequency_hz`."""
        return self._along(np.array([self.value.real, self.value.imag]) / max(abs(self.value), 1e-300)) / (2 * np.pi)

    @property
    def damping(self) -> float:
        """Damping ratio: 1 for a negative real root; negative for a positive real part."""
        return -self.value.real / abs(self.value) if self.value else 0.0

    @property
    def damping_deviation(self) -> float:
        """Standard deviation of `damping`; 0 for a real root."""
        size = max(abs(self.value), 1e-300)
        return self._along(self.value.imag / size**3 * np.array([-self.value.imag, self.value.real]))

    def _along(self, slope: Array) -> float:
        with np.errstate(invalid="ignore"):
            variance = float(slope @ np.where(slope[:, None] * slope == 0, 0.0, self.covariance) @ slope)
        return float(np.sqrt(max(variance, 0.0))) if np.isfinite(variance) else np.inf


@dataclass(frozen=True)
class TransferFunctionFit:
    """A transfer function that was fitted to a frequency response.

    Args:
        function: with a monic denominator.
        structure: the given structure.
        data: the fitted response.
        weights: "covariance", "uniform" or "relative".
        names: names of the n_p estimated numbers: b_m ... b0, a_(n-1) ... a0, dead_time.
        spread: (n_p, r); spread @ spread.T is their covariance.
        undetermined: names of numbers that the data do not determine.
        poles, zeros: with their covariances, rad/s, by rising magnitude.
        cancelling: indices of pairs (pole, zero) that the data do not separate.
        at_origin: indices of poles that the data do not separate from integrators.
        standardised: (n_f, 2) residuals of real and imaginary part in standard deviations, measured minus fitted.
        misfit: weighted sum of squares.
        freedom: degrees of freedom: number of measured numbers less that of estimated ones.
        noise_known: whether the weights are the inverse noise, so that `misfit` should be near `freedom`.
        scatter: factor on the noise's variance: 1, or the mean square residual.
        converged: whether a tolerance of the search was reached.
        notes: reasons why the result may be wrong.
    """

    function: TransferFunction
    structure: Structure
    data: ComplexResponse
    weights: str
    names: tuple[str, ...]
    spread: Array
    undetermined: tuple[str, ...]
    poles: tuple[Root, ...]
    zeros: tuple[Root, ...]
    cancelling: tuple[tuple[int, int], ...]
    at_origin: tuple[int, ...]
    standardised: Array
    misfit: float
    freedom: int
    noise_known: bool
    scatter: float
    converged: bool
    notes: tuple[Note, ...] = ()

    @property
    def covariance(self) -> Array:
        """Covariance of the estimated numbers, (n_p, n_p), in the order of `names`, SI units."""
        return self.spread @ self.spread.T

    @property
    def values(self) -> Array:
        """The estimated numbers (n_p,), in the order of `names`."""
        coefficients = [*self.function.numerator, *self.function.denominator[1:]]
        return np.array(coefficients + [self.function.dead_time] * self.structure.delayed)

    @cached_property
    def model(self) -> Complex:
        """Fitted complex gain (n_f,) at the measured frequencies."""
        return self.function.at(self.data.frequency)

    @property
    def fit_percent(self) -> float:
        """See `fit_percent`."""
        return fit_percent(self.data.values, self.model)

    @property
    def explains(self) -> float:
        """p-value of the misfit: the probability that noise alone makes it as large; NaN if the noise is not known."""
        return float(chdtrc(self.freedom, self.misfit)) if self.noise_known else np.nan

    def estimates(self, level: float = 0.95) -> tuple[FittedNumber, ...]:
        """Every coefficient and the dead time with its interval at the level, to first order in the noise."""
        deviations = np.sqrt(np.sum(self.spread**2, axis=1))
        return tuple(
            self._estimate(name, float(value), float(deviation), "s" if name == "dead_time" else "", level)
            for name, value, deviation in zip(self.names, self.values, deviations, strict=True)
        )

    def gain(self, level: float = 0.95) -> FittedNumber:
        """G(0) with its interval, output unit per input unit; the interval is infinite if a pole may be at zero."""
        b0, a0 = self.function.numerator[-1], self.function.denominator[-1]
        if a0 == 0 or self.at_origin:
            return FittedNumber("gain", "", b0 / a0 if a0 else np.inf, np.inf, (-np.inf, np.inf))
        slope = np.zeros(len(self.names))
        slope[len(self.function.numerator) - 1] = 1 / a0
        if self.structure.poles:
            slope[self.names.index("a0")] = -b0 / a0**2
        touched = bool({"b0", "a0"} & set(self.undetermined))
        deviation = np.inf if touched else float(np.linalg.norm(slope @ self.spread))
        return self._estimate("gain", b0 / a0, deviation, "", level)

    def band(self, frequency: Array, level: float = 0.95) -> tuple[Array, Array]:
        """Half widths of the fitted curve's interval at frequencies (n,) in Hz: relative gain (n,) and phase (n,) rad.

        A pointwise interval of the curve itself, not of new measurements.
        """
        s = 2j * np.pi * np.asarray(frequency, dtype=np.float64)
        m, n = len(self.function.numerator), self.structure.poles
        over = s[:, None] ** np.arange(m - 1, -1, -1) / np.polyval(self.function.numerator, s)[:, None]
        under = -(s[:, None] ** np.arange(n - 1, -1, -1)) / np.polyval(self.function.denominator, s)[:, None]
        late = -s[:, None] if self.structure.delayed else np.empty((s.size, 0))
        logarithm = np.column_stack([over, under, late]) @ self.spread  # d ln G
        q = self.quantile(level)
        return q * np.linalg.norm(logarithm.real, axis=1), q * np.linalg.norm(logarithm.imag, axis=1)

    def quantile(self, level: float) -> float:
        """Half width of an interval in standard deviations: normal if the noise is known, otherwise Student's t."""
        tail = 0.5 + level / 2
        known = self.noise_known and self.scatter == 1.0
        return float(ndtri(tail) if known or self.freedom == 0 else stdtrit(self.freedom, tail))

    def _estimate(self, name: str, value: float, deviation: float, unit: str, level: float) -> FittedNumber:
        if name in self.undetermined:
            deviation = np.inf
        half = self.quantile(level) * deviation
        return FittedNumber(name, unit, value, deviation, (value - half, value + half))


def fit_percent(measured: Complex, fitted: Complex) -> float:
    """100 (1 - |measured - fitted| / |measured - mean(measured)|), Euclidean norms over the complex gains (n_f,).

    This is the NRMSE measure of MATLAB's `compare` and `tfest`, which for frequency-response data is over the complex
    gains, unweighted: 100 is perfect, 0 is no better than a constant gain. Frequencies with a small gain hardly count.
    Minus infinity if the measured gain is constant and the fit is not exact.
    """
    spread = float(np.linalg.norm(measured - np.mean(measured)))
    error = float(np.linalg.norm(measured - fitted))
    return 100 * (1 - error / spread) if spread > 0 else (100.0 if error == 0 else -np.inf)
