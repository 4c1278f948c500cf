"""Run many experiments on all cores."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, as_completed, wait

from pysim.simulate._base import Solver
from pysim.simulate._check import check_experiment
from pysim.simulate._library import open_library
from pysim.simulate._run import run
from pysim.simulate.rk45 import Rk45
from pysim.types import BadInput, Experiment, Model, Record


def simulate_many(
    model: Model,
    experiments: Sequence[Experiment],
    *,
    solver: Solver = Rk45(),  # noqa: B008
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Record, ...]:
    """Run experiments side by side, in threads; the records do not depend on how many.

    Args:
        model: a model-exchange FMU; each run has an instance of its own.
        experiments: as for `simulate`.
        solver: the same for all.
        workers: threads; all cores where None.
        progress: called with (runs done, runs in all) from the calling thread; what it raises stops everything, as
            does an interrupt from the keyboard.
    Returns:
        A Record per experiment, in their order; a failed run is a Record whose outcome says why.
    Raises:
        BadInput: as `simulate`, before the first run starts.
    """
    if workers is not None and workers < 1:
        raise BadInput(f"simulate_many: workers must be at least 1, got {workers}")
    for experiment in experiments:
        check_experiment(model, experiment)
    count = 1 if model.abilities.single_instance else workers or os.cpu_count() or 1
    stop = threading.Event()
    with open_library(model) as library, ThreadPoolExecutor(count) as pool:
        jobs = [pool.submit(run, library, experiment, solver, stop.is_set) for experiment in experiments]
        try:
            if progress is None:  # then this thread sleeps; waking for every run, it would take the workers' time
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
