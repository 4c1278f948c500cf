"""Run one experiment: check, initialise, hand over to the kernel, hand back a Record."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

import numpy as np

from pysim.simulate._base import Solver
from pysim.simulate._check import check_arguments, check_experiment
from pysim.simulate._job import Job
from pysim.simulate._library import CallFailed, Instance, Library, open_library
from pysim.simulate.kernel.layout import DISCARD, ERROR, FATAL, RUNNING
from pysim.simulate.kernel.library import kernel
from pysim.simulate.kernel.memory import work_arrays
from pysim.simulate.kernel.method import ExplicitMethod, method_arrays
from pysim.simulate.kernel.signals import break_arrays, input_arrays
from pysim.simulate.rk45 import Rk45
from pysim.types import Experiment, Model, Outcome, Record, SimulationError

OUTCOMES = {RUNNING: Outcome.STOPPED, **dict(enumerate(Outcome))}  # by the kernel's codes, once nobody goes on

_FIRST_LOOK = 20  # steps until the first look at the world outside; then as many as take about
_BETWEEN_LOOKS = 0.02  # s, whatever the model's own functions cost
_LONGER = 10.0  # times the steps before, at most

_STATUS = {DISCARD: "the model discards the point", ERROR: "an FMI function failed", FATAL: "a fatal FMI error"}


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
    with open_library(model) as library:
        record = run(library, experiment, solver)
    if check and record.outcome is not Outcome.DONE:
        raise SimulationError(f"{model.name}: {record.message}", record)
    return record


def run(
    library: Library, experiment: Experiment, solver: Solver, stopped: Callable[[], bool] = lambda: False
) -> Record:
    """Run a checked experiment; a failure is an outcome. `stopped` is asked some 50 times a second."""
    try:
        with library.instance() as instance:
            return _run_instance(instance, experiment, solver, stopped)
    except CallFailed as error:
        return make_record(
            library.model, experiment, np.zeros((0, len(experiment.record))), Outcome.MODEL_ERROR, str(error), {}
        )


def _run_instance(instance: Instance, experiment: Experiment, solver: Solver, stopped: Callable[[], bool]) -> Record:
    initialise(instance, experiment, solver)
    job = prepare(instance, experiment, solver)
    code = go_on(kernel().integrate, job, stopped)
    instance.status = int(job.number("run", "status"))
    outcome = OUTCOMES[code]
    message = "" if outcome is Outcome.DONE else explain(job, outcome) + instance.mailbox.text()
    values = job.array("rows", "values")[: job.number("rows", "next")]
    return make_record(instance.model, experiment, values, outcome, message, job.statistics())


def go_on(loop: Callable[[np.ndarray, int], int], job: Job, stopped: Callable[[], bool]) -> int:
    """Call a loop of the kernel until its run has ended or is to stop; how it ended, or RUNNING.

    Only between two calls can an interrupt from the keyboard arrive.
    """
    code, budget = RUNNING, _FIRST_LOOK
    while code == RUNNING and not stopped():
        begun = perf_counter()
        code = loop(job.record, budget)
        budget = next_budget(budget, perf_counter() - begun)
    return code


def next_budget(budget: int, taken: float) -> int:
    """Steps until the next look, after that many took so long (s)."""
    return max(1, int(budget * min(_LONGER, _BETWEEN_LOOKS / max(taken, 1e-9))))


def initialise(instance: Instance, experiment: Experiment, solver: Solver) -> None:
    """Take an instance that is as new into event mode at the experiment's start.

    Raises:
        CallFailed: the FMU refused.
    """
    control = solver.control()
    tolerance = control.rtol if control.step == 0.0 else None
    instance.initialise(values_at_start(experiment), experiment.start, float(experiment.times[-1]), tolerance)


def values_at_start(experiment: Experiment) -> dict[str, float]:
    """What is set before a run: overrides, and inputs as they begin."""
    values = dict(experiment.overrides)
    if experiment.inputs:
        start = np.array(experiment.start)
        values |= {name: float(signal.value(start)) for name, signal in experiment.inputs.items()}
        values |= {name: float(experiment.inputs[of].derivative(start)) for name, of in experiment.rates.items()}
    return values


def prepare(instance: Instance, experiment: Experiment, solver: Solver) -> Job:
    """Everything the kernel needs for this run; what depends on model and solver alone is still there."""
    if instance.job is None or instance.job.solver is not solver:
        instance.job = _new_job(instance, solver)
    job, names, times = instance.job, experiment.record, experiment.times
    values = np.zeros((times.size, len(names)))
    job.restart(experiment.start, float(times[-1]))
    job.change("run", offset_arrays(experiment))
    job.keep("fmu", instance.addresses())
    job.keep("inputs", input_arrays(instance.model, experiment))
    job.put("breaks", break_arrays(experiment))
    job.keep("rows", instance.rows(names))
    job.change("rows", {"count": times.size, "next": 0, "times": times, "values": values})
    return job


def _new_job(instance: Instance, solver: Solver) -> Job:
    abilities, method, job = instance.model.abilities, solver.method(), Job(solver)
    implicit = not isinstance(method, ExplicitMethod)
    n, m, terms = len(abilities.states), abilities.event_indicators, method.dense.shape[1]
    job.put("method", method_arrays(method))
    job.put("control", solver.control()._asdict())
    job.put("work", {**work_arrays(n, m, method.b.size, terms, implicit), **instance.jacobian})
    return job


def explain(job: Job, outcome: Outcome) -> str:
    """How a run ended, where, and what the FMU returned there."""
    status = _STATUS.get(int(job.number("run", "status")))
    return f"{outcome.value} at {job.number('run', 't'):g} s" + (f" ({status})" if status else "")


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
