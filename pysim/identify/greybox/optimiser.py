"""What an optimiser is: it proposes a point, receives what came of it, and keeps its state as a value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.residuals import Point
from pysim.types import FitOutcome
from pysim.types._frozen import FrozenMapping

Array = NDArray[np.float64]


class Bounds(NamedTuple):
    """Of the search's numbers, (n,) each; infinite where there are none."""

    lower: Array
    upper: Array


class Proposal(NamedTuple):
    """A point to try, by how much the optimiser's own measure is expected to fall there, and what goes along.

    `damping` of the steps of what is estimated beside the parameters, as initial states; infinite if these wait.
    """

    x: Array
    predicted: float
    damping: float = 0.0


@dataclass(frozen=True)
class State:
    """Where a search stands.

    Args:
        best: the point it stands on.
        first_cost: the cost at the start; infinite where the model could not be simulated there.
        tried: points tried so far, the start not counted.
        memory: what the optimiser has learned, as numbers.
        outcome: how it ended; None while it runs.
        message: the same in words with numbers.
    """

    best: Point
    tried: int = 0
    first_cost: float = math.inf
    memory: Mapping[str, float] = field(default_factory=dict)
    outcome: FitOutcome | None = None
    message: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "memory", FrozenMapping(self.memory))


class Optimiser(Protocol):
    """Frozen settings of one way to search."""

    @property
    def name(self) -> str:
        """As on the command line."""
        ...

    @property
    def smooth_only(self) -> bool:
        """Whether it needs a sum of squares."""
        ...

    def rough(self) -> Optimiser | None:
        """The same for a first search over rough simulations; None where a second search cannot go on from its end."""
        ...

    def finer(self, end: State) -> Optimiser:
        """The same for a search that goes on from the end of a rough one."""
        ...

    def first(self, x: Array, bounds: Bounds) -> Array:
        """The start (n,), moved where the method cannot start from it."""
        ...

    def begin(self, start: Point, bounds: Bounds, squares: bool) -> State:
        """The state at a start that could be simulated."""
        ...

    def propose(self, state: State, bounds: Bounds) -> Proposal:
        """The next point to try; never asked once there is an outcome."""
        ...

    def tell(self, state: State, proposal: Proposal, trial: Point, bounds: Bounds) -> State:
        """The state after that point; a bad point is a step that is not taken."""
        ...
