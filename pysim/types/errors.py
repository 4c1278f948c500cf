"""What can go wrong, as types: the user's mistake, and a run that did not reach its end."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types.record import Record


class BadInput(ValueError):
    """The caller asked for something that cannot be: one sentence with what, where and the cure."""


class SimulationError(RuntimeError):
    """A run stopped early. `record` holds the part that was reached."""

    def __init__(self, message: str, record: Record) -> None:
        super().__init__(message)
        self.record = record
