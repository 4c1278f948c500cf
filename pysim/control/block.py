"""What a controller is to a co-simulation: named inputs and outputs, a step, and a state that can be kept."""

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

    def state(self) -> tuple[float, ...]:
        """All that the next step depends on beside its inputs."""
        ...

    def restore(self, state: Sequence[float]) -> None:
        """Go on from a state that was kept."""
        ...


class Stateless:
    """State of a block that remembers nothing."""

    def state(self) -> tuple[float, ...]:
        """Nothing."""
        return ()

    def restore(self, state: Sequence[float]) -> None:
        """Nothing to go on from."""
