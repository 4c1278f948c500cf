"""Many small complex least-squares problems at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Complex = NDArray[np.complex128]
Index = NDArray[np.intp]

_CONDITION = 1e-10


@dataclass(frozen=True)
class LocalFit:
    """Solutions of n problems with w equations, p unknowns and n_y right-hand sides each.

    coefficients (n, p, n_y); gram (n, p, p), the inverse of K^H K; residual (n, n_y, n_y), the covariance of the
    right-hand sides' errors; degrees, w - p, in complex numbers.
    """

    coefficients: Complex
    gram: Complex
    residual: Complex
    degrees: int


def local_fit(regressors: Complex, responses: Complex) -> LocalFit:
    """Least squares by a batched QR decomposition.

    Args:
        regressors: (n, w, p), w > p.
        responses: (n, w, n_y).
    Raises:
        BadInput: too few equations, or linearly dependent unknowns.
    """
    _, w, p = regressors.shape
    if w <= p:
        raise BadInput(f"local polynomial: {w} lines do not leave anything over for {p} coefficients; widen the window")
    scale = np.sqrt(np.sum(np.abs(regressors) ** 2, axis=1))
    if np.any(scale == 0):
        raise BadInput("local polynomial: no excitation in a window; narrow the band to what is excited")
    q, r = np.linalg.qr(regressors / scale[:, None, :])
    diagonal = np.abs(np.diagonal(r, axis1=1, axis2=2))
    if np.any(diagonal.min(axis=1) < _CONDITION):
        raise BadInput(
            "local polynomial: gain and transient cannot be separated in a window; excite more lines or widen it"
        )
    adjoint = np.conj(np.swapaxes(q, 1, 2))
    projected = adjoint @ responses
    inverse = np.linalg.inv(r) / scale[:, :, None]
    left = responses - q @ projected
    residual = np.swapaxes(left, 1, 2) @ np.conj(left) / (w - p)
    return LocalFit(inverse @ projected, inverse @ np.conj(np.swapaxes(inverse, 1, 2)), residual, w - p)


def windows(centres: Index, available: Index, width: int) -> Index:
    """Indices (n, width) in `available` (increasing) of the lines nearest to each centre; asymmetric at the ends.

    Raises:
        BadInput: fewer lines than the window's width.
    """
    if available.size < width:
        raise BadInput(f"local polynomial: a window of {width} lines does not fit into {available.size}; narrow it")
    left = np.searchsorted(available, centres, side="left")
    right = np.searchsorted(available, centres, side="right")
    first = np.clip((left + right - width + 1) // 2, 0, available.size - width)
    return np.asarray(first[:, None] + np.arange(width), dtype=np.intp)


def apart(at: Index, centres: Index) -> tuple[int, ...]:
    """Indices, in increasing order, of windows that share no line; of equal windows, the one with the best centre.

    Args:
        at, centres: (n, width) and (n,), as returned by and passed to `windows`.
    """
    off, places, last = np.abs(2 * centres - at[:, 0] - at[:, -1]), [], -1
    for k in np.lexsort((off, at[:, 0])).tolist():
        if at[k, 0] > last:
            places.append(k)
            last = at[k, -1]
    return tuple(places)


def powers(distance: NDArray[np.float64], order: int) -> Complex:
    """(n, w, order + 1) of 1, x, x^2, ..., with x (n, w) scaled to the window's half width."""
    x = distance / np.max(np.abs(distance), axis=1, keepdims=True)
    return np.asarray(x[..., None] ** np.arange(order + 1), dtype=np.complex128)
