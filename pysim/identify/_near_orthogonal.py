"""Least squares of columns that are nearly orthogonal, as sines over whole periods are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def near_orthogonal_fit(matrix: Array, values: Array) -> Array:
    """Coefficients (n_c,) of columns (n, n_c) for values (n,), by the normal equations (thesis Eq. 2.7), refined once.

    The normal equations square the condition number; where that is small they cost a tenth of an orthogonal
    factorisation, and the refinement takes off their rounding. Columns must not be nearly dependent.
    """
    square = matrix.T @ matrix
    first = np.linalg.solve(square, matrix.T @ values)
    return np.asarray(first + np.linalg.solve(square, matrix.T @ (values - matrix @ first)))
