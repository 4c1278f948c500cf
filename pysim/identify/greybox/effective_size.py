"""Effective sample size of autocorrelated residuals."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FEW = 1024  # lags that are computed first


def inflation(left: Sequence[Array], changed: Sequence[Array]) -> float:
    """Factor lambda >= 1 by which autocorrelation of the residual inflates a variance; n/lambda is the effective size.

    lambda is the sum over lags of the product of two autocorrelations: that of the residual and that of the change. The
    sum ends at the residual's first negative value. Channels are pooled, weighted by the squares of their change.

    Args:
        left: per log, residuals (n_t, n_y) over their levels.
        changed: per log, what a parameter or an effect changes in them (n_t, n_y).
    Source: Bartlett 1946, Supplement to the Journal of the Royal Statistical Society 8:27; for the end of the sum,
        Geyer 1992, Statistical Science 7:473.
    """
    if not left:
        return 1.0
    lags, channels = max(len(rows) for rows in left), left[0].shape[1]
    power = sum(np.sum(change**2, axis=0) for change in changed)
    total = float(np.sum(power))
    if not total > 0:
        return 1.0
    found = 0.0
    for j in range(channels):
        count, end = 0, 1
        while end > count and count < lags:  # most autocorrelations fade soon: few lags at first
            count = min(max(_FEW, 4 * count), lags)
            of_left = _products([rest[:, j] for rest in left], count)
            negative = np.flatnonzero(of_left[1:] <= 0)
            end = 1 + (int(negative[0]) if negative.size else count)
        end = min(end, count)
        of_change = _products([change[:, j] for change in changed], end)
        with np.errstate(invalid="ignore", divide="ignore"):
            correlation = of_left / of_left[0] if of_left[0] > 0 else np.zeros(count)
        found += of_change[0] + 2 * float(correlation[1:end] @ of_change[1:end])
    return max(found / total, 1.0)


def independent_pieces(residuals: Sequence[Array], shortest: float) -> int:
    """Number of stretches of a log that count as independent of each other, at least 1.

    Args:
        residuals: per channel (n,), of the samples that were measured.
        shortest: length of a stretch in units of lambda of the slowest channel, its autocorrelation time in samples.
    """
    columns = [rest[:, None] for rest in residuals if rest.size]
    counts = [len(column) / (shortest * inflation([column], [np.ones_like(column)])) for column in columns]
    return max(int(min(counts, default=1.0)), 1)


def piece_of_sample(there: NDArray[np.bool_], count: int) -> NDArray[np.intp]:
    """(n_t,) number of the stretch that each sample of a log is in; all stretches hold equally many measured values.

    Args:
        there: (n_t, n_y) whether a value was measured.
        count: of stretches.
    """
    found = np.cumsum(np.count_nonzero(there, axis=1))
    ahead = np.concatenate([[0], found[:-1]])
    return np.asarray(np.minimum(ahead * count // max(int(found[-1]), 1), count - 1))


def _products(rows: Sequence[Array], count: int) -> Array:
    """Sums over t of row[t] row[t + k], for k = 0 ... count - 1, over all rows (n_t,)."""
    found = np.zeros(count)
    for row in rows:
        found[: row.size] += _own_products(row, min(count, row.size))
    return found


def _own_products(row: Array, lags: int) -> Array:
    """Sums over t of row[t] row[t + k] for k = 0 ... lags - 1, by FFT of overlapping parts of the row."""
    size = max(1 << int(np.ceil(np.log2(2 * lags))), min(8 * _FEW, 2 << int(np.log2(row.size))))
    step, power = size - lags, np.zeros(size // 2 + 1, dtype=np.complex128)
    for first in range(0, row.size, step):
        ahead = np.fft.rfft(row[first : first + size - 1], size)
        power += np.conj(np.fft.rfft(row[first : first + step], size)) * ahead
    return np.asarray(np.fft.irfft(power, size)[:lags])
