"""Signals that stand at the limit of their sensor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LEAST = 4  # samples in a row at the very same extreme value
_JUMP = 1.5  # quantisation steps: a signal that comes to rest arrives by single ones


def clipped(values: Array, low: float, high: float) -> int:
    """How many samples (n_t,) stand on plateaus at either extreme value of the signal.

    A plateau is a run of equal samples at `low` or `high` that is cut out of a signal on the move: it is entered or
    left by more than a quantisation step, or the noise beside it lets hardly two neighbours be equal. A signal that
    settles at its largest value has no such plateau, and neither has the flat top of a slow, finely sampled sine.

    Args:
        low, high: the extreme values of this signal over all logs.
    """
    if low == high:
        return 0
    edges = np.flatnonzero(np.diff(values)) + 1
    starts, ends = np.concatenate([[0], edges]), np.concatenate([edges, [values.size]])
    lengths, levels = ends - starts, values[starts]
    steps = np.abs(np.diff(levels))
    if not steps.size:
        return 0
    extreme = (levels == low) | (levels == high)
    others = lengths[~extreme]
    lively = others.size > 0 and others.mean() < 1.5  # noise moves nearly every sample
    entered, left = np.concatenate([[0.0], steps]), np.concatenate([steps, [0.0]])
    cut = np.maximum(entered, left) > _JUMP * steps.min()
    return int(lengths[extreme & (lengths >= _LEAST) & (cut | lively)].sum())
