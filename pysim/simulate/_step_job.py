"""The memory of a run that goes on from one communication point to the next."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Solver
from pysim.simulate._job import Job
from pysim.simulate._library import Instance

Array = NDArray[np.float64]

_MEMORY = ("scratch", "nominal", "matrix", "pivots", "stages", "right", "factors", "tried_pivots")


@dataclass(frozen=True)
class SavedJob:
    """Numbers of a run, and the solver's memory."""

    record: NDArray[np.void]
    memory: tuple[NDArray[np.generic], ...]


class StepJob:
    """A job whose end moves on; with views of the numbers that every step changes.

    Args:
        references: (n_u,) of the inputs that may be straight lines within a step.
        outputs: names of what is read at each end, into `results`.
        time: s, of the start.
    """

    def __init__(
        self,
        instance: Instance,
        solver: Solver,
        references: NDArray[np.uint32],
        outputs: tuple[str, ...],
        results: Array,
        time: float,
    ) -> None:
        self.job, n_u = Job(solver), references.size
        self.record = self.job.record
        self._break, self._row, self._starts, self._cubics = np.zeros(1), np.zeros(1), np.zeros(n_u), np.zeros((n_u, 4))
        self._put_solver(instance)
        self._put_lines(references)
        self.job.put("breaks", {"count": 1, "times": self._break, "jumps": np.zeros(1, dtype=np.int64)})
        rows = {"columns": len(outputs), "access": instance.access(outputs, "Get"), "buffer": np.zeros(len(outputs))}
        self.job.put("rows", {**rows, "count": 1, "times": self._row, "values": results})
        self.job.restart(time, time)
        run = self.record["run"]
        self.t, self._end, self._horizon, self._segment = (run[name] for name in ("t", "end", "horizon", "segment"))
        self._leaves, self._next_event = run["leaves"], run["next_event"]
        self._next, self._lines = self.record["rows"]["next"], self.record["inputs"]["count"]

    def _put_solver(self, instance: Instance) -> None:
        abilities = instance.model.abilities
        self.job.put_model(instance.record, instance.jacobian, len(abilities.states), abilities.event_indicators)
        self.job.change("control", {"max_steps": np.iinfo(np.int64).max})

    def _put_lines(self, references: NDArray[np.uint32]) -> None:
        n_u = references.size
        numbers = np.arange(n_u + 1, dtype=np.int64)
        places = {"pieces": numbers, "cursor": numbers[:-1].copy(), "waves": np.zeros(n_u + 1, dtype=np.int64)}
        lines = {"starts": self._starts, "cubics": self._cubics, "sines": np.zeros((0, 4)), "values": np.zeros(n_u)}
        rate = np.zeros(n_u, dtype=np.int64)
        self.job.put("inputs", {"count": 0, "references": references, "rate": rate, **places, **lines})

    def aim(self, end: float, row: float, leaves: float = np.inf) -> None:
        """The run is to go on to the time `end` (s), and to read its outputs at the time `row`.

        Args:
            leaves: s, time events from here on are not handled.
        """
        self._leaves[0] = leaves
        self._end[0] = self._horizon[0] = self._break[0] = end
        self._row[0], self._next[0] = row, 0

    def begin_afresh(self, values: Array | None, rates: Array | None) -> None:
        """The kernel is to begin with an event at the present time, and with straight lines from there, if any."""
        self._segment[0] = -1
        self._lines[0] = 0 if values is None else values.size
        if values is not None:
            self._starts[:] = self.t[0]
            self._cubics[:, 0], self._cubics[:, 1] = values, rates

    @property
    def next_event(self) -> float:
        """Time of the model's next time event, s."""
        return float(self._next_event[0])

    @property
    def has_time_events(self) -> bool:
        """Whether the model has ever announced one, or had an event."""
        return bool(np.isfinite(self.record["run"]["next_event"][0]) or self.record["run"]["events"][0] > 0)

    def states(self) -> Array:
        """(n,) at the present time."""
        return self.job.array("work", "x")

    def save(self, into: SavedJob | None) -> SavedJob:
        """All that the solver knows; `into` is what is no longer needed."""
        arrays = (self.record, *(self.job.array("work", name) for name in _MEMORY), self._starts, self._cubics)
        if into is None:
            return SavedJob(arrays[0].copy(), tuple(array.copy() for array in arrays[1:]))
        for old, array in zip((into.record, *into.memory), arrays, strict=True):
            np.copyto(old, array)
        return into

    def restore(self, saved: SavedJob) -> None:
        """Be as when that was saved."""
        arrays = (self.record, *(self.job.array("work", name) for name in _MEMORY), self._starts, self._cubics)
        for array, old in zip(arrays, (saved.record, *saved.memory), strict=True):
            np.copyto(array, old)
