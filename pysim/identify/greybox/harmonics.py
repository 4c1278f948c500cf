"""A steady swing as mean and harmonics: of samples at any times, and of a periodic orbit at the same times."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def regressors(phase: Array, count: int) -> Array:
    """Columns 1, sin(phase), cos(phase), sin(2 phase), ... up to `count` harmonics, (n_t, 2 count + 1)."""
    powers = np.repeat(np.exp(1j * phase)[:, None], count, axis=1).cumprod(axis=1)
    columns = np.ones((phase.size, 2 * count + 1))
    columns[:, 1::2], columns[:, 2::2] = powers.imag, powers.real
    return columns


@cache
def analysis(points: int) -> Array:
    """From equidistant samples of a period to the coefficients of their harmonics, (2 (points // 2) + 1, points)."""
    columns = regressors(2 * np.pi * np.arange(points) / points, points // 2)
    if points % 2 == 0:
        columns[:, -2] = 0.0  # of the highest harmonic the samples show the cosine alone
    found = np.asarray(columns.T / np.maximum(np.sum(columns**2, axis=0), 1.0)[:, None])
    found.setflags(write=False)
    return found


def interpolation(phase: Array, points: int) -> Array:
    """Weights (n_t, points) that give a periodic signal at phases (n_t,) rad from equidistant samples over one period.

    Exact for every harmonic below points / 2; what lies above is folded down as sampling does.
    """
    return np.asarray(regressors(phase, points // 2) @ analysis(points))


def to_complex(coefficients: Array) -> NDArray[np.complex128]:
    """(2 n + 1, ...) of `regressors` -> (n + 1, ...): the mean, then a exp(j phi) of a sin(k phase + phi)."""
    swings = coefficients[1::2] + 1j * coefficients[2::2]
    return np.concatenate([coefficients[:1].astype(complex), swings])


def harmonic_count(frequency: float, rate: float, most: int) -> int:
    """How many harmonics of `frequency` (Hz) samples at `rate` (Hz) tell apart, at least one and `most` at most."""
    return max(1, min(most, int(0.45 * rate / frequency)))
