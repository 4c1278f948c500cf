"""What every test signal offers."""

from __future__ import annotations

from typing import Protocol

from pysim.types import Signal


class Excitation(Protocol):
    """A test signal: settings, and the command that follows from them. Times count from the start of the test."""

    @property
    def onset(self) -> float:
        """When the excitation proper begins, s; before it the command is led to its offset."""
        ...

    @property
    def end(self) -> float:
        """When it stops, s; afterwards the command is led back to zero."""
        ...

    @property
    def duration(self) -> float:
        """Of the whole test, s; the last value holds from there on."""
        ...

    @property
    def highest_hz(self) -> float:
        """Of its fastest sine, Hz; zero where it has none. Logging has to be faster than twice that."""
        ...

    def signal(self) -> Signal:
        """The command from time zero on, with its exact derivative."""
        ...
