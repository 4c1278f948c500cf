"""The fitted model beside every record, those held out too."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.accuracy import frequency_deviations, time_deviations
from pysim.identify.greybox.harmonics import interpolation
from pysim.identify.greybox.log_target import LogTarget
from pysim.identify.greybox.problem import Problem
from pysim.identify.greybox.response import LogResponse
from pysim.identify.greybox.simulation import Simulation, simulate_runs
from pysim.identify.greybox.sine_log import SineLog
from pysim.identify.greybox.sine_target import SineTarget
from pysim.identify.greybox.table_target import TableTarget
from pysim.identify.greybox.target import Simulated, Target
from pysim.types import (
    Experiment,
    FrequencyResponse,
    Harmonics,
    RecordFit,
    ResponseComparison,
    ResponseFit,
    SineTest,
)

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Compared:
    """Everything at one point: logs, responses, the runs over time; why some records are not there, and how many."""

    records: tuple[RecordFit, ...]
    responses: tuple[ResponseFit, ...]
    experiments: tuple[Experiment, ...]
    notes: tuple[str, ...]
    lost: int = 0


def compared(
    problem: Problem, x: Array, simulation: Simulation, known: Mapping[int, Simulated] | None = None
) -> Compared:
    """Simulate every target at x (n,); one that cannot be simulated is noted and left out.

    Args:
        known: id of a run -> its answer at x, where that is there already.
    """
    records: list[RecordFit] = []
    responses: list[ResponseFit] = []
    notes: list[str] = []
    experiments = []
    lost = 0
    for target, simulated, trouble in _simulated(problem, x, simulation, known or {}):
        if isinstance(target, LogTarget):
            run = target.run.experiment
            overrides = {**run.overrides, **problem.space.overrides(x, target.run.record)}
            experiments.append(replace(run, overrides=overrides))
        if trouble:
            notes.append(f"not simulated: {trouble}")
            lost += len(target.logs) if isinstance(target, SineTarget) else 1
        elif isinstance(target, LogTarget):
            records.append(_log(target, simulated[0]))
        elif isinstance(target, SineTarget):
            records += [_sine(target, log, s) for log, s in zip(target.logs, simulated, strict=True)]
            responses += [_responses(target, simulated, j) for j in range(len(target.logs[0].measured.names))]
        elif isinstance(target, TableTarget):
            responses.append(_table(target, simulated))
    return Compared(tuple(records), tuple(responses), tuple(experiments), tuple(notes), lost)


def _simulated(
    problem: Problem, x: Array, simulation: Simulation, known: Mapping[int, Simulated]
) -> Iterator[tuple[Target, tuple[Simulated, ...], str]]:
    """What is not known of all targets at once; where that fails, one by one."""
    left = [target for target in problem.targets if any(id(run) not in known for run in target.runs)]
    answers, trouble = _answers(problem, x, simulation, left)
    found, troubles = {**known, **answers}, dict.fromkeys(map(id, left), trouble)
    for target in left if trouble else ():
        answers, troubles[id(target)] = _answers(problem, x, simulation, [target])
        found |= answers
    for target in problem.targets:
        why = troubles.get(id(target), "")
        yield target, () if why else tuple(found[id(run)] for run in target.runs), why


def _answers(
    problem: Problem, x: Array, simulation: Simulation, targets: Sequence[Target]
) -> tuple[dict[int, Simulated], str]:
    """id of a run -> its answer, without slopes; and why there are none."""
    runs = [run for target in targets for run in target.runs]
    nothing = (None,) * len(runs)
    answer = simulate_runs(problem.model, problem.space, runs, x, nothing, simulation, slopes=False)
    return {} if answer.trouble else dict(zip(map(id, runs), answer.simulated, strict=True)), answer.trouble


def _log(target: LogTarget, simulated: Simulated) -> RecordFit:
    model = replace(target.measured, values=simulated.values, origin="simulated")
    deviations = {
        name: time_deviations(simulated.values[:, j], target.measured.values[:, j], target.full_scale[j])
        for j, name in enumerate(target.measured.names)
    }
    return RecordFit(
        target.dataset, target.source, target.kind, target.use, target.measured, model, target.noise, deviations,
        index=target.index,
    )  # fmt: skip


def _sine(target: SineTarget, log: SineLog, simulated: Simulated) -> RecordFit:
    values = interpolation(log.phase, log.points) @ simulated.values
    measured, model = log.coefficients(log.harmonics), log.coefficients(log.onto @ simulated.values)
    harmonics = tuple(
        Harmonics(name, log.sine.frequency, measured[:, j], model[:, j], log.noise[j] * log.deviations())
        for j, name in enumerate(log.measured.names)
    )
    beside = replace(log.measured, values=values, origin="simulated")
    return RecordFit(
        target.dataset, log.source, target.kind, target.use, log.measured, beside, log.noise, {}, harmonics,
        index=log.index,
    )  # fmt: skip


def _responses(target: SineTarget, simulated: Sequence[Simulated], column: int) -> ResponseFit:
    first = target.logs[0]
    frequency = np.array([log.sine.frequency for log in target.logs])
    test = SineTest(first.sine.offset, first.sine.amplitude, "command", first.measured.names[column])
    logarithm = target.measured_gains[:, column]
    measured = FrequencyResponse(
        frequency, np.exp(logarithm.real), np.unwrap(logarithm.imag), test, "measured, stepped sines"
    )
    model = _beside(measured, target.response(simulated, column))
    reference = None if target.reference is None else float(frequency[target.reference])
    deviations = frequency_deviations(model, measured, reference_hz=reference)
    return ResponseFit(target.dataset, target.use, ResponseComparison(measured, model, deviations))


def _table(target: TableTarget, simulated: Sequence[Simulated]) -> ResponseFit:
    model = _beside(target.measured, target.response(simulated))
    reference = None if target.reference is None else float(target.measured.frequency[target.reference])
    deviations = frequency_deviations(model, target.measured, reference_hz=reference)
    return ResponseFit(target.dataset, target.use, ResponseComparison(target.measured, model, deviations))


def _beside(measured: FrequencyResponse, simulated: LogResponse) -> FrequencyResponse:
    """The model's response, its phase in the turn next to the measured one."""
    gap = np.unwrap(simulated.values.imag - measured.phase)
    phase = measured.phase + gap - 2 * np.pi * np.round(gap[0] / (2 * np.pi))
    return replace(
        measured, gain=np.exp(simulated.values.real), phase=phase, origin="simulated", mean=None, covariance=None
    )
