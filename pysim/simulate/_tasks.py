"""Runs and orbits as tasks of the kernel: all of a pass in one call per thread, which leave the interpreter alone."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Solver
from pysim.simulate._job import Job
from pysim.simulate._library import Instance, Library, failure
from pysim.simulate._messages import joined, line_texts
from pysim.simulate._pool import Stopped
from pysim.simulate._variation import Directions, variation_arrays
from pysim.simulate.kernel.layout import (
    DISCARD,
    DONE,
    ERROR,
    EVENT,
    FATAL,
    FOUND,
    LINE_LENGTH,
    LINES,
    ORBIT,
    PASS,
    PLAIN,
    RUNNING,
    STATISTICS,
    TASK,
)
from pysim.simulate.kernel.library import address, kernel
from pysim.simulate.kernel.signals import offset_time, pack_breaks, pack_inputs
from pysim.types import Experiment, Outcome

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]

OUTCOMES = {RUNNING: Outcome.STOPPED, EVENT: Outcome.DONE, **dict(enumerate(Outcome))}  # by the kernel's codes
_STATUS = {DISCARD: "the model discards the point", ERROR: "an FMI function failed", FATAL: "a fatal FMI error"}
_TROUBLE = ("", "stopped", "an event happened", "", "the corrections do not converge", "")
_DRIFT = "a state drifts from period to period, and nothing holds it"

_NAP, _GLANCE = 0.2, 0.02  # s between two looks at what goes on: on Windows no interrupt ends a wait without a limit


@dataclass(frozen=True)
class Request:
    """One run, or the search for one orbit.

    Args:
        experiment: checked; for an orbit one period from time 0, its end included.
        states: (n,) to start from, for an orbit a guess; those of the FMU where None.
        start_by: (n, n_p) how they depend on the parameters; not at all where None.
        settling: periods from the model's own start that make a guess, where there is none; half of four cost the
            pump three times the time.
    """

    experiment: Experiment
    states: Array | None = None
    start_by: Array | None = None
    settling: int = 4


@dataclass(frozen=True)
class Kind:
    """What all requests of a pass have in common.

    Args:
        kind: PLAIN, VARIED or ORBIT.
        directions: of the derivatives.
        mismatch: largest correction of an orbit, in amplitudes, that is left to first order.
        point: whether the derivatives at the last point are wanted: `rates`, `jacobian` and `forcing`.
    """

    kind: int
    solver: Solver
    directions: Directions = Directions(outputs=False)  # noqa: RUF009
    mismatch: float = 0.0
    point: bool = False


class Found:
    """What came of a request."""

    def __init__(self, tasks: Tasks, number: int) -> None:
        self._tasks, self._number, self.task = tasks, number, tasks.table[number]

    @property
    def outcome(self) -> Outcome:
        """How the run ended; DONE also at an event that is not differentiated."""
        return OUTCOMES[int(self.task["code"])]

    @property
    def event(self) -> bool:
        """Whether the run ended at an event, or the search for an orbit met one."""
        return int(self.task["code"]) == EVENT

    @property
    def failed_to_start(self) -> bool:
        """Whether the FMU refused ahead of the run."""
        return bool(self.task["part"])

    @property
    def done(self) -> bool:
        """Whether the run came to its end, or the orbit was found."""
        return int(self.task["code"]) == DONE and int(self.task["trouble"]) == FOUND

    @property
    def message(self) -> str:
        """How the run ended, where, and what the FMU said; empty where it came to its end."""
        task = self.task
        if task["part"]:
            return failure(int(task["part"])) + self._said()
        if self.outcome is Outcome.DONE:
            return ""
        return explain(self.outcome, float(task["reached"]), int(task["status"])) + self._said()

    @property
    def trouble(self) -> str:
        """Why there is no orbit; empty if there is one."""
        number = int(self.task["trouble"])
        return "" if number == FOUND else _TROUBLE[number] or self.message or _DRIFT

    def _said(self) -> str:
        return joined(line_texts(self._tasks.texts[self._number]))

    def array(self, name: str) -> Array:
        """An array of the request's own, by the name of the field."""
        return self._tasks.array(name, self._number)

    @property
    def values(self) -> Array:
        """(n_t, n_y) what was recorded, as far as the run came."""
        return self._tasks.rows("values", self._number)

    @property
    def slopes(self) -> Array:
        """(n_t, n_y, n_p) derivatives of that by the parameters of the directions."""
        return self._tasks.rows("slopes", self._number)[:, :, self._tasks.by_offset :]

    @property
    def by_offset(self) -> Array:
        """(n_t, n_y, n_x) the same by the offset of the states; n_x = 0 where it is no direction."""
        return self._tasks.rows("slopes", self._number)[:, :, : self._tasks.by_offset]

    def statistics(self) -> dict[str, int]:
        """Counts of the run, or of the last period."""
        return {name: int(self.task[name]) for name in STATISTICS}


class Tasks:
    """Requests of one kind as the kernel has them; all record the same and set the same values.

    Attributes:
        table: (n,) of TASK.
    """

    def __init__(self, library: Library, kind: Kind, requests: Sequence[Request]) -> None:
        self.kind, self.library = kind, library
        experiments = [request.experiment for request in requests]
        self.record, self.set_names = experiments[0].record, tuple(experiments[0].overrides)
        count, n = len(requests), len(library.model.abilities.states)
        self.parameters = len(kind.directions.parameters)
        self.by_offset = n if kind.directions.offset else 0
        self.table = np.zeros(count, dtype=TASK)
        self._kept: list[Any] = [experiments]
        self.texts = np.zeros((count, LINES, LINE_LENGTH), dtype=np.uint8)
        ends = [float(e.times[-1]) for e in experiments]
        numbers = np.array([[*e.overrides.values()] for e in experiments], dtype=np.float64).reshape(count, -1)
        self._put("kind", kind.kind)
        self._put("start", [e.start for e in experiments])
        self._put("end", ends)
        self._put("times", [self._address(e.times) for e in experiments])
        sizes = np.array([e.times.size for e in experiments])
        self._put("count", sizes)
        self._put("mismatch", kind.mismatch)
        self._rows_of("set_values", numbers)
        self._put("states", [self._address(r.states) for r in requests])
        self._put("start_by", [self._address(r.start_by) for r in requests])
        self._put("offset_at", [offset_time(e) for e in experiments])
        self._put("offset", [self._address(e.offset if e.offset.size else None) for e in experiments])
        self._pack("inputs", pack_inputs(library.model, experiments))
        self._pack("breaks", pack_breaks(experiments, ends))
        if kind.kind == ORBIT:
            settling = [request.settling * end for request, end in zip(requests, ends, strict=True)]
            self._put("settling", settling)
            self._pack("settling_breaks", pack_breaks(experiments, settling))
        self._rows_of("text", self.texts.reshape(count, -1))
        self._first, self.most_rows = np.cumsum([0, *sizes]), int(sizes.max())
        self._results = self._make_results(count, n)

    def _make_results(self, count: int, n: int) -> dict[str, Any]:
        rows, n_y, n_p = int(self._first[-1]), len(self.record), self.parameters
        sampled = {"values": np.zeros((rows, n_y))}
        if self.kind.kind == PLAIN:
            own: dict[str, Any] = {}
        else:
            sampled["slopes"] = np.zeros((rows, n_y, self.by_offset + n_p))
            own = {name: np.zeros((count, n)) for name in ("state", "low", "high", "nominal")}
            own["state_by"] = np.zeros((count, n, n_p))
        if self.kind.point:
            own |= {"rates": np.zeros((count, n)), "jacobian": np.zeros((count, n, n))}
            own["forcing"] = np.zeros((count, n_p, n))
        for name, array in own.items():
            self._rows_of(name, array)
        for name, array in sampled.items():
            self._put(name, address(array) + self._first[:-1] * array.strides[0])
        return {**sampled, **own}

    def _put(self, name: str, values: Any) -> None:
        self.table[name] = values

    def _rows_of(self, name: str, array: NDArray[Any]) -> None:
        """Task i points to row i of the array."""
        self._kept.append(array)
        self.table[name] = address(array) + np.arange(len(array)) * array.strides[0]

    def _pack(self, name: str, packed: Any) -> None:
        self.table[name] = packed.structures
        self._kept.append(packed.kept)

    def _address(self, array: Array | None) -> int:
        if array is None:
            return 0
        contiguous = np.ascontiguousarray(array, dtype=np.float64)
        self._kept.append(contiguous)
        return address(contiguous)

    def array(self, name: str, number: int) -> Array:
        """Row `number` of a result that each task has one of."""
        row: Array = self._results[name][number]
        return row

    def rows(self, name: str, number: int) -> Array:
        """Recorded rows of a task."""
        first = self._first[number]
        rows: Array = self._results[name][first : first + int(self.table["rows"][number])]
        return rows

    def prepare(self, instance: Instance) -> Job:
        """The memory in which a thread runs tasks in an instance; what depends on model and solver is still there."""
        solver, abilities = self.kind.solver, instance.model.abilities
        if instance.job is None or instance.job.solver is not solver:
            instance.job = Job(solver)
            instance.job.put_model(
                instance.record, instance.jacobian, len(abilities.states), abilities.event_indicators
            )
        job, width = instance.job, max(len(self.record), len(self.set_names))
        getters, setters = instance.access(self.record, "Get"), instance.access(self.set_names, "Set")
        rows = {"columns": len(self.record), "access": getters, "set": setters, "buffer": np.zeros(width)}
        job.put("rows", rows)
        if self.kind.kind != PLAIN:
            arrays = variation_arrays(instance.model, self.record, self.kind.directions, solver, instance.column_of())
            job.put("variation", arrays)
            sizes = len(abilities.states), self.parameters, self.most_rows, len(self.record), arrays["columns"]
            job.put_shots(*sizes, orbit=self.kind.kind == ORBIT)
        return job


def run_tasks(
    library: Library,
    kind: Kind,
    requests: Sequence[Request],
    *,
    workers: int = 1,
    progress: Progress | None = None,
    stopped: Stopped = lambda: False,
) -> list[Found]:
    """Run requests of one kind in threads; what recorded variables and set values are, may differ from one to another.

    Args:
        workers: threads, each with an instance of its own.
        progress: called with (done, in all) from the calling thread; what it raises stops everything, as does an
            interrupt from the keyboard. Runs with derivatives and orbits count where they came to their end.
        stopped: asked now and then.
    """
    groups: dict[tuple[tuple[str, ...], tuple[str, ...]], list[int]] = {}
    for number, request in enumerate(requests):
        key = request.experiment.record, tuple(request.experiment.overrides)
        groups.setdefault(key, []).append(number)
    found: dict[int, Found] = {}
    shown = 0
    for numbers in groups.values():
        tasks = Tasks(library, kind, [requests[number] for number in numbers])
        shown += _Crew(tasks, workers, later(progress, shown, len(requests)), stopped).run()
        found |= {number: Found(tasks, place) for place, number in enumerate(numbers)}
    return [found[number] for number in range(len(requests))]


def later(progress: Progress | None, before: int, total: int) -> Progress | None:
    """Progress of a part of the work, behind another part."""
    return None if progress is None else lambda done, _: progress(before + done, total)


class _Crew:
    """Threads that share the tasks, watched by the thread that called."""

    def __init__(self, tasks: Tasks, workers: int, progress: Progress | None, stopped: Stopped) -> None:
        self._tasks, self._progress, self._stopped = tasks, progress, stopped
        self._pass = np.zeros(1, dtype=PASS)
        self._pass["tasks"], self._pass["count"] = address(tasks.table), tasks.table.size
        self._error: BaseException | None = None
        self._shown = 0
        count = max(1, min(workers, tasks.table.size))
        self._threads = [threading.Thread(target=self._work, daemon=True) for _ in range(count)]

    def _work(self) -> None:
        try:
            while self._pass["next"][0] < self._pass["count"][0] and not self._pass["stop"][0]:
                with self._tasks.library.lent() as instance:
                    kernel().work(self._pass, self._tasks.prepare(instance).record)
        except BaseException as error:
            self._error = error
            self._pass["stop"] = 1

    def run(self) -> int:
        """All tasks, or as many as are done when somebody stops them; how many counted as done."""
        for thread in self._threads:
            thread.start()
        try:
            for thread in self._threads:
                while thread.is_alive():
                    thread.join(_GLANCE if self._progress is not None else _NAP)
                    self._look()
            self._look()
        except BaseException:
            self._pass["stop"] = 1
            raise
        finally:
            for thread in self._threads:
                thread.join()
        if self._error is not None:
            raise self._error
        return self._shown

    def _look(self) -> None:
        if not self._pass["stop"][0] and self._stopped():
            self._pass["stop"] = 1
        done = int(self._pass["done"][0])
        while self._progress is not None and self._shown < done:
            self._shown += 1
            self._progress(self._shown, self._tasks.table.size)


def explain(outcome: Outcome, reached: float, status: int) -> str:
    """How a run ended, where (s), and what the FMU returned there."""
    said = _STATUS.get(status)
    return f"{outcome.value} at {reached:g} s" + (f" ({said})" if said else "")
