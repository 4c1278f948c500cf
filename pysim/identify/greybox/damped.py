"""One damped step of least squares within bounds: what every search for squares repeats."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

Array = NDArray[np.float64]


def damped_step(triangle: Array, right: Array, damping: float, low: Array, high: Array) -> Array:
    """The p (n,) within low ... high with the least |right - triangle p|^2 + damping |p|^2.

    Args:
        triangle: (n, n); right: (n,).
        low, high: (n,), each low below its high.
    Source: Nocedal and Wright 2006, Numerical Optimization, Section 10.3.
    """
    n = right.size
    matrix = np.vstack([triangle, math.sqrt(damping) * np.eye(n)])
    longer = np.concatenate([right, np.zeros(n)])
    free = np.linalg.lstsq(matrix, longer, rcond=None)[0]
    if np.all(free >= low) and np.all(free <= high):
        return np.asarray(free)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = lsq_linear(matrix, longer, (low, high), method="bvls", tol=1e-14).x
    if not np.all(np.isfinite(found)):  # where it steps on a bound that a rounding has put it beyond
        found = lsq_linear(matrix, longer, (low, high), method="trf", tol=1e-14).x
    return np.asarray(found)
