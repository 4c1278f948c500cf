"""Run many experiments on all cores."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from pysim.simulate._base import Solver
from pysim.simulate._check import check_arguments, check_experiment, check_list
from pysim.simulate._library import open_library
from pysim.simulate._pool import side_by_side, worker_count
from pysim.simulate._run import run
from pysim.simulate.rk45 import Rk45
from pysim.types import Experiment, Model, Record


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
    check_arguments("simulate_many", model, solver)
    check_list("simulate_many", "experiments", experiments, Experiment)
    count = worker_count("simulate_many", model, workers)
    for experiment in experiments:
        check_experiment(model, experiment)
    with open_library(model) as library:
        tasks = [partial(run, library, experiment, solver) for experiment in experiments]
        return side_by_side(tasks, count, progress)
