"""Detection of signals that are clipped at the limit of their sensor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.data_check.settings import LogCheckSettings

Array = NDArray[np.float64]

_SETTINGS = LogCheckSettings()


def plateaus(values: Array, low: float, high: float) -> tuple[tuple[int, int], ...]:
    """Samples (first, stop) of plateaus at either extreme value of a signal (n_t,).

    A plateau is a run of equal samples at `low` or `high` of a moving signal: the signal enters or leaves the run by
    more than a quantisation step, or is so noisy that other neighbours are hardly ever equal. A signal that settles at
    its largest value has no such plateau, and neither has the flat top of a slow, finely sampled sine.

    Args:
        low, high: the extreme values of this signal over all logs.
    """
    if low == high:
        return ()
    edges = np.flatnonzero(np.diff(values)) + 1
    starts, ends = np.concatenate([[0], edges]), np.concatenate([edges, [values.size]])
    lengths, levels = ends - starts, values[starts]
    steps = np.abs(np.diff(levels))
    if not steps.size:
        return ()
    extreme = (levels == low) | (levels == high)
    entered, left = np.concatenate([[0.0], steps]), np.concatenate([steps, [0.0]])
    cut = np.maximum(entered, left) > _SETTINGS.clipped_step * steps.min()
    flat = extreme & (lengths >= _SETTINGS.fewest_equal) & (cut | _lively(lengths, extreme))
    return tuple((int(first), int(stop)) for first, stop in zip(starts[flat], ends[flat], strict=True))


def _lively(lengths: NDArray[np.int64], extreme: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n_r,) whether the signal changes at nearly every sample near each run; a chirp is slow in other parts."""
    beside = _SETTINGS.runs_beside
    around = np.ones(2 * beside + 1)
    other = (~extreme).astype(np.float64)
    counts = np.convolve(other, around, "full")[beside : beside + lengths.size]
    total = np.convolve(other * lengths, around, "full")[beside : beside + lengths.size]
    return np.asarray((counts > 0) & (total < _SETTINGS.noisy_run * counts))
