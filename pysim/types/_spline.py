"""Cubic pieces through samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def hermite(times: Array, values: Array, rates: Array) -> Array:
    """Cubics that meet values and rates (n_t,) at both ends of each interval: (n_t - 1, 4), powers of t - times[k]."""
    h = np.diff(times)
    slope, first, last = np.diff(values) / h, rates[:-1], rates[1:]
    square, cube = (3 * slope - 2 * first - last) / h, (first + last - 2 * slope) / h**2
    return np.column_stack([values[:-1], first, square, cube])


def natural_rates(times: Array, values: Array) -> Array:
    """Rates (n_t,) that make the pieces meet in curvature as well, with none at both ends: the natural spline.

    Source: C. de Boor, A Practical Guide to Splines, chapter IV: a tridiagonal system, row k
        m[k-1] / h[k-1] + 2 m[k] (1 / h[k-1] + 1 / h[k]) + m[k+1] / h[k] = 3 (d[k-1] / h[k-1] + d[k] / h[k])
    with interval lengths h and slopes d. It is diagonally dominant, so elimination needs no row exchanges.
    """
    h = np.diff(times)
    beside, load = 1 / h, 3 * np.diff(values) / h**2
    diagonal = 2 * (np.append(beside, 0.0) + np.append(0.0, beside))
    rates = np.append(load, 0.0) + np.append(0.0, load)
    for k in range(h.size):
        factor = beside[k] / diagonal[k]
        diagonal[k + 1] -= factor * beside[k]
        rates[k + 1] -= factor * rates[k]
    rates[-1] /= diagonal[-1]
    for k in reversed(range(h.size)):
        rates[k] = (rates[k] - beside[k] * rates[k + 1]) / diagonal[k]
    return rates
