"""What an order of stepping is: who steps when, with which inputs."""

from __future__ import annotations

from typing import Any, Protocol

from pysim.cosim._core import Core


class Stepper(Protocol):
    """An order at work in one run."""

    lines: bool  # whether inputs run as lines, so that outputs may have to be brought to the inputs' last values
    memory: Any  # what the next step depends on beside the row and the members; a value, never changed in place

    def advance(self, time: float, end: float, tick: int | None) -> float:
        """Step all members from `time` towards `end` (s); the row is consistent at `time`.

        Args:
            tick: number of the communication point at `end`; None if it is none.
        Returns:
            the time that was reached: `end`, or that of an event before it.
        Raises:
            Fault: a member could not go on.
        """
        ...


class Order(Protocol):
    """Frozen settings of one way to step. A new one is a file, an export, and a line in its tests' order_cases.py."""

    @property
    def accuracy(self) -> int:
        """The order of convergence of the coupling, for smooth systems."""
        ...

    @property
    def solves_loops(self) -> bool:
        """Whether algebraic loops are solved; else they are refused."""
        ...

    def stepper(self, core: Core) -> Stepper:
        """Start to work.

        Raises:
            BadInput: a system that cannot be stepped so.
        """
        ...
