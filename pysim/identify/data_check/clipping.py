"""Signals that stand at the limit of their sensor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LEAST = 4  # samples in a row at the very same extreme value
_BESIDE = 6  # runs to either side that tell how lively a signal is
_EACH = 1.5  # samples: shorter runs, in the mean, are those of a noisy signal
_JUMP = 1.5  # quantisation steps: a signal that comes to rest arrives by single ones


def clipped(values: Array, low: float, high: float) -> int:
    """How many samples (n_t,) stand on plateaus at either extreme value of the signal, see `plateaus`."""
    return sum(stop - first for first, stop in plateaus(values, low, high))


def plateaus(values: Array, low: float, high: float) -> tuple[tuple[int, int], ...]:
    """Samples (first, stop) of plateaus at either extreme value of the signal.

    A plateau is a run of equal samples at `low` or `high` that is cut out of a signal on the move: it is entered or
    left by more than a quantisation step, or the noise beside it lets hardly two neighbours be equal. A signal that
    settles at its largest value has no such plateau, and neither has the flat top of a slow, finely sampled sine.

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
    cut = np.maximum(entered, left) > _JUMP * steps.min()
    flat = extreme & (lengths >= _LEAST) & (cut | _lively(lengths, extreme))
    return tuple((int(first), int(stop)) for first, stop in zip(starts[flat], ends[flat], strict=True))


def _lively(lengths: NDArray[np.int64], extreme: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n_r,) whether noise moves nearly every sample around a run: a chirp is slow here and fast there."""
    around = np.ones(2 * _BESIDE + 1)
    other = (~extreme).astype(np.float64)
    counts = np.convolve(other, around, "full")[_BESIDE : _BESIDE + lengths.size]
    total = np.convolve(other * lengths, around, "full")[_BESIDE : _BESIDE + lengths.size]
    return np.asarray((counts > 0) & (total < _EACH * counts))
