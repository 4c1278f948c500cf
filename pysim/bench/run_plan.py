"""Drive a model through a plan."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.bench.bench_tests import Run
from pysim.bench.plan import Plan
from pysim.bench.truth import Truth
from pysim.excitation import Multisine, SteppedSineCommand
from pysim.simulate import Rodas, Solver, simulate_many
from pysim.types import (
    BadInput,
    Dataset,
    Experiment,
    MeasuredRecord,
    Model,
    Outcome,
    Record,
    Signal,
    SimulationError,
    Variable,
)

Array = NDArray[np.float64]

# The pump's records are within 0.0007 percent and 2e-6 of the stroke of those at 1e-7: a hundredth of the noise.
SOLVER = Rodas(rtol=1e-6, atol=1e-6)
_LARGEST = 1e12  # of a command in its variable's unit, where the variable has no nominal value
_LARGEST_OVER_NOMINAL = 1e6  # of a command over its variable's nominal value, the scale that the model names


@dataclass(frozen=True)
class BenchData:
    """A data set as the bench leaves it, and the truth behind it."""

    dataset: Dataset
    truth: Truth


@dataclass(frozen=True)
class _Job:
    """A run with the instants of its log, (n_t,) s, the signals that drive it, by their names in the plan, and the
    experiment that records all that its sensors need."""

    run: Run
    instants: Array
    commands: Mapping[str, Signal]
    experiment: Experiment


def run_plan(
    model: Model,
    plan: Plan,
    seed: int,
    *,
    parameters: Mapping[str, float] | None = None,
    effect: str = "none",
    strength: Mapping[str, float] | None = None,
    solver: Solver = SOLVER,
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> BenchData:
    """Run every test of a plan from rest and measure it.

    Args:
        model: has a variable for each signal of the plan, in the same SI unit. An input named like the command with
            `_t` behind it gets the command's exact rate.
        seed: of noise and jitter, zero or more. What one log draws does not depend on the other logs of the plan.
        parameters: to set first, in the variables' units.
        effect, strength: of the truth, for whoever looks for it; not interpreted.
        solver, workers, progress: as for `simulate_many`.
    Raises:
        BadInput: before the first run; a negative seed, an unknown variable, an input that is none, another unit, or a
            sine or multisine above half the sampling rate.
        SimulationError: a run that stopped early.
    """
    if seed < 0:
        raise BadInput(f"bench: the seed is {seed}; give zero or more")
    for sensor in plan.sensors:
        model.measured(sensor.signal, "the plan")
    jobs = [_job(model, plan, run, seed, parameters or {}) for run in plan.runs()]
    records = simulate_many(model, [job.experiment for job in jobs], solver=solver, workers=workers, progress=progress)
    for job, record in zip(jobs, records, strict=True):
        if record.outcome is not Outcome.DONE:
            raise SimulationError(f"{job.run.source}: {model.name} stopped early: {record.message}", record)
    pairs = list(zip(jobs, records, strict=True))
    clean = _dataset(plan, [_clean(job, plan, record) for job, record in pairs])
    measured = _dataset(plan, [_measured(job, plan, record, seed) for job, record in pairs])
    truth = _truth(model, plan, seed, dict(parameters or {}), _exact(clean))
    return BenchData(measured, replace(truth, effect=effect, strength=dict(strength or {})))


def _truth(model: Model, plan: Plan, seed: int, parameters: dict[str, float], clean: Dataset) -> Truth:
    """With every parameter in force."""
    values = {
        v.name: float(parameters.get(v.name, v.start))
        for v in model.variables
        if v.causality == "parameter" and v.start is not None
    }
    return Truth(
        model=model.name,
        token=model.token,
        parameters=values,
        parameter_units={name: model[name].unit for name in values},
        noise={sensor.signal.name: sensor.signal.noise for sensor in plan.sensors},
        resolution={sensor.signal.name: sensor.signal.resolution for sensor in plan.sensors},
        plan=plan.name,
        seed=seed,
        clean=clean,
    )


def _exact(dataset: Dataset) -> Dataset:
    """Signals that no sensor has touched."""
    return replace(dataset, signals=tuple(replace(s, noise=None, resolution=None) for s in dataset.signals))


def _job(model: Model, plan: Plan, run: Run, seed: int, parameters: Mapping[str, float]) -> _Job:
    command = run.command.signal()
    _refuse_folding(run, plan.logger.rate(len(run.outputs)))
    random = np.random.default_rng([seed, zlib.crc32(run.source.encode())])
    instants = plan.logger.instants(run.log_from, run.command.end, len(run.outputs), random)
    if instants.size < 2:
        raise BadInput(f"{run.source}: the test is shorter than a sampling interval; lengthen it, or log faster")
    sensors = [plan.sensor(name) for name in run.outputs]
    commands = {run.input: command} | {name: command.times(r) for name, r in plan.along(run.input).items()}
    driven = {plan.sensor(name).signal.variable: signal for name, signal in commands.items()}
    for variable, signal in driven.items():
        _refuse_absurd(run, model[variable], signal.value(instants))
    rates = {rate: variable for rate, variable in model.rate_inputs(driven).items() if rate not in plan.inputs}
    experiment = Experiment(
        np.unique(np.concatenate([instants, *(sensor.sampled_at(instants) for sensor in sensors)])),
        record=tuple(dict.fromkeys(sensor.signal.variable for sensor in sensors)),
        inputs={name: Signal.constant(value) for name, value in plan.inputs.items()} | driven,
        overrides=parameters,
        rates=rates,
    )
    return _Job(run, instants, commands, experiment)


def _refuse_absurd(run: Run, variable: Variable, values: Array) -> None:
    """No solver gets through a command that is out of all proportion."""
    largest = float(np.abs(values).max())
    limit = _LARGEST if variable.nominal is None else _LARGEST_OVER_NOMINAL * abs(variable.nominal)
    if largest > limit:
        raise BadInput(
            f"{run.source}: its command takes {variable.name} to {largest:.3g} {variable.unit or ''}, beyond "
            f"{limit:.3g}; make offset and amplitude smaller"
        )


def _refuse_folding(run: Run, rate: float) -> None:
    """Lines would be taken for others, or for none; a chirp or wave folds back as on a bench."""
    highest = run.command.highest_hz if isinstance(run.command, Multisine | SteppedSineCommand) else 0.0
    if highest >= 0.5 * rate:
        raise BadInput(
            f"{run.source}: its {highest:g} Hz are not below half the sampling rate, {rate:.4g} Hz; log faster, or "
            "leave them out"
        )


def _clean(job: _Job, plan: Plan, record: Record) -> MeasuredRecord:
    """The true signals at the instants of the log."""
    columns = [command.value(job.instants) for command in job.commands.values()]
    rows = np.searchsorted(record.time, job.instants)
    columns += [record[plan.sensor(name).signal.variable][rows] for name in job.run.outputs]
    return _log(job, plan, job.instants, columns, "noise-free")


def _measured(job: _Job, plan: Plan, record: Record, seed: int) -> MeasuredRecord:
    """What the sensors and the logger make of it."""
    columns = []
    for name in (*job.commands, *job.run.outputs):
        sensor = plan.sensor(name)
        taken, rows = np.unique(sensor.sampled_at(job.instants), return_inverse=True)
        if name in job.commands:
            true = job.commands[name].value(taken)
        else:
            true = record[sensor.signal.variable][np.searchsorted(record.time, taken)]
        random = np.random.default_rng([seed, zlib.crc32(job.run.source.encode()), zlib.crc32(name.encode())])
        columns.append(sensor.measure(true, random)[rows])
    return _log(job, plan, plan.logger.stamps(job.instants), columns, "")


def _log(job: _Job, plan: Plan, time: Array, columns: list[Array], origin: str) -> MeasuredRecord:
    run = job.run
    names = (*job.commands, *run.outputs)
    units = tuple(plan.sensor(name).signal.unit for name in names)
    data = Record(time, np.column_stack(columns), names, units, origin=origin or f"measured, {run.source}")
    return MeasuredRecord(
        run.source, run.kind, run.use, data, run.offset, run.amplitude, run.frequency, command=run.input
    )


def _dataset(plan: Plan, records: list[MeasuredRecord]) -> Dataset:
    signals = tuple(sensor.signal for sensor in plan.sensors)
    return Dataset(plan.name, plan.description, plan.system, signals, tuple(records))
