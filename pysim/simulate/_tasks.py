"""Requests packed into structures of the kernel, with room for what comes of them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._job import Job
from pysim.simulate._library import Instance
from pysim.simulate._request import Kind, Request
from pysim.simulate._variation import variation_arrays
from pysim.simulate.kernel.layout import DONE, FOUND, LINE_LENGTH, LINES, ORBIT, PLAIN, TASK
from pysim.simulate.kernel.library import TAKE, address
from pysim.simulate.kernel.signals import Packs, offset_time
from pysim.types import Model

Array = NDArray[np.float64]

STRETCH = 8192  # rows that are handed over at a time: a few MB


class Tasks:
    """Requests of one kind as the kernel has them; all record the same and set the same values.

    Attributes:
        table: (n,) of TASK.
        error: what was raised where rows were taken.
    """

    def __init__(self, model: Model, kind: Kind, requests: Sequence[Request], packs: Packs) -> None:
        self.kind = kind
        self.error: BaseException | None = None
        experiments = [request.experiment for request in requests]
        self.record, self.set_names = experiments[0].record, tuple(experiments[0].overrides)
        count, n = len(requests), len(model.abilities.states)
        self.parameters = len(kind.directions.parameters)
        self.by_offset = n if kind.directions.offset else 0
        self.table = np.zeros(count, dtype=TASK)
        self._kept: list[Any] = [experiments]
        self._columns: dict[str, list[Any]] = {}
        self.texts = np.zeros((count, LINES, LINE_LENGTH), dtype=np.uint8)
        ends = [float(e.times[-1]) for e in experiments]
        numbers = np.array([[*e.overrides.values()] for e in experiments], dtype=np.float64).reshape(count, -1)
        self._put("kind", kind.kind)
        self._put("start", [e.start for e in experiments])
        self._put("end", ends)
        self._put("times", [address(e.times) for e in experiments])
        sizes = np.array([e.times.size for e in experiments])
        self._put("count", sizes)
        self._takes = [request.take for request in requests]
        if any(self._takes):
            sizes = self._put_takes(sizes)
        self._put("mismatch", kind.mismatch)
        self._rows_of("set_values", numbers)
        self._given("states", [r.states for r in requests])
        self._given("start_by", [r.start_by for r in requests])
        self._put("offset_at", [offset_time(e) for e in experiments])
        self._given("offset", [e.offset if e.offset.size else None for e in experiments])
        self._pack("inputs", packs.inputs(model, experiments))
        self._pack("breaks", packs.breaks(experiments, ends))
        if kind.kind == ORBIT:
            settling = [request.settling * end for request, end in zip(requests, ends, strict=True)]
            self._put("settling", settling)
            if any(request.states is None for request in requests):
                self._pack("settling_breaks", packs.breaks(experiments, settling))
        self._rows_of("text", self.texts.reshape(count, -1))
        self._first, self.most_rows = np.cumsum([0, *sizes]), int(sizes.max())
        self._results = self._make_results(count, n)

    def _put_takes(self, sizes: NDArray[np.int64]) -> NDArray[np.int64]:
        """Have rows handed over; how many of each task are in memory at a time."""
        self._callback: Any = TAKE(self._take)
        given = np.array([take is not None for take in self._takes])
        sizes = np.where(given, np.minimum(sizes, STRETCH), sizes)
        self._put("take", np.where(given, ctypes.cast(self._callback, ctypes.c_void_p).value or 0, 0))
        self._put("room", sizes)
        self._put("number", np.arange(len(sizes)))
        return sizes

    def _take(self, number: int, first: int, count: int) -> None:
        take, place = self._takes[number], self._first[number]
        if take is None or self.error is not None:
            return
        try:
            take(first, *(self._results[name][place : place + count] for name in ("values", "slopes")))
        except BaseException as error:
            self.error = error

    def let_go(self) -> None:
        """Keep nobody who took rows: the callback holds the tasks in a circle, and all that takers keep with them."""
        self._takes, self._callback = [], None

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

    def _given(self, name: str, arrays: Sequence[Array | None]) -> None:
        """Each task points to its own array, all of one shape, or to none."""
        given = [k for k, array in enumerate(arrays) if array is not None]
        if given:
            rows = np.array([arrays[k] for k in given], dtype=np.float64)
            self._kept.append(rows)
            self.table[name][given] = address(rows) + np.arange(len(given)) * rows.strides[0]

    def counts(self, number: int) -> bool:
        """Whether a task counts as done in what is said of progress."""
        is_done = self.column("code")[number] == DONE and self.column("trouble")[number] == FOUND
        return self.kind.kind == PLAIN or is_done

    def column(self, name: str) -> list[Any]:
        """A field of all tasks, once they are done."""
        if name not in self._columns:
            self._columns[name] = self.table[name].tolist()
        return self._columns[name]

    def __getstate__(self) -> dict[str, Any]:
        """For another process: what was found, without what was asked and without addresses."""
        kept = ("kind", "record", "by_offset", "parameters", "table", "texts", "_first", "_results", "_columns")
        return {name: getattr(self, name) for name in kept}

    def array(self, name: str, number: int) -> Array:
        """Row `number` of a result that each task has one of."""
        row: Array = self._results[name][number]
        return row

    def arrays(self, name: str, numbers: Sequence[int]) -> Array:
        """The rows of some tasks (n, ...)."""
        whole: Array = self._results[name]
        return whole if len(numbers) == len(whole) else whole[numbers]

    def stack(self, name: str, numbers: Sequence[int]) -> Array | None:
        """The recorded rows of some tasks (n, n_t, ...); None where not all have as many."""
        count, sizes = self.column("rows"), np.diff(self._first)
        rows = count[numbers[0]]
        if any(count[number] != rows for number in numbers) or np.any(sizes != sizes[0]):
            return None
        whole: Array = self._results[name].reshape(len(sizes), int(sizes[0]), *self._results[name].shape[1:])
        return whole[:, :rows] if len(numbers) == len(whole) else whole[numbers, :rows]

    def rows(self, name: str, number: int) -> Array:
        """Recorded rows of a task; none where they were handed over."""
        first, taken = self._first[number], self.column("take")[number]
        rows: Array = self._results[name][first : first + (0 if taken else self.column("rows")[number])]
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
            key = self.record, self.kind.directions
            if key not in job.variations:
                job.variations[key] = variation_arrays(instance.model, *key, solver, instance.column_of())
            arrays = job.variations[key]
            job.put("variation", arrays)
            sizes = len(abilities.states), self.parameters, self.most_rows, len(self.record), arrays["columns"]
            job.put_shots(*sizes, orbit=self.kind.kind == ORBIT)
        return job
