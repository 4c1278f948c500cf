"""Long signals on a screen: what can be seen of a window, and every sample once few enough are in it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def window(time: Array, begin: float, end: float) -> slice:
    """Samples from begin to end, s, with one more at either side so that lines reach the edge."""
    first, last = np.searchsorted(time, [begin, end], side="left")
    return slice(max(int(first) - 1, 0), min(int(last) + 2, time.size))


def decimated(time: Array, values: Array, most: int) -> tuple[Array, Array]:
    """At most so many points that look the same: per stretch the smallest and the largest sample, where they were.

    Args:
        time, values: (n,).
        most: of points, at least 4; where there are no more samples than that, all of them come back as they are.
    """
    if time.size <= most:
        return time, values
    stretches = max(most // 2 - 1, 1)
    edges = np.linspace(0, time.size, stretches + 1).astype(np.intp)
    low = np.array([a + int(np.argmin(values[a:b])) for a, b in pairwise(edges.tolist())])
    high = np.array([a + int(np.argmax(values[a:b])) for a, b in pairwise(edges.tolist())])
    kept = np.unique(np.concatenate([[0], low, high, [time.size - 1]]))
    return time[kept], values[kept]
