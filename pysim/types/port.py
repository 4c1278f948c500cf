"""One input or output of something that is wired to others."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Port:
    """One input or output.

    Args:
        name: unique among the inputs, or among the outputs.
        unit: SI, "1" or "%"; an FMU's own unit where a vendor wrote another.
        start: of an input, its value where nothing is connected; None where something has to be. Of an output, its
            value ahead of the first step; None is zero.
    """

    name: str
    unit: str = "1"
    start: float | None = None
