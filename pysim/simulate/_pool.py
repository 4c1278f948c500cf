"""Tasks side by side in threads, stopped together."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, as_completed, wait
from typing import TypeVar

from pysim.types import BadInput, Model

Result = TypeVar("Result")
Stopped = Callable[[], bool]


def worker_count(function: str, model: Model, workers: int | None) -> int:
    """Threads that may run the model at once.

    Raises:
        BadInput: fewer than one.
    """
    if workers is not None and workers < 1:
        raise BadInput(f"{function}: workers must be at least 1, got {workers}")
    return 1 if model.abilities.single_instance else workers or os.cpu_count() or 1


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
    stop = threading.Event()
    with ThreadPoolExecutor(count) as pool:
        jobs = [pool.submit(task, stop.is_set) for task in tasks]
        try:
            if progress is None:  # then this thread sleeps; waking for every task, it would take the workers' time
                wait(jobs, return_when=FIRST_EXCEPTION)
            else:
                for done, job in enumerate(as_completed(jobs), start=1):
                    job.result()
                    progress(done, len(jobs))
            return tuple(job.result() for job in jobs)
        except BaseException:  # also an interrupt: the threads must not go on behind the caller's back
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)
            raise
