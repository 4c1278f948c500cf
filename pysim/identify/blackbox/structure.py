"""Structure of a transfer function: numbers of poles and zeros, dead time, stability."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pysim.types import BadInput


@dataclass(frozen=True)
class Structure:
    """Structure of a transfer function.

    Args:
        poles: number of poles of the rational part.
        zeros: number of finite zeros; may exceed that of poles (a controller with derivative action).
        dead_time: s; the known dead time, or the smallest one if it is estimated.
        dead_time_max: s; the largest dead time if it is estimated; None if it is known.
        stable: allow no pole on or right of the imaginary axis.
    Raises:
        BadInput: negative numbers, or an empty range of dead times.
    """

    poles: int
    zeros: int = 0
    dead_time: float = 0.0
    dead_time_max: float | None = None
    stable: bool = False

    def __post_init__(self) -> None:
        if self.poles < 0 or self.zeros < 0:
            raise BadInput(f"structure: {self.poles} poles and {self.zeros} zeros; both must be zero or more")
        if not (self.dead_time >= 0 and math.isfinite(self.dead_time)):
            raise BadInput(f"structure: the dead time must be zero or positive seconds, got {self.dead_time}")
        top = self.dead_time_max
        if top is not None and not (top > self.dead_time and math.isfinite(top)):
            raise BadInput(f"structure: dead times from {self.dead_time:g} to {top:g} s are none; raise dead_time_max")

    @property
    def delayed(self) -> bool:
        """Whether the dead time is estimated."""
        return self.dead_time_max is not None

    @property
    def parameters(self) -> int:
        """Number of estimated parameters."""
        return self.poles + self.zeros + 1 + self.delayed

    @property
    def label(self) -> str:
        """In words, such as "5 poles, no zeros, dead time"."""
        words = [
            f"{n or 'no'} {noun}{'' if n == 1 else 's'}" for n, noun in ((self.poles, "pole"), (self.zeros, "zero"))
        ]
        if self.delayed:
            words.append("dead time")
        elif self.dead_time:
            words.append(f"dead time {self.dead_time:g} s")
        return ", ".join(words)
