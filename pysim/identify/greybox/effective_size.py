"""How many independent samples residuals are worth that depend on those before them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def inflation(left: Sequence[Array], changed: Sequence[Array]) -> float:
    """By how much the colour of what is left inflates the variance of a sum over samples: lambda, at least 1.

    lambda = sum over lags of the two autocorrelations' product, up to the first negative one of what is left; n/lambda
    is the effective sample size. Series of several channels are pooled, each weighted by the squares of its change.

    Args:
        left: per log, residuals (n_t, n_y) over their levels.
        changed: per log, what a parameter or an effect changes in them (n_t, n_y).
    Source: Bartlett 1946, Supplement to the Journal of the Royal Statistical Society 8:27; the end of the sum Geyer
        1992, Statistical Science 7:473.
    """
    if not left:
        return 1.0
    lags, channels = max(len(rows) for rows in left), left[0].shape[1]
    of_left, of_change = np.zeros((lags, channels)), np.zeros((lags, channels))
    for rest, change in zip(left, changed, strict=True):
        of_left[: len(rest)] += _products(rest)
        of_change[: len(change)] += _products(change)
    weight = of_change[0].copy()
    total = float(weight.sum())
    if not total > 0:
        return 1.0
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = np.where(of_left[0] > 0, of_left / of_left[0], 0.0)
    found = 0.0
    for j in range(channels):
        negative = np.flatnonzero(correlation[1:, j] <= 0)
        end = 1 + (int(negative[0]) if negative.size else lags - 1)
        found += weight[j] + 2 * float(correlation[1:end, j] @ of_change[1:end, j])
    return max(found / total, 1.0)


def _products(rows: Array) -> Array:
    """Sums over t of rows[t] rows[t + k], for k = 0 ... n - 1, per column, by FFT."""
    n = len(rows)
    size = 1 << int(np.ceil(np.log2(2 * n)))
    power = np.abs(np.fft.rfft(rows, size, axis=0)) ** 2
    return np.asarray(np.fft.irfft(power, size, axis=0)[:n])
