"""Where the runs go: threads of this process, worker processes that may crash, or a cluster."""

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
        place: of the run among those asked for.
        run: a run over time, or an orbit.
        names: variables whose slopes are wanted.
        slopes: (n_v, n_x) of those variables by the search's numbers.
        guess: state to start an orbit's search from, or None.
        mismatch: what of an orbit's correction is left to first order.
        offset: whether slopes by the offset of the states are wanted.
        take: of a run over time, is given its rows where it runs in this process; then its result has none.
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
    """Stands for the result of a run whose worker died."""

    message: str
    outcome: Outcome = Outcome.MODEL_ERROR

    @property
    def record(self) -> Lost:
        """Itself: outcome and message are all there is."""
        return self


Result = Orbit | Sensitivities | Lost
Share = tuple[Model, list[Job], Esdirk]


class Workers(Protocol):
    """Runs jobs, in their order; a failed run is a result that says so."""

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """Orbits, or runs with sensitivities: all jobs are of one kind, with the same names and `offset`."""
        ...


@dataclass(frozen=True)
class Threads:
    """Threads of this process, all cores where `count` is None; the FMUs of others run in processes of their own."""

    count: int | None = None

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """See Workers."""
        return run_jobs(model, jobs, solver, self.count)


@dataclass(frozen=True)
class Processes:
    """A process per core; an FMU that crashes ends its worker, and its run is a failed one.

    Args:
        count: processes; all cores where None.
    """

    count: int | None = None

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """Share the jobs out; where a worker dies, its jobs are tried again one by one to find the culprit."""
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
    """Processes that Ctrl-C ends at once and without a word; the parent says what has to be said."""
    context, silent = multiprocessing.get_context("spawn"), (signal.SIGINT, signal.SIG_DFL)
    return ProcessPoolExecutor(count, mp_context=context, initializer=signal.signal, initargs=silent)


@dataclass(frozen=True)
class Cluster:
    """Whoever has `map(function, chunks)` and gives futures with `result()`, such as a Dask client.

    The FMU's file has to be at the same path on every worker.

    Args:
        client: the client.
        chunks: shares the jobs are cut into; two for each worker where None.
    """

    client: Any
    chunks: int | None = None

    def run(self, model: Model, jobs: Sequence[Job], solver: Esdirk) -> Sequence[Result]:
        """Share the jobs out; a share whose worker died is a row of failed runs."""
        chunks = _chunks(len(jobs), self.chunks or 2 * _count(self.client))
        shares = [_share(model, jobs, chunk, solver) for chunk in chunks]
        results: dict[int, Result] = {}
        for chunk, future in zip(chunks, self.client.map(_run_share, shares, pure=False), strict=True):
            try:
                results |= zip(chunk, future.result(), strict=True)
            except BadInput:
                raise
            except Exception as error:  # whatever a cluster raises when it loses a worker
                results |= dict.fromkeys(chunk, Lost(f"the cluster lost this run ({error})"))
        return [results[i] for i in range(len(jobs))]


def run_jobs(model: Model, jobs: Sequence[Job], solver: Esdirk, workers: int | None) -> Sequence[Result]:
    """All jobs in threads of this process."""
    names, orbits = jobs[0].names, [job.run for job in jobs if isinstance(job.run, Periodic)]
    with _KEPT.use(model) as runs:
        if orbits:
            guesses, left = [job.guess for job in jobs], min(job.mismatch for job in jobs)
            return runs.orbits(orbits, names, guesses=guesses, solver=solver, mismatch=left, workers=workers)
        own = [job.run for job in jobs if isinstance(job.run, Experiment)]
        takes = [job.take for job in jobs]
        return runs.sensitivities(own, names, offset=jobs[0].offset, takes=takes, solver=solver, workers=workers)


class _Kept:
    """Models that stay open from pass to pass of a search, the last few; each is used by one thread at a time."""

    _MOST = 2  # a base model and the one beside it

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: list[tuple[Model, Runs, ExitStack]] = []
        atexit.register(self.close)

    @contextmanager
    def use(self, model: Model) -> Iterator[Runs]:
        """The model, opened where it is not; given back in the end, and closed where something was raised."""
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
        """Close all that nobody uses."""
        with self._lock:
            old, self._open = self._open, []
        for _, _, stack in old:
            stack.close()


_KEPT = _Kept()


def _count(client: Any) -> int:
    """Workers of a cluster; as many as a large one has where it does not say."""
    try:
        return max(len(client.nthreads()), 1)
    except AttributeError:
        return 32


def _share(model: Model, jobs: Sequence[Job], numbers: Sequence[int], solver: Esdirk) -> Share:
    """Some of the jobs for another process, which hands all rows back."""
    return model, [replace(jobs[i], take=None) for i in numbers], solver


def _run_share(share: Share) -> list[Result]:
    model, jobs, solver = share
    return list(run_jobs(model, jobs, solver, 1))


def _chunks(count: int, most: int) -> list[list[int]]:
    """Places 0 ... count - 1, dealt out so that each share has some of the slow ones."""
    shares = max(1, min(count, most))
    return [list(range(i, count, shares)) for i in range(shares) if i < count]
