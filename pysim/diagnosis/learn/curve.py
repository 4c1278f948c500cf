"""The curve of a learned law: straight between its knots but for rounded corners, constant beyond the ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ROUND = 0.25  # width of a corner over the shorter interval beside it


def widths(knots: Array) -> Array:
    """Width of each corner, (m,), from the knots (m,)."""
    steps = np.diff(knots)
    return np.asarray(ROUND * np.minimum(np.append(steps, np.inf), np.append(np.inf, steps)))


def curve_basis(z: Array, knots: Array) -> Array:
    """What each coefficient does: the curve at z (n,) is `curve_basis(z, knots) @ coefficients`, (n, m).

    Each interval adds its slope times what the rounded ramps from its two ends differ by, so that the rows sum to 1.
    """
    away = np.asarray(z)[:, None] - knots
    ramps = 0.5 * (away + np.sqrt(away**2 + widths(knots) ** 2))
    rises = (ramps[:, :-1] - ramps[:, 1:]) / np.diff(knots)  # 0 below an interval, 1 above it
    whole = np.ones((len(away), 1))
    steps = np.hstack([whole, rises, 0 * whole])
    return np.asarray(steps[:, :-1] - steps[:, 1:])
