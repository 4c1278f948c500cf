"""What can take part in a co-simulation: named ports, a step over a stretch of time, a state that can be kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.types import Outcome, Port

Array = NDArray[np.float64]


class MemberFailed(RuntimeError):
    """A member could not go on. Its text says why, in the member's own words; the master adds the name and the time.

    Args:
        outcome: MODEL_ERROR, or TERMINATED where the member ended the run as it was meant to.
    """

    def __init__(self, message: str, outcome: Outcome = Outcome.MODEL_ERROR) -> None:
        super().__init__(message)
        self.outcome = outcome


@dataclass(frozen=True)
class Setup:
    """What a member is given ahead of a run. It keeps the three arrays: all values go through them, in port order.

    Args:
        time: s, where the run starts.
        stop: s, where it ends.
        step: s, the usual distance of two communication points.
        inputs: (n_in,) written by the master, read by the member.
        rates: (n_in,) the inputs' rates per s over the step to come, for members that take rates; zero otherwise.
        outputs: (n_out,) written by the member, read by the master.
        overrides: parameter or start value -> number, in its unit.
    """

    time: float
    stop: float
    step: float
    inputs: Array
    rates: Array
    outputs: Array
    overrides: Mapping[str, float] = field(default_factory=dict)


class Member(Protocol):
    """A part that moves on by itself between two communication points. There is nothing to inherit.

    The calls of a run: `start`, `update` as often as the initial values ask for, `begin`, then `step` and `update` in
    any number, `save` and `restore` between them, `close` at last, after a failure too. A closed member can be started
    anew, and then is as if it had never run. Every call may raise `MemberFailed`.
    """

    @property
    def name(self) -> str:
        """Unique in its system, without a dot."""
        ...

    @property
    def inputs(self) -> tuple[Port, ...]:
        """What it reads."""
        ...

    @property
    def outputs(self) -> tuple[Port, ...]:
        """What it sets."""
        ...

    @property
    def feedthrough(self) -> Mapping[str, frozenset[str]]:
        """Output -> the inputs it depends on at once; an output that is left out depends on none."""
        ...

    @property
    def can_rollback(self) -> bool:
        """Whether `save` and `restore` work."""
        ...

    @property
    def can_vary_step(self) -> bool:
        """Whether steps may differ in size."""
        ...

    @property
    def takes_rates(self) -> bool:
        """Whether an input may run as a straight line within a step: inputs + rates * (time since its start)."""
        ...

    @property
    def may_return_early(self) -> bool:
        """Whether a step may end before its end, at an event."""
        ...

    @property
    def event(self) -> bool:
        """Whether the step that just ended left an event, for the next `update` to handle. Read after every step."""
        ...

    def start(self, setup: Setup) -> None:
        """Set parameters and start values, enter initialisation, read the inputs, write the outputs.

        Raises:
            BadInput: an override it does not have.
        """
        ...

    def begin(self) -> None:
        """The initial values are settled: leave initialisation and write the outputs. Steps may follow."""
        ...

    def update(self) -> None:
        """Read the inputs and write the outputs with no time passing; handle an event that a step has left."""
        ...

    def step(self, time: float, end: float) -> float:
        """Read inputs and rates, go on from `time` to `end` (s), write the outputs: those of the inputs' last values.

        Communication points are start + n * step, rounded once: `end - time` is exact, and differs from the usual
        step by rounding only.

        Returns:
            `end` itself, or the earlier time that was reached.
        """
        ...

    def save(self, into: Any = None) -> Any:
        """All that the next step depends on beside inputs and rates.

        Args:
            into: a state that was saved before and is no longer needed; its memory may be used again.
        """
        ...

    def restore(self, state: Any) -> None:
        """Go on from a state that was saved in this run; it stays good for another time. Outputs are not written."""
        ...

    def close(self) -> None:
        """Free all that `start` took. May be called twice, or without a start."""
        ...
