"""Covariance of a fit with autocorrelated residuals, such as those of filtered signals."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def correlation_length(residuals: Array, lengths: Sequence[int]) -> float:
    """Number of residuals per independent one, at least 1: sample size over effective sample size.

    1 + 2 sum of the autocorrelation, up to the lag where the sum of two neighbours turns negative (Geyer's initial
    positive sequence, 1992). Products are formed within tests only.

    Args:
        residuals: (n,) in the order of time, test after test.
        lengths: residuals per test.
    """
    parts = np.split(residuals, np.cumsum(lengths)[:-1])
    size = 2 ** int(np.ceil(np.log2(2 * max(lengths))))
    powers = [np.abs(np.fft.rfft(part, size)) ** 2 for part in parts]
    covariance = np.fft.irfft(np.sum(powers, axis=0), size)[: max(lengths)]
    if covariance[0] <= 0:
        return 1.0
    rho = covariance / covariance[0]
    pairs = rho[: rho.size // 2 * 2].reshape(-1, 2).sum(axis=1)
    negative = np.flatnonzero(pairs <= 0)
    count = int(negative[0]) if negative.size else pairs.size
    return max(1.0, float(2 * pairs[:count].sum() - 1))


def score_covariance(slopes: Array, errors: Array, lengths: Sequence[int], length: float) -> Array:
    """Covariance (p, p) of least-squares estimates by a sandwich with Bartlett's weights (Newey and West, 1987).

    Args:
        slopes, errors: (n, p) and (n,), weighted as in the fit.
        lengths: rows per test; products are formed within tests only.
        length: from `correlation_length`; lags up to four times it are used.
    Returns:
        the covariance times n / (n - p length), which corrects for the estimated parameters.
    """
    n, p = slopes.shape
    lags = int(np.ceil(4 * length)) if length > 1 else 0
    scores = np.split(slopes * errors[:, None], np.cumsum(lengths)[:-1])
    middle = sum(part.T @ part for part in scores)
    for lag in range(1, lags + 1):
        cross = sum((part[lag:].T @ part[:-lag] for part in scores if len(part) > lag), np.zeros((p, p)))
        middle = middle + (1 - lag / (lags + 1)) * (cross + cross.T)
    bread = np.linalg.pinv(slopes.T @ slopes)
    return bread @ middle @ bread * n / max(n - p * length, 1.0)
