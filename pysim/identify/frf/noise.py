"""How noisy a fit is, judged by what it leaves over: its size, and whether it has a memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter
from scipy.stats import chi2

Array = NDArray[np.float64]

DECLARED, RESIDUALS, COLOURED = "declared noise", "white residuals", "residuals with a memory"
# Below this probability a test is taken to have failed; one white residual in a hundred is called coloured.
_UNLIKELY = 0.01
_MOST_LAGS = 20


@dataclass(frozen=True)
class ResidualNoise:
    """Standard deviation that white noise would need to disturb a sine, or a mean, as much as this noise does.

    Args:
        at_frequency: for the fitted sine, in the signal's unit.
        at_zero: for the mean, in the signal's unit.
        deviation: of the residuals themselves, in the signal's unit.
        basis: DECLARED, RESIDUALS or COLOURED.
        whiteness: probability that white residuals look as coloured as these (Ljung-Box).
    """

    at_frequency: float
    at_zero: float
    deviation: float
    basis: str
    whiteness: float


def residual_noise(
    residual: Array, parameters: int, frequency: float, interval: float, *, declared: float | None = None
) -> ResidualNoise:
    """Judge the residuals of a fit to evenly spaced samples.

    Declared noise counts where the residuals are white and no larger than it explains. Else the residuals decide; where
    they have a memory, their spectral density at the frequency counts, from an autoregressive model whose order is
    chosen by Akaike's criterion, and never less than if they were white.

    Args:
        residual: (n,), n well above the number of parameters.
        parameters: how many were fitted.
        frequency: Hz, of the sine in question.
        interval: s between samples.
        declared: standard deviation of the noise that the data set states, in the signal's unit.
    Source: Ljung and Box, Biometrika 65 (1978); Priestley, Spectral Analysis and Time Series, Section 7.8.
    """
    n = residual.size
    square = float(residual @ residual)
    variance = square / (n - parameters)
    correlation = _autocorrelation(residual, min(_MOST_LAGS, n // 5))
    whiteness = _ljung_box(correlation, n)
    white = whiteness > _UNLIKELY
    if white and declared is not None and chi2.sf(square / declared**2, n - parameters) > _UNLIKELY:
        return ResidualNoise(declared, declared, variance**0.5, DECLARED, whiteness)
    if white:
        return ResidualNoise(variance**0.5, variance**0.5, variance**0.5, RESIDUALS, whiteness)
    filter_ = _autoregression(correlation, n)
    scale = variance / float(np.sum(lfilter([1.0], filter_, _impulse(n)) ** 2))  # variance of what drives the filter
    floor = max(variance, 0.0 if declared is None else declared**2)
    at = [np.sqrt(max(scale * _gain(filter_, f * interval) ** 2, floor)) for f in (frequency, 0.0)]
    return ResidualNoise(float(at[0]), float(at[1]), variance**0.5, COLOURED, whiteness)


def _autocorrelation(x: Array, lags: int) -> Array:
    """At lags 0 to `lags`, (lags + 1,); zero memory for a residual that is zero."""
    total = float(x @ x)
    if total == 0.0:
        return np.eye(1, lags + 1)[0]
    return np.array([float(x[k:] @ x[: x.size - k]) / total for k in range(lags + 1)])


def _ljung_box(correlation: Array, n: int) -> float:
    lags = np.arange(1, correlation.size)
    statistic = n * (n + 2) * np.sum(correlation[1:] ** 2 / (n - lags))
    return float(chi2.sf(statistic, lags.size))


def _autoregression(correlation: Array, n: int) -> Array:
    """1, a_1 ... a_p of e_t + a_1 e_(t-1) + ... = white noise, by Levinson's recursion; p by Akaike's criterion."""
    a, power = np.ones(1), 1.0
    best, least = a, 0.0
    for order in range(1, correlation.size):
        reflection = -float(a @ correlation[order:0:-1][: a.size]) / power
        extended = np.append(a, 0.0)
        a = extended + reflection * extended[::-1]
        power *= 1 - reflection**2
        if power <= 0.0:
            break
        criterion = n * np.log(power) + 2 * order
        if criterion < least:
            best, least = a, criterion
    return best


def _impulse(n: int) -> Array:
    return np.eye(1, max(n, 2000))[0]


def _gain(filter_: Array, turns: float) -> float:
    """Of the noise model at a frequency in turns per sample."""
    return float(1 / abs(np.sum(filter_ * np.exp(-2j * np.pi * turns * np.arange(filter_.size)))))
