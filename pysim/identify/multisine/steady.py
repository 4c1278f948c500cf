"""Spectra of the steady state over the harmonics of one period, with the covariance of their noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.local_fit import local_fit, powers, windows
from pysim.identify.multisine.periods import Periods
from pysim.types import BadInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

# Rounding error of double precision relative to the largest line; the noise is taken to be at least this.
_ROUNDING = 1e-13


@dataclass(frozen=True)
class SteadySpectra:
    """Amplitudes X of x(t) = Re sum_k X_k exp(j 2 pi k t / period), averaged over the periods of each realisation.

    Args:
        values: (M, n_l, n_s) at the harmonics 1, 2, ..., n_l.
        noise: (n_l, n_s, n_s) covariance E[e e^H] of one realisation's values; None if there is only one period.
        degrees: (n_l,) complex degrees of freedom of `noise`.
        span: number of harmonics over which estimates of the noise share data; 1 if they do not.
        means: (M, P, n_s) mean of every period.
        periods: the periods of the spectra.
    """

    values: Complex
    noise: Complex | None
    degrees: Array
    span: float
    means: Array
    periods: Periods

    @property
    def frequency(self) -> Array:
        """(n_l,) Hz."""
        return np.arange(1, self.values.shape[1] + 1) / self.periods.period


class Transient(Protocol):
    """A way to remove the initial transient from the spectra."""

    def spectra(self, periods: Periods) -> SteadySpectra:
        """Spectra of the steady state."""
        ...


@dataclass(frozen=True)
class DropPeriods:
    """Leave out the first periods, and take the rest as steady; the noise is their scatter.

    This is right only if the transient has faded by then. Source: Pintelon and Schoukens, System Identification: A
    Frequency Domain Approach, 2nd edition, Eq. 2-31 to 2-33.
    """

    count: int = 1

    def spectra(self, periods: Periods) -> SteadySpectra:
        """Spectra from P - count periods; there is no noise estimate from a single period."""
        kept = periods.without_first(self.count)
        m, p = kept.values.shape[:2]
        lines = _amplitudes(kept.values, axis=2)  # (M, P, n_l, n_s)
        mean = lines.mean(axis=1)
        means = kept.values.mean(axis=2)
        n_l = mean.shape[1]
        if p == 1:
            return SteadySpectra(mean, None, np.zeros(n_l), 1.0, means, kept)
        left = lines - mean[:, None]
        noise = np.einsum("mpki,mpkj->kij", left, np.conj(left)) / (m * (p - 1)) / p
        return SteadySpectra(mean, _floored(noise, mean), np.full(n_l, m * (p - 1.0)), 1.0, means, kept)


@dataclass(frozen=True)
class LocalTransient:
    """Estimate transient and noise on the lines between the harmonics, where there is nothing else.

    The spectrum of all P periods together has P - 1 such lines between two harmonics. The spectrum of a transient is
    smooth, so a polynomial through the lines around a harmonic gives the transient at the harmonic. The polynomial's
    residual is noise. All periods are used; two are needed, and a window that is narrower than the resonances.

    Args:
        order: degree of the polynomial.
        lines: lines in a window; lines - order - 1 complex degrees of freedom remain for the noise, per realisation.
    Raises:
        BadInput: too few lines for the order.
    Source: Pintelon, Barbé, Vandersteen, Schoukens, Improved (non-)parametric identification of dynamic systems
    excited by periodic signals, Mechanical Systems and Signal Processing 25 (2011), 2683-2704.
    """

    order: int = 2
    lines: int = 10

    def __post_init__(self) -> None:
        if self.order < 0 or self.lines < self.order + 2:
            raise BadInput(
                f"transient: order {self.order} needs at least {self.order + 2} lines in a window, got {self.lines}"
            )

    def spectra(self, periods: Periods) -> SteadySpectra:
        """Spectra from all periods, less the transient."""
        m, p, n, n_s = periods.values.shape
        if p < 2:
            raise BadInput("transient: one period does not tell the transient from the response; record two or more")
        whole = _amplitudes(periods.values.reshape(m, p * n, n_s), axis=1)  # (M, lines of P periods, n_s)
        numbers = np.arange(1, whole.shape[1] + 1)
        between = numbers[numbers % p != 0]
        harmonics = p * np.arange(1, (n - 1) // 2 + 1)
        at = windows(harmonics, between, self.lines)
        distance = (between[at] - harmonics[:, None]).astype(np.float64)
        regressors = powers(distance, self.order)
        fits = [local_fit(regressors, one[between - 1][at]) for one in whole]
        values = whole[:, harmonics - 1] - np.stack([fit.coefficients[:, 0] for fit in fits])
        residual = np.mean([fit.residual for fit in fits], axis=0)
        noise = residual * (1 + fits[0].gram[:, 0, 0].real)[:, None, None]
        degrees = np.full(harmonics.size, float(m * fits[0].degrees))
        span = self.lines / (p - 1)
        return SteadySpectra(values, _floored(noise, values), degrees, span, periods.values.mean(axis=2), periods)


def _amplitudes(values: Array, axis: int) -> Complex:
    """Complex amplitudes of the lines above zero and below the Nyquist frequency."""
    n = values.shape[axis]
    spectrum = np.fft.rfft(values, axis=axis) * (2 / n)
    return np.asarray(np.take(spectrum, np.arange(1, (n - 1) // 2 + 1), axis=axis), dtype=np.complex128)


def _floored(noise: Complex, values: Complex) -> Complex:
    """The covariance plus that of rounding errors."""
    floor = (_ROUNDING * np.abs(values).max(axis=(0, 1))) ** 2
    return noise + np.diag(floor)
