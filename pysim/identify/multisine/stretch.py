"""Which part of a logged command repeats itself."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Array = NDArray[np.float64]

# How far a command may be from itself one period ago: of its own range, and of the typical difference (its noise).
_OF_RANGE = 2e-3
_OF_TYPICAL = 8.0
# Mean square of that difference, of the command's variance, where it repeats itself; 2 where it does not.
_REPEATED = 0.3


def periodic_stretch(command: Array, size: int) -> slice:
    """The part of a command (n_t,) that repeats itself after `size` samples: without lead-in, hold and way back.

    Of several such parts it is the one with the most motion in it; a hold has none.

    Raises:
        BadInput: it repeats itself nowhere.
    """
    difference = np.abs(command[size:] - command[:-size])
    near = difference <= max(_OF_RANGE * float(np.ptp(command)), _OF_TYPICAL * float(np.median(difference)))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], near, [False]])))
    parts = [slice(first, last + size) for first, last in edges.reshape(-1, 2).tolist()]
    best = max(
        parts, key=lambda part: float(np.sum((command[part] - np.mean(command[part])) ** 2)), default=slice(0, 0)
    )
    apart = difference[best.start : best.stop - size]
    if apart.size < size or np.mean(apart**2) > _REPEATED * np.var(command[best]):
        raise BadInput(
            f"multisine: the command does not repeat itself over two periods of {size} samples; correct the period, or "
            "say where the periods start"
        )
    return best
