"""Where a shaft stands still."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def standstills(time: Array, speed: Array, *, below: float = 0.5, least: float = 0.05) -> Array:
    """Spans in which a speed stays near zero.

    Args:
        time: (n_t,) s.
        speed: (n_t,) rad/s.
        below: rad/s, the speed's size that counts as none.
        least: s; shorter spans are left out.
    Returns:
        (n, 2): begin and end of each, s.
    """
    still = np.concatenate([[False], np.abs(speed) < below, [False]])
    begins, ends = np.flatnonzero(still[1:] & ~still[:-1]), np.flatnonzero(~still[1:] & still[:-1])
    spans = np.column_stack([time[begins], time[ends - 1]])
    return np.asarray(spans[spans[:, 1] - spans[:, 0] >= least], dtype=np.float64)
