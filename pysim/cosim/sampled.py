"""A block of pysim.control as part of a system: its rate, its delay, how its outputs run between samples."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real

from pysim.control import Block
from pysim.types import BadInput, Port


@dataclass(frozen=True)
class Sampled:
    """A block that is stepped at start + k * every and holds its outputs in between.

    Args:
        name: unique in its system, without a dot.
        block: has `inputs`, `outputs` and `step`. Each run steps a copy of it as it is by then.
        every: s between two samples, a whole number of communication steps.
        delay: s from a sample to its outputs, a whole number of communication steps; with zero they are set at the
            sample's own time, as by an ideal controller.
        hold: 0 keeps an output until the next sample; 1 lets it run on along the line through its last two values.
    Raises:
        BadInput: no block, times that are not positive, an unknown hold, or a block made for another rate.
    """

    name: str
    block: Block
    every: float
    delay: float = 0.0
    hold: int = 0

    def __post_init__(self) -> None:
        for attribute in ("inputs", "outputs", "step"):
            if not hasattr(self.block, attribute):
                raise BadInput(f"{self.name}: {self.block!r} has no {attribute!r}; see docs/tutorials/controller.md")
        for port in (*self.block.inputs, *self.block.outputs):
            if not isinstance(port, Port):
                raise BadInput(
                    f"{self.name}: its port {port!r} is no Port; write Port(name, unit) (docs/tutorials/controller.md)"
                )
        for name in ("every", "delay"):
            if not isinstance(getattr(self, name), Real):
                raise BadInput(f"{self.name}: {name} is {getattr(self, name)!r}; give seconds")
        if not 0 < self.every < math.inf or not 0 <= self.delay < math.inf:
            raise BadInput(f"{self.name}: every = {self.every} s, delay = {self.delay} s; give seconds above zero")
        if self.hold not in (0, 1):
            raise BadInput(f"{self.name}: hold is {self.hold!r}; give 0 or 1")
        own = getattr(self.block, "dt", None)
        if own is not None and not math.isclose(own, self.every, rel_tol=1e-9):
            raise BadInput(
                f"{self.name}: the block has dt = {own:g} s but is sampled every {self.every:g} s; make both one"
            )

    @property
    def inputs(self) -> tuple[Port, ...]:
        """The block's."""
        return self.block.inputs

    @property
    def outputs(self) -> tuple[Port, ...]:
        """The block's."""
        return self.block.outputs

    @property
    def feedthrough(self) -> Mapping[str, frozenset[str]]:
        """All outputs depend on all inputs at once; on none with a delay."""
        if self.delay > 0:
            return {}
        return {port.name: frozenset(p.name for p in self.inputs) for port in self.outputs}
