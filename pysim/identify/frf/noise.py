"""Noise of a fit, from the size and the colour of its residual."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtrc

Array = NDArray[np.float64]

DECLARED, RESIDUALS, COLOURED = "declared noise", "white residuals", "residuals with a memory"
# A test fails below this p-value; one to three white residuals in a hundred are called coloured.
_UNLIKELY = 0.01
_MOST_LAGS = 20
_NOTHING = 1e-8  # share of the largest variance below which a combination of lags has no variance, due to the fit


@dataclass(frozen=True)
class ResidualNoise:
    """Standard deviation of white noise that disturbs a fitted sine, or mean, as much as the actual noise does.

    Args:
        at_frequency: for the fitted sine, in the signal's unit.
        at_zero: for the mean, in the signal's unit.
        deviation: standard deviation of the residuals, in the signal's unit.
        basis: DECLARED, RESIDUALS or COLOURED.
        whiteness: p-value of the test for white noise.
        at_harmonics: (n_h,) for sines of 2, 3, ... times the frequency, in the signal's unit.
    """

    at_frequency: float
    at_zero: float
    deviation: float
    basis: str
    whiteness: float
    at_harmonics: tuple[float, ...] = ()

    def at_least(self, level: float) -> ResidualNoise:
        """The noise with `at_frequency` and `at_zero` raised to at least `level`."""
        return replace(self, at_frequency=max(self.at_frequency, level), at_zero=max(self.at_zero, level))


def residual_noise(
    residual: Array,
    regressors: Array,
    frequency: float,
    interval: float,
    *,
    declared: float | None = None,
    harmonics: int = 0,
) -> ResidualNoise:
    """Estimate the noise from the residual of a fit to evenly spaced samples.

    The declared noise is used if the residual is white and not significantly larger. Otherwise the residual gives the
    noise. If it is coloured, its spectral density at the frequency is used, from an autoregressive model with the order
    of Akaike's criterion, but never less than for white noise.

    Args:
        residual: (n,) residual of a least-squares fit.
        regressors: (n, p) columns of that fit, which colour the residual of white noise; n is well above p.
        frequency: frequency of the sine in Hz.
        interval: s between samples.
        declared: standard deviation of the noise that the data set specifies, in the signal's unit.
        harmonics: number of harmonics for which the noise is estimated too.
    Source: Priestley, Spectral Analysis and Time Series, Section 7.8; for the test see `_whiteness`.
    """
    n, freedom = residual.size, residual.size - regressors.shape[1]
    square = float(residual @ residual)
    variance = square / freedom
    correlation = _autocorrelation(residual, min(_MOST_LAGS, n // 5))
    whiteness = _whiteness(correlation, regressors)
    white = whiteness > _UNLIKELY
    if white and declared is not None and chdtrc(freedom, square / declared**2) > _UNLIKELY:
        return ResidualNoise(declared, declared, variance**0.5, DECLARED, whiteness, (declared,) * harmonics)
    if white:
        flat = variance**0.5
        return ResidualNoise(flat, flat, flat, RESIDUALS, whiteness, (flat,) * harmonics)
    filter_, share = _autoregression(correlation, n)
    scale = variance * share  # variance of the white noise that drives the filter
    floor = max(variance, 0.0 if declared is None else declared**2)
    periods = n * frequency * interval
    # Of the P spectral lines per harmonic, the fit has removed one, with its noise.
    taken = periods / (periods - 1) if periods > 1.5 else 1.0
    density = [taken * scale * _gain(filter_, k * frequency * interval) ** 2 for k in range(harmonics + 2)]
    at = [max(d, floor) ** 0.5 for d in density]
    return ResidualNoise(at[1], at[0], variance**0.5, COLOURED, whiteness, tuple(at[2:]))


def _autocorrelation(x: Array, lags: int) -> Array:
    """Autocorrelation at lags 0 to `lags`, (lags + 1,); that of white noise if x (n,) is zero."""
    total = float(x @ x)
    if total == 0.0:
        return np.eye(1, lags + 1)[0]
    return np.array([float(x[k:] @ x[: x.size - k]) / total for k in range(lags + 1)])


def _whiteness(correlation: Array, regressors: Array) -> float:
    """p-value of a test that the residual of a fit comes from white noise, by its autocorrelations.

    The residual is e = M z with M = I - Q Q'. The correlation at lag k is e'T_k e / e'e, where T_k is half the sum of
    the shifts by k to both sides. For Gaussian noise, mean and covariance of these ratios follow from traces of
    M T_i M T_j. Without regressors this is the test of Ljung and Box, Biometrika 65 (1978).

    Args:
        correlation: (lags + 1,).
        regressors: (n, p).
    Source: Mathai and Provost, Quadratic Forms in Random Variables (1992), Section 3.2d; chi-squared to first order.
    """
    n, lags = regressors.shape[0], correlation.size - 1
    if lags < 1 or not correlation[1:].any():
        return 1.0
    q, _ = np.linalg.qr(regressors)
    small = np.array([(q[k:].T @ q[: n - k]) for k in range(1, lags + 1)])
    small = (0.5 * (small + small.transpose(0, 2, 1))).reshape(lags, -1)  # Q' T_k Q
    trace = -small[:, :: q.shape[1] + 1].sum(axis=1)
    products = np.diag(0.5 * (n - np.arange(1.0, lags + 1))) - 2 * _shifted_products(q, lags) + small @ small.T
    m = n - q.shape[1]
    covariance = 2 * (products - np.outer(trace, trace) / m) / (m * (m + 2))
    variances, axes = np.linalg.eigh(covariance)
    free = variances > _NOTHING * variances[-1]
    off = axes[:, free].T @ (correlation[1:] - trace / m)
    return float(chdtrc(int(free.sum()), float(np.sum(off**2 / variances[free]))))


def _shifted_products(q: Array, lags: int) -> Array:
    """Traces of Q' T_i T_j Q, (lags, lags), from products of rows of Q (n, p) at distances 0 to 2 lags."""
    n = q.shape[0]
    sums = [np.append(0.0, np.cumsum(np.einsum("np,np->n", q[: n - d], q[d:]))) for d in range(2 * lags + 1)]
    found = np.empty((lags, lags))
    for j in range(1, lags + 1):
        for i in range(1, j + 1):  # products of the shifts in T_i and T_j: to the same side, then to opposite sides
            near, far = sums[j - i], sums[i + j]
            same = near[n - j] + near[n - j + i] - near[i]
            found[i - 1, j - 1] = found[j - 1, i - 1] = 0.25 * (same + 2 * far[-1])
    return found


def _autoregression(correlation: Array, n: int) -> tuple[Array, float]:
    """1, a_1 ... a_p of e_t + a_1 e_(t-1) + ... = white noise, and the variance of this noise over that of e.

    Levinson's recursion; the order p minimises Akaike's criterion.
    """
    a, power = np.ones(1), 1.0
    best, driven, least = a, power, 0.0
    for order in range(1, correlation.size):
        reflection = -float(a @ correlation[order:0:-1][: a.size]) / power
        extended = np.append(a, 0.0)
        a = extended + reflection * extended[::-1]
        power *= 1 - reflection**2
        if power <= 0.0:
            break
        criterion = n * np.log(power) + 2 * order
        if criterion < least:
            best, driven, least = a, power, criterion
    return best, driven


def _gain(filter_: Array, turns: float) -> float:
    """Gain of the autoregressive model at a frequency in turns per sample."""
    return float(1 / abs(np.sum(filter_ * np.exp(-2j * np.pi * turns * np.arange(filter_.size)))))
