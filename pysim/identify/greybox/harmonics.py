"""Mean and harmonics of a steady oscillation, from samples at any times; a periodic orbit at the same times."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def regressors(phase: Array, count: int) -> Array:
    """Columns 1, sin(phase), cos(phase), sin(2 phase), ... up to `count` harmonics, (n_t, 2 count + 1)."""
    order = np.arange(1, count + 1) * phase[:, None]
    columns = np.stack([np.sin(order), np.cos(order)], axis=2).reshape(phase.size, -1)
    return np.hstack([np.ones((phase.size, 1)), columns])


def interpolation(phase: Array, points: int) -> Array:
    """Weights (n_t, points) that give a periodic signal at phases (n_t,) rad from equidistant samples over one period.

    Exact for every harmonic below points / 2; higher ones are aliased.

    Source: Henrici 1979, Numerische Mathematik 33:225 (barycentric formula).
    """
    half, node = 0.5 * phase, np.pi * np.arange(points) / points
    sides = np.column_stack([np.sin(half), np.cos(half)])
    nearest = np.round(half * (points / np.pi))
    met = np.abs(np.sin(half - nearest * (np.pi / points))) <= 1e-12  # phases that coincide with a sample
    own = np.flatnonzero(met), (nearest[met] % points).astype(np.intp)
    sin = sides @ np.stack([np.cos(node), -np.sin(node)])
    sin[own] = 1.0
    weights = (1.0 - 2.0 * (np.arange(points) % 2)) / sin
    if points % 2 == 0:
        weights *= sides @ np.stack([np.sin(node), np.cos(node)])
    weights[met] = 0.0
    weights[own] = 1.0
    weights /= weights.sum(axis=1, keepdims=True)
    return np.asarray(weights)


def to_complex(coefficients: Array) -> NDArray[np.complex128]:
    """Coefficients (2 n + 1, ...) of `regressors` -> (n + 1, ...): mean, then a exp(j phi) for a sin(k phase + phi)."""
    swings = coefficients[1::2] + 1j * coefficients[2::2]
    return np.concatenate([coefficients[:1].astype(complex), swings])


def harmonic_count(frequency: float, rate: float, most: int) -> int:
    """Number of harmonics of `frequency` (Hz) below 0.45 of the sampling `rate` (Hz), from one to `most`."""
    return max(1, min(most, int(0.45 * rate / frequency)))
