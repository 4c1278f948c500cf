"""Workers that simulate the runs: threads of this process, worker processes that may crash, or a cluster."""

from __future__ import annotations

import atexit
import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.simulate import Esdirk, Orbit, Periodic, Runs, Sensitivities, Take, open_runs
from pysim.types import BadInput, Experiment, Model, Outcome

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Job:
    """One run.

    Args:
        place: index of the run among all runs.
        run: a run over time, or an orbit.
        names: variables by which the run is differentiated.
        slopes: (n_v, n_x) derivatives of these variables by the search coordinates.
        guess: first guess of an orbit's state, or None.
        mismatch: largest last correction of an orbit, in amplitudes, that is made to first order only.
        offset: whether to differentiate by the initial states too.
        take: receives the rows of a run over time in this process; the result then has no rows.
    """

    place: int
    run: Experiment | Periodic
    names: tuple[str, ...]
    slopes: Array
    guess: Array | None = None
    mismatch: float = 1e-5
    offset: bool = False
    take: Take | None = None


@dataclass(frozen=True)
class Lost:
    """Result of a run whose worker died."""

    message: str
    outcome: Outcome = Outcome.MODEL_ERROR

    @property
    def record(self) -> Lost:
        """Itself, as it has the outcome and message of a record."""
        return self


Result = Orbit | Sensitivities | Lost
Share = tuple[Model, list[Job], Esdirk]


class Workers(Protocol):
    """Runs jobs and returns their results in the same order; a failed run is a result with its outcome."""

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """Run jobs of one kind, orbits or runs over time, which have the same `names` and `offset`."""
        ...


@dataclass(frozen=True)
class Threads:
    """Threads of this process, one per core if `count` is None; FMUs of other tools run in separate processes."""

    count: int | None = None

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """See Workers."""
        return run_jobs(model, jobs, solver, self.count)


@dataclass(frozen=True)
class Processes:
    """Worker processes. If an FMU crashes, only its worker ends, and its run counts as failed.

    Args:
        count: number of processes; one per core if None.
    """

    count: int | None = None

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """Share out the jobs; if a worker dies, its jobs are repeated one by one to find the one that crashes."""
        count = self.count or os.cpu_count() or 1
        results: dict[int, Result] = {}
        again: list[int] = []
        chunks = _chunks(len(jobs), 4 * count)
        with helper_processes(count) as pool:
            waiting = [pool.submit(_run_share, _share(model, jobs, chunk, solver)) for chunk in chunks]
            for chunk, job in zip(chunks, waiting, strict=True):
                try:
                    results |= zip(chunk, job.result(), strict=True)
                except BrokenProcessPool:
                    again += chunk
        for i in again:
            with helper_processes(1) as pool:
                try:
                    results[i] = pool.submit(_run_share, _share(model, jobs, [i], solver)).result()[0]
                except BrokenProcessPool:
                    results[i] = Lost("the FMU crashed and took its worker process with it")
        return [results[i] for i in range(len(jobs))]


def helper_processes(count: int) -> ProcessPoolExecutor:
    """A pool of processes that Ctrl-C ends at once and without a message, which is left to the parent."""
    context, silent = multiprocessing.get_context("spawn"), (signal.SIGINT, signal.SIG_DFL)
    return ProcessPoolExecutor(count, mp_context=context, initializer=signal.signal, initargs=silent)


@dataclass(frozen=True)
class Cluster:
    """A cluster: a client with `map(function, chunks)` that returns futures with `result()`, such as a Dask client.

    The FMU's file has to be at the same path on every worker.

    Args:
        client: the client.
        chunks: number of shares of the jobs; two per worker if None.
    """

    client: Any
    chunks: int | None = None

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """Share out the jobs; all runs of a share whose worker died count as failed."""
        chunks = _chunks(len(jobs), self.chunks or 2 * _count(self.client))
        shares = [_share(model, jobs, chunk, solver) for chunk in chunks]
        results: dict[int, Result] = {}
        for chunk, future in zip(chunks, self.client.map(_run_share, shares, pure=False), strict=True):
            try:
                results |= zip(chunk, future.result(), strict=True)
            except BadInput:
                raise
            except Exception as error:  # clusters differ in what they raise when they lose a worker
                results |= dict.fromkeys(chunk, Lost(f"the cluster lost this run ({error})"))
        return [results[i] for i in range(len(jobs))]


def run_jobs(model: Model, jobs: Sequence[Job], solver: Esdirk, workers: int | None) -> Sequence[Result]:
    """Run all jobs in threads of this process, one per core if `workers` is None."""
    names, orbits = jobs[0].names, [job.run for job in jobs if isinstance(job.run, Periodic)]
    with _KEPT.use(model) as runs:
        if orbits:
            guesses, left = [job.guess for job in jobs], min(job.mismatch for job in jobs)
            return runs.orbits(orbits, names, guesses=guesses, solver=solver, mismatch=left, workers=workers)
        own = [job.run for job in jobs if isinstance(job.run, Experiment)]
        takes = [job.take for job in jobs]
        return runs.sensitivities(own, names, offset=jobs[0].offset, takes=takes, solver=solver, workers=workers)


class _Kept:
    """Cache of the last models, which stay open between points of a search; each is used by one thread at a time."""

    _MOST = 2  # a base model and the extended one

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: list[tuple[Model, Runs, ExitStack]] = []
        atexit.register(self.close)

    @contextmanager
    def use(self, model: Model) -> Iterator[Runs]:
        """The open model; returned to the cache in the end, or closed after an exception."""
        with self._lock:
            place = next((i for i, (kept, _, _) in enumerate(self._open) if kept == model), None)
            found = None if place is None else self._open.pop(place)
        if found is None:
            stack = ExitStack()
            found = model, stack.enter_context(open_runs(model)), stack
        try:
            yield found[1]
        except BaseException:
            found[2].close()
            raise
        with self._lock:
            self._open.append(found)
            old = [self._open.pop(0) for _ in range(len(self._open) - self._MOST)]
        for _, _, stack in old:
            stack.close()

    def close(self) -> None:
        """Close all models that are not in use."""
        with self._lock:
            old, self._open = self._open, []
        for _, _, stack in old:
            stack.close()


_KEPT = _Kept()


def _count(client: Any) -> int:
    """Number of workers of a cluster; 32 if its client does not say."""
    try:
        return max(len(client.nthreads()), 1)
    except AttributeError:
        return 32


def _share(model: Model, jobs: Sequence[Job], numbers: Sequence[int], solver: Esdirk) -> Share:
    """Some of the jobs, for another process, which returns all rows instead of reducing them."""
    return model, [replace(jobs[i], take=None) for i in numbers], solver


def _run_share(share: Share) -> list[Result]:
    model, jobs, solver = share
    return list(run_jobs(model, jobs, solver, 1))


def _chunks(count: int, most: int) -> list[list[int]]:
    """Indices 0 ... count - 1 in at most `most` shares, dealt out in turn, as slow jobs often follow each other."""
    shares = max(1, min(count, most))
    return [list(range(i, count, shares)) for i in range(shares) if i < count]
