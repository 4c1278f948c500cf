"""Run experiments: check, hand over to the kernel, hand back Records."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from pysim.simulate._base import Solver
from pysim.simulate._check import check_arguments, check_experiment, check_experiments, check_list
from pysim.simulate._foreign import Opened, open_model
from pysim.simulate._found import Found
from pysim.simulate._pass import Progress, run_tasks
from pysim.simulate._pool import Stopped, worker_count
from pysim.simulate._request import Kind, Request
from pysim.simulate.kernel.layout import PLAIN
from pysim.simulate.rk45 import Rk45
from pysim.types import Experiment, Model, Outcome, Record, SimulationError


def simulate(model: Model, experiment: Experiment, *, solver: Solver = Rk45(), check: bool = True) -> Record:  # noqa: B008
    """Run one experiment and return what was recorded.

    State events are looked for at the ends of steps, then located within: a condition that comes true and false again
    inside one step goes unseen. Where a model has such short ones, take a `max_step` below their duration; a tighter
    tolerance makes it unlikely only.

    Args:
        model: a model-exchange FMU, FMI 2.0 or 3.0; left unchanged.
        experiment: what is done to it.
        solver: method, tolerances, step limits.
        check: False returns a failed run instead of raising.
    Returns:
        time (n_t,) in s and values (n_t, n_y), columns as asked for; at an event the values after it.
    Raises:
        BadInput: unknown name, or one that cannot be driven, set or recorded; no binary for this machine.
        SimulationError: stopped early; `.record` holds the part that was reached.
    """
    check_arguments("simulate", model, solver)
    check_experiment(model, experiment)
    with open_model(model) as library:
        record = run(library, experiment, solver)
    if check and record.outcome is not Outcome.DONE:
        raise SimulationError(f"{model.name}: {record.message}", record)
    return record


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
        model: a model-exchange FMU; each thread has an instance of its own.
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
    check_experiments(model, experiments)
    if not experiments:
        return ()
    with open_model(model) as library:
        return tuple(run_many(library, experiments, solver, workers=count, progress=progress))


def run(library: Opened, experiment: Experiment, solver: Solver, stopped: Stopped = lambda: False) -> Record:
    """Run a checked experiment; a failure is an outcome. `stopped` is asked now and then."""
    return run_many(library, [experiment], solver, stopped=stopped)[0]


def run_many(
    library: Opened,
    experiments: Sequence[Experiment],
    solver: Solver,
    *,
    workers: int = 1,
    progress: Progress | None = None,
    stopped: Stopped = lambda: False,
) -> list[Record]:
    """Run checked experiments in threads."""
    requests = [Request(experiment) for experiment in experiments]
    found = run_tasks(library, Kind(PLAIN, solver), requests, workers=workers, progress=progress, stopped=stopped)
    return [record_of(library.model, e, f) for e, f in zip(experiments, found, strict=True)]


def record_of(model: Model, experiment: Experiment, found: Found) -> Record:
    """A run as others know it."""
    return make_record(model, experiment, found.values, found.outcome, found.message, found.statistics())


def make_record(
    model: Model, experiment: Experiment, values: np.ndarray, outcome: Outcome, message: str, statistics: dict[str, int]
) -> Record:
    """The record of a run, as far as it came: values (n_t, n_y)."""
    return Record(
        time=experiment.times[: len(values)],
        values=values,
        names=experiment.record,
        units=tuple(model[name].unit for name in experiment.record),
        outcome=outcome,
        message=message,
        origin=f"simulated {model.name}",
        statistics=statistics,
    )
