"""Least squares with nearly orthogonal columns, such as sines over whole periods."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def near_orthogonal_fit(matrix: Array, values: Array) -> Array:
    """Coefficients (n_c,) of columns (n, n_c) for values (n,), by the normal equations (thesis Eq. 2.7), refined once.

    The normal equations take a tenth of the time of an orthogonal factorisation, but square the condition number. So
    the columns must not be nearly dependent. One step of iterative refinement removes rounding errors.
    """
    square = matrix.T @ matrix
    first = np.linalg.solve(square, matrix.T @ values)
    return np.asarray(first + np.linalg.solve(square, matrix.T @ (values - matrix @ first)))
