"""A block of pysim.control as part of a system: its rate, its delay, how its outputs run between samples."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real

import numpy as np

from pysim.control import Block
from pysim.cosim._remains import Remains
from pysim.types import BadInput, Port


@dataclass(frozen=True)
class Sampled:
    """A block that is stepped at start + k * every and holds its outputs in between.

    Args:
        name: unique in its system, without a dot.
        block: has `inputs`, `outputs`, `step`, `state` and `restore`; each run starts from the state it has now.
        every: s between two samples, a whole number of communication steps.
        delay: s from a sample to its outputs, a whole number of communication steps; with zero they are set at the
            sample's own time, as by an ideal controller.
        hold: 0 keeps an output until the next sample; 1 lets it run on along the line through its last two values.
    Raises:
        BadInput: no block, times that are not positive, an unknown hold, a block made for another rate, or one whose
            state holds more than numbers.
    """

    name: str
    block: Block
    every: float
    delay: float = 0.0
    hold: int = 0
    initial: tuple[float, ...] = field(init=False, repr=False)
    remains: Remains = field(init=False, repr=False, compare=False, default_factory=Remains)

    def __post_init__(self) -> None:
        for attribute in ("inputs", "outputs", "step", "state", "restore"):
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
        object.__setattr__(self, "initial", numbers(self.name, self.block.state()))

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


def numbers(name: str, state: Sequence[float]) -> tuple[float, ...]:
    """A block's state, which has to stay as it is while the block goes on.

    Raises:
        BadInput: it holds an array, or whatever else could change in place.
    """
    kept = tuple(state)
    for value in kept:
        if not isinstance(value, (Real, np.bool_)):
            raise BadInput(
                f"{name}: its state holds {reprlib.repr(value)}, which is no number; return numbers alone, those of an "
                "array x as tuple(x)"
            )
    return kept
