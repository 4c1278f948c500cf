"""What a controller is to a co-simulation: named inputs and outputs, and a step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from pysim.types import Port


class Block(Protocol):
    """A sampled block. Whatever has these attributes is one; there is nothing to inherit."""

    @property
    def inputs(self) -> tuple[Port, ...]:
        """What it reads."""
        ...

    @property
    def outputs(self) -> tuple[Port, ...]:
        """What it sets."""
        ...

    def step(self, time: float, inputs: Sequence[float]) -> Sequence[float]:
        """One sample.

        Args:
            time: s.
            inputs: in the order of `inputs`, in their units.
        Returns:
            values in the order of `outputs`, held until the next sample.
        """
        ...
