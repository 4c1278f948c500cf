"""How many independent samples residuals are worth that depend on those before them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FEW = 1024  # lags that are looked at first


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
    found = total = 0.0
    for j in range(channels):
        correlation = _memory([rest[:, j] for rest in left], lags)
        of_change = _products([change[:, j] for change in changed], correlation.size)
        total += of_change[0]
        found += of_change[0] + 2 * float(correlation[1:] @ of_change[1:])
    return max(found / total, 1.0) if total > 0 else 1.0


def _memory(rows: Sequence[Array], lags: int) -> Array:
    """Autocorrelation of rows (n_t,) at lags 0 ... before the first at which it is negative; that many at most."""
    count, end = 0, 1
    while end > count and count < lags:  # most residuals forget soon: few lags at first
        count = min(max(_FEW, 4 * count), lags)
        products = _products(rows, count)
        negative = np.flatnonzero(products[1:] <= 0)
        end = 1 + (int(negative[0]) if negative.size else count)
    products = products[: min(end, count)]
    return products / products[0] if products[0] > 0 else np.zeros(1)


def independent_pieces(residual: Array, shortest: float) -> int:
    """Into how many stretches a log's residual (n_t, n_y) can be cut that are independent of each other.

    Args:
        shortest: length of a stretch, in memories of the slowest channel.
    """
    n, slowest = len(residual), 1.0
    for column in residual.T:
        memory = _memory([column], n)
        slowest = max(slowest, 1 + 2 * float(memory[1:] @ (1 - np.arange(1, memory.size) / n)))
    return max(int(n / (shortest * slowest)), 1)


def _products(rows: Sequence[Array], count: int) -> Array:
    """Sums over t of row[t] row[t + k], for k = 0 ... count - 1, over all rows (n_t,)."""
    found = np.zeros(count)
    for row in rows:
        found[: row.size] += _own_products(row, min(count, row.size))
    return found


def _own_products(row: Array, lags: int) -> Array:
    """The same of one row, by FFT, in parts of it."""
    size = max(1 << int(np.ceil(np.log2(2 * lags))), min(8 * _FEW, 2 << int(np.log2(row.size))))
    step, power = size - lags, np.zeros(size // 2 + 1, dtype=np.complex128)
    for first in range(0, row.size, step):
        ahead = np.fft.rfft(row[first : first + size - 1], size)
        own = ahead if first + step >= row.size else np.fft.rfft(row[first : first + step], size)
        power += np.conj(own) * ahead
    return np.asarray(np.fft.irfft(power, size)[:lags])
