"""A steady swing as mean and harmonics: of samples at any times, and of a periodic orbit at the same times."""

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

    Exact for every harmonic below points / 2; what lies above is folded down as sampling does.
    """
    nodes = 2 * np.pi * np.arange(points) / points
    distance = phase[:, None] - nodes
    half = 0.5 * (distance - 2 * np.pi * np.round(distance / (2 * np.pi)))
    away = np.abs(half) > 1e-12
    half = np.where(away, half, 1.0)
    # the sum of 1 + 2 cos(k distance) in closed form; for an even count the last cosine counts once
    kernel = np.sin(points * half) / (points * (np.sin(half) if points % 2 else np.tan(half)))
    return np.where(away, kernel, 1.0)


def to_complex(coefficients: Array) -> NDArray[np.complex128]:
    """(2 n + 1, ...) of `regressors` -> (n + 1, ...): the mean, then a exp(j phi) of a sin(k phase + phi)."""
    swings = coefficients[1::2] + 1j * coefficients[2::2]
    return np.concatenate([coefficients[:1].astype(complex), swings])


def harmonic_count(frequency: float, rate: float, most: int) -> int:
    """How many harmonics of `frequency` (Hz) samples at `rate` (Hz) tell apart, at least one and `most` at most."""
    return max(1, min(most, int(0.45 * rate / frequency)))
