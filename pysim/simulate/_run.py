"""Run one experiment: check, initialise, hand over to native code, hand back a Record."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from pysim.simulate._base import Solver
from pysim.simulate._fmu_calls import ASKS, DISCARD, ERROR, FATAL
from pysim.simulate._inputs import find_breaks, pack_inputs
from pysim.simulate._library import CallFailed, Instance, Library, open_library
from pysim.simulate._loop import integrate
from pysim.simulate._recording import Rows
from pysim.simulate._state import RUN, RUNNING, STATISTICS, new_work
from pysim.simulate.rk45 import Rk45
from pysim.types import Experiment, Model, Outcome, Record, SimulationError

_BUDGET = 20_000  # steps between two looks at the world outside: some 20 ms

_STATUS = {DISCARD: "discarded a point", ERROR: "an error", FATAL: "a fatal error"}


def simulate(model: Model, experiment: Experiment, *, solver: Solver = Rk45(), check: bool = True) -> Record:  # noqa: B008
    """Run one experiment and return what was recorded.

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
    check_experiment(model, experiment)
    with open_library(model) as library:
        record = run(library, experiment, solver)
    if check and record.outcome is not Outcome.DONE:
        raise SimulationError(f"{model.name}: {record.message}", record)
    return record


def run(library: Library, experiment: Experiment, solver: Solver, stopped: Callable[[], bool] = lambda: False) -> Record:
    """Run a checked experiment; a failure is an outcome. `stopped` is asked some 50 times a second."""
    try:
        with library.instance() as instance:
            return _run_instance(instance, experiment, solver, stopped)
    except CallFailed as error:
        return _record(library.model, experiment, np.zeros((0, len(experiment.record))), Outcome.MODEL_ERROR, str(error))


def _run_instance(instance: Instance, experiment: Experiment, solver: Solver, stopped: Callable[[], bool]) -> Record:
    model, control, method = instance.model, solver.control(), solver.method()
    inputs, breaks = pack_inputs(model, experiment), find_breaks(experiment)
    first = {name: float(signal.value(np.array(experiment.start))) for name, signal in experiment.inputs.items()}
    try:
        instance.initialise(
            {**first, **experiment.overrides}, experiment.start, float(breaks.times[-1]), control.rtol if control.step == 0 else None
        )
    except CallFailed as error:
        raise CallFailed(f"{error}{instance.mailbox.text()}") from error
    abilities = model.abilities
    work = new_work(
        len(abilities.states),
        abilities.event_indicators,
        method.b.size,
        method.dense.shape[1],
        [model[name].reference for name in abilities.states],
        [model[name].reference for name in abilities.derivatives],
        implicit=False,
    )
    runs = np.zeros(1, dtype=RUN)
    runs["start"] = runs["t"] = experiment.start
    runs["segment"] = -1
    rows = Rows(
        experiment.times.copy(),
        np.array([model[name].reference for name in experiment.record], dtype=np.uint32),
        np.zeros((experiment.times.size, len(experiment.record))),
    )
    code = RUNNING
    fmus, asks = instance.native(), np.zeros(1, dtype=ASKS)
    while code == RUNNING and not stopped():
        code = integrate(method, control, fmus, inputs, breaks, runs, work, rows, asks, _BUDGET)
    instance.lost = bool(runs["status"][0] >= FATAL)
    outcome = list(Outcome)[code]
    return _record(model, experiment, rows.values[: runs["row"][0]], outcome, "" if outcome is Outcome.DONE else outcome.value + instance.mailbox.text(), runs)


def _record(model: Model, experiment: Experiment, values: np.ndarray, outcome: Outcome, message: str, runs=None) -> Record:
    return Record(
        time=experiment.times[: len(values)],
        values=values,
        names=experiment.record,
        units=tuple(model[name].unit for name in experiment.record),
        outcome=outcome,
        message=message,
        origin=f"simulated {model.name}",
        statistics={name: int(runs[name][0]) for name in STATISTICS} if runs is not None else {},
    )


def check_experiment(model: Model, experiment: Experiment) -> None:
    """Refuse names that the model does not have or that cannot play their part."""
    for name in (*experiment.inputs, *experiment.rates, *experiment.overrides, *experiment.record):
        model[name]
