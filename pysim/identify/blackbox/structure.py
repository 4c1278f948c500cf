"""What kind of transfer function is wanted."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pysim.types import BadInput


@dataclass(frozen=True)
class Structure:
    """Numbers of poles and zeros, what of the dead time is known, and whether it has to be stable.

    Args:
        poles: of the rational part.
        zeros: finite ones; may exceed the poles (a controller that differentiates).
        dead_time: s; the known one, or the smallest where it is searched for.
        dead_time_max: s; the largest dead time to search for, None for a known one.
        stable: allow no pole on or right of the imaginary axis.
    Raises:
        BadInput: numbers that are negative, or a range of dead times that is empty.
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
        """How many numbers are estimated."""
        return self.poles + self.zeros + 1 + self.delayed

    @property
    def label(self) -> str:
        """Such as "5 poles, no zeros, dead time"."""
        words = [
            f"{n or 'no'} {noun}{'' if n == 1 else 's'}" for n, noun in ((self.poles, "pole"), (self.zeros, "zero"))
        ]
        if self.delayed:
            words.append("dead time")
        elif self.dead_time:
            words.append(f"dead time {self.dead_time:g} s")
        return ", ".join(words)
