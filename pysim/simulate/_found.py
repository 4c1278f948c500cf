"""What the kernel found, and how a run ended in words."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._library import failure
from pysim.simulate._messages import joined, line_texts
from pysim.simulate._tasks import Tasks
from pysim.simulate.kernel.layout import DISCARD, DONE, ERROR, EVENT, FATAL, FOUND, RUNNING, STATISTICS
from pysim.types import Outcome

Array = NDArray[np.float64]

OUTCOMES = {RUNNING: Outcome.STOPPED, EVENT: Outcome.DONE, **dict(enumerate(Outcome))}  # by the kernel's codes
_STATUS = {DISCARD: "the model discards the point", ERROR: "an FMI function failed", FATAL: "a fatal FMI error"}
_TROUBLE = ("", "stopped", "an event happened", "", "the corrections do not converge", "")
_DRIFT = "a state drifts from period to period, and nothing holds it"


class Found:
    """What came of a request."""

    def __init__(self, tasks: Tasks, number: int) -> None:
        self.tasks, self.number = tasks, number

    def number_of(self, name: str) -> Any:
        """A number of the task, by the name of its field."""
        return self.tasks.column(name)[self.number]

    @property
    def outcome(self) -> Outcome:
        """How the run ended; DONE also at an event that is not differentiated."""
        return OUTCOMES[self.number_of("code")]

    @property
    def event(self) -> bool:
        """Whether the run ended at an event, or the search for an orbit met one."""
        return self.number_of("code") == EVENT

    @property
    def failed_to_start(self) -> bool:
        """Whether the FMU refused ahead of the run."""
        return bool(self.number_of("part"))

    @property
    def done(self) -> bool:
        """Whether the run came to its end, or the orbit was found."""
        return self.number_of("code") == DONE and self.number_of("trouble") == FOUND

    @property
    def message(self) -> str:
        """How the run ended, where, and what the FMU said; empty where it came to its end."""
        if self.failed_to_start:
            return failure(self.number_of("part")) + self._said()
        if self.outcome is Outcome.DONE:
            return ""
        return explain(self.outcome, self.number_of("reached"), self.number_of("status")) + self._said()

    @property
    def trouble(self) -> str:
        """Why there is no orbit; empty if there is one."""
        number = self.number_of("trouble")
        return "" if number == FOUND else _TROUBLE[number] or self.message or _DRIFT

    def _said(self) -> str:
        return joined(line_texts(self.tasks.texts[self.number]))

    def array(self, name: str) -> Array:
        """An array of the request's own, by the name of the field."""
        return self.tasks.array(name, self.number)

    @property
    def values(self) -> Array:
        """(n_t, n_y) what was recorded, as far as the run came."""
        return self.tasks.rows("values", self.number)

    @property
    def slopes(self) -> Array:
        """(n_t, n_y, n_p) derivatives of that by the parameters of the directions."""
        return self.tasks.rows("slopes", self.number)[:, :, self.tasks.by_offset :]

    @property
    def by_offset(self) -> Array:
        """(n_t, n_y, n_x) the same by the offset of the states; n_x = 0 where it is no direction."""
        return self.tasks.rows("slopes", self.number)[:, :, : self.tasks.by_offset]

    def statistics(self) -> dict[str, int]:
        """Counts of the run, or of the last period."""
        return {name: self.number_of(name) for name in STATISTICS}


def explain(outcome: Outcome, reached: float, status: int) -> str:
    """How a run ended, where (s), and what the FMU returned there."""
    said = _STATUS.get(status)
    return f"{outcome.value} at {reached:g} s" + (f" ({said})" if said else "")
