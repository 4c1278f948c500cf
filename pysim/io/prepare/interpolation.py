"""Samples at other times."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_POINTS = 8  # that a value between samples is made of


def at_times(time: Array, values: Array, wanted: Array, *, held: bool = False) -> Array:
    """Values (n_w,) at the wanted times, through the eight samples around each by Lagrange's polynomial.

    A sine of ten samples a period is met to 3e-5 of its amplitude. Beyond the ends the last sample stands.

    Args:
        time: (n_t,) s, increasing, even or not.
        values: (n_t,).
        wanted: (n_w,) s.
        held: the last sample ahead counts, as of a command that stands between its samples.
    """
    wanted = np.clip(wanted, time[0], time[-1])
    if held:
        return np.asarray(values[np.searchsorted(time, wanted + 1e-9 * (time[-1] - time[0]) / time.size, "right") - 1])
    count = min(_POINTS, time.size)
    first = np.clip(np.searchsorted(time, wanted, "right") - count // 2, 0, time.size - count)
    nodes = first[:, None] + np.arange(count)
    away = wanted[:, None] - time[nodes]
    result = np.zeros(wanted.size)
    for k in range(count):
        weight = np.ones(wanted.size)
        for j in range(count):
            if j != k:
                weight *= away[:, j] / (time[nodes[:, k]] - time[nodes[:, j]])
        result += weight * values[nodes[:, k]]
    return result
