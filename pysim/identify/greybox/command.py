"""What drives the model in place of the bench: the log's own command, reached from rest."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pysim.types import BadInput, Signal


@dataclass(frozen=True)
class Rest:
    """How the model comes to rest at the first sample's input, as the bench did (thesis Section 2.1.1, step 1).

    Where the input begins at the model's own start value, a model that stands still there is held there as long: fitted
    parameters and effects may move its equilibrium, and the plant was at rest in its own.

    Args:
        ramp: s, from the input's start value to the first sample's.
        hold: s, at that value until the log starts; a few times the model's slowest time constant.
    Raises:
        BadInput: a duration that is not positive.
    """

    ramp: float = 0.5
    hold: float = 1.0

    def __post_init__(self) -> None:
        if not (0 < self.ramp < math.inf and 0 < self.hold < math.inf):
            raise BadInput(f"rest: ramp and hold must be positive times in s, got {self.ramp} and {self.hold}")


def from_rest(signal: Signal, start: float, first: float, rest: Rest) -> tuple[Signal, float]:
    """The command with its way from rest ahead of it.

    Args:
        signal: the command from `start` (s) on.
        first: the input's start value, at which the model starts; in the signal's unit.
        rest: skipped where the command starts at `first`, where the model starts.
    Returns:
        the whole command, and when its run has to start, s.
    """
    tail = _cut(signal, start)
    value = float(signal.value(np.array(start)))
    if value == first:
        return tail, start
    begin = start - rest.hold - rest.ramp
    starts = np.concatenate([[begin, start - rest.hold], tail.starts])
    cubics = np.vstack([[first, (value - first) / rest.ramp, 0.0, 0.0], [value, 0.0, 0.0, 0.0], tail.cubics])
    sines = np.concatenate([np.zeros((2, *tail.sines.shape[1:])), tail.sines])
    return Signal(starts, cubics, sines), begin


def _cut(signal: Signal, start: float) -> Signal:
    """The same signal from `start` on, without what was before."""
    k = max(int(np.searchsorted(signal.starts, start, side="right")) - 1, 0)
    s = start - signal.starts[k]
    if s <= 0:
        return signal
    c0, c1, c2, c3 = signal.cubics[k]
    cubics, sines, starts = signal.cubics[k:].copy(), signal.sines[k:].copy(), signal.starts[k:].copy()
    starts[0] = start
    cubics[0] = c0 + s * (c1 + s * (c2 + s * c3)), c1 + s * (2 * c2 + 3 * s * c3), c2 + 3 * s * c3, c3
    omega, kappa = sines[0, :, 2].copy(), sines[0, :, 3]
    sines[0, :, 1] += s * (omega + 0.5 * kappa * s)
    sines[0, :, 2] += kappa * s
    return Signal(starts, cubics, sines)
