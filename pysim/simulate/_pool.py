"""Tasks side by side in threads, stopped together."""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from contextlib import AbstractContextManager
from queue import Empty, SimpleQueue
from typing import Any, TypeVar

from pysim.types import BadInput, Model

Result = TypeVar("Result")
Stopped = Callable[[], bool]

_NAP = 0.2  # s; on Windows an interrupt from the keyboard does not end a wait that has no limit


def worker_count(function: str, model: Model, workers: int | None) -> int:
    """Threads that may run the model at once.

    Raises:
        BadInput: fewer than one, or no whole number.
    """
    if workers is not None and not (isinstance(workers, int) and workers >= 1):
        raise BadInput(f"{function}: workers must be at least 1, a whole number, got {workers!r}")
    return 1 if model.abilities.single_instance else workers or os.cpu_count() or 1


def one_blas_thread() -> AbstractContextManager[Any]:
    """For the length of a block: threads of BLAS spin while they wait, on the cores where runs are simulated."""
    from threadpoolctl import threadpool_limits

    return threadpool_limits(1, "blas")


def side_by_side(
    tasks: Sequence[Callable[[Stopped], Result]], count: int, progress: Callable[[int, int], None] | None
) -> tuple[Result, ...]:
    """Results of the tasks, in their order; each is given a function to ask whether it is to stop.

    Args:
        tasks: called in `count` threads.
        count: threads.
        progress: called with (tasks done, tasks in all) from the calling thread; what it raises stops everything, as
            does an interrupt from the keyboard.
    """
    stop, left, finished = threading.Event(), deque(enumerate(tasks)), SimpleQueue[BaseException | None]()
    results: dict[int, Result] = {}

    def work() -> None:  # tasks may be short: handing each to the pool would cost as much as preparing a run
        while left and not stop.is_set():
            try:
                number, task = left.popleft()
            except IndexError:  # another thread was faster
                return
            try:
                results[number] = task(stop.is_set)
            except BaseException as error:
                finished.put(error)
                raise
            if progress is not None:
                finished.put(None)

    with ThreadPoolExecutor(count) as pool:
        jobs = [pool.submit(work) for _ in range(min(count, len(tasks)))]
        try:
            if progress is not None:
                for done in range(1, len(tasks) + 1):
                    if error := _next(finished):
                        raise error
                    progress(done, len(tasks))
            while wait(jobs, _NAP, FIRST_EXCEPTION).not_done:  # without progress this thread takes no time from them
                for job in jobs:
                    if job.done():
                        job.result()
            for job in jobs:
                job.result()
            return tuple(results[number] for number in range(len(tasks)))
        except BaseException:  # also an interrupt: the threads must not go on behind the caller's back
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def _next(queue: SimpleQueue[BaseException | None]) -> BaseException | None:
    while True:
        try:
            return queue.get(timeout=_NAP)
        except Empty:
            continue
