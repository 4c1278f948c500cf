"""What was recorded, by a simulation or on a bench."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from pysim.types._frozen import FrozenMapping, frozen_array
from pysim.types.errors import BadInput

Array = NDArray[np.float64]


class Outcome(Enum):
    """How a run ended."""

    DONE = "done"
    STEP_TOO_SMALL = "the step size fell below its limit"
    NOT_FINITE = "a value is no longer finite"
    MODEL_ERROR = "the model reported an error"
    TERMINATED = "the model ended the run"
    TOO_MANY_STEPS = "the limit of steps was reached"
    TOO_MANY_EVENTS = "events follow each other without time passing"
    NOT_CONVERGED = "an iteration between members came to no end"
    NOT_PERIODIC = "no periodic steady state was found"
    STOPPED = "the run was asked to stop"


@dataclass(frozen=True)
class Record:
    """Signals over time.

    Args:
        time: (n_t,) s, increasing.
        values: (n_t, n_y), a column per name, in the unit of the same place.
        names: (n_y) names of the columns.
        units: (n_y) units, "1" where there is none.
        outcome: DONE, or why the run stopped; a stopped run's record ends where it stopped.
        message: what the model or the solver said of it.
        origin: "simulated" or "measured", and of what.
        statistics: counts of the run: steps, rejected, derivatives, jacobians, events.
    Raises:
        BadInput: shapes that do not match, or times that do not increase.
    """

    time: Array = field(repr=False)
    values: Array = field(repr=False)
    names: tuple[str, ...]
    units: tuple[str, ...]
    outcome: Outcome = Outcome.DONE
    message: str = ""
    origin: str = ""
    statistics: Mapping[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("time", "values"):
            object.__setattr__(self, name, _read_only(name, getattr(self, name)))
        for name in ("names", "units"):
            if isinstance(getattr(self, name), str):
                raise BadInput(f"record: {name} is the text {getattr(self, name)!r}; write a tuple of texts")
            object.__setattr__(self, name, tuple(getattr(self, name)))
        object.__setattr__(self, "statistics", FrozenMapping(self.statistics))
        n_t, n_y = self.time.size, len(self.names)
        if self.time.shape != (n_t,) or self.values.shape != (n_t, n_y):
            raise BadInput(
                f"record: {n_t} times and {n_y} names need values of shape ({n_t}, {n_y}), got {self.values.shape}"
            )
        if len(self.units) != n_y:
            raise BadInput(f"record: {n_y} names need {n_y} units, got {len(self.units)}")
        if n_t > 0 and not (np.isfinite(self.time[[0, -1]]).all() and (self.time[1:] > self.time[:-1]).all()):
            raise BadInput("record: times must be finite and increase")

    def __getitem__(self, name: str) -> Array:
        """The column of that name, (n_t,)."""
        if name not in self.names:
            raise BadInput(f"record has no signal {name!r}; it has {', '.join(self.names)}")
        return self.values[:, self.names.index(name)]

    def whole_rows(self, names: Sequence[str] | None = None) -> Record:
        """The rows in which no cell is empty; None: of no column."""
        places = slice(None) if names is None else [self.names.index(name) for name in names]
        whole = np.isfinite(self.values[:, places]).all(axis=1)
        return self if whole.all() else replace(self, time=self.time[whole], values=self.values[whole])


def _read_only(name: str, numbers: Array) -> Array:
    """What nobody can change."""
    try:
        return frozen_array(numbers)
    except (TypeError, ValueError) as error:
        raise BadInput(f"record: {name} must hold numbers ({error})") from error


class SimulationError(RuntimeError):
    """A run stopped early. `record` holds the part that was reached."""

    def __init__(self, message: str, record: Record) -> None:
        super().__init__(message)
        self.record = record
