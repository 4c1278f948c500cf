"""Comparison of the fitted model with all measurements, including those that were not fitted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.beginning import settled_initial_states
from pysim.identify.greybox.nuisance import SensorErrors
from pysim.identify.greybox.observation import Observation, Simulated
from pysim.identify.greybox.problem import Problem
from pysim.identify.greybox.residuals import Channel
from pysim.identify.greybox.runs import Failure, Simulation, simulate_runs
from pysim.types import Experiment, Note, NoteCode, RecordFit, ResponseFit

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Compared:
    """Compared logs and responses, and experiments of the runs over time; notes on records that could not be simulated,
    and their number; `states`: id of a run -> its orbit's state, or the offset of its initial states from rest."""

    records: tuple[RecordFit, ...]
    responses: tuple[ResponseFit, ...]
    experiments: tuple[Experiment, ...]
    notes: tuple[Note, ...]
    lost: int = 0
    states: Mapping[int, Array | None] = field(default_factory=dict)


def compared(
    problem: Problem,
    x: Array,
    simulation: Simulation,
    carried: Mapping[int, Array | None] | None = None,
    given: Mapping[int, Simulated] | None = None,
    errors: SensorErrors = (),
) -> Compared:
    """Simulate every observation at x (n,); one that cannot be simulated is left out, with a note.

    Initial states of logs that were not fitted are estimated from these logs themselves, with the parameters held.

    Args:
        carried: id of a fitted run -> first guess of its orbit's state, or the offset of its initial states from rest.
        given: id of a run -> its result at x, which is then not simulated again.
        errors: sensor errors that are applied to the model's signals.
    """
    known = dict(carried or {})
    residuals = replace(problem.residuals(simulation=simulation, use="validate"), known=tuple(errors))
    unknown = [o for o in problem.observations if any(run.free.size and id(run) not in known for run in o.runs)]
    for one in unknown:
        point = settled_initial_states(replace(residuals, observations=(one,)), problem.model, problem.space, x)
        known |= dict(zip(map(id, one.runs), point.carried.states, strict=False))
    records: list[RecordFit] = []
    responses: list[ResponseFit] = []
    experiments, notes, lost = [], list[Note](), 0
    for one, simulated, failure in _simulated(problem, x, simulation, known, given or {}):
        if one.domain == "time":
            overrides = [problem.space.overrides(x, run.record) for run in one.runs]
            experiments += [r.over_time(o, known.get(id(r))) for r, o in zip(one.runs, overrides, strict=True)]
        if failure is not None:
            why = f"{failure.outcome.value}. {failure.message}".strip()
            notes.append(Note(NoteCode.NOT_SIMULATED, {"record": failure.record, "reason": why}))
            lost += len(one.sources)
            continue
        own = one.beside(one.sensed(simulated, errors) if errors else simulated)
        records, responses = [*records, *own[0]], [*responses, *own[1]]
    return Compared(tuple(records), tuple(responses), tuple(experiments), tuple(notes), lost, known)


def with_noise(record: RecordFit, noise: Mapping[Channel, float]) -> RecordFit:
    """The record with these standard deviations of the noise; channels that are not in `noise` keep theirs."""
    own = zip(record.measured.names, record.noise, strict=True)
    sizes = tuple(noise.get((record.dataset, name), size) for name, size in own)
    if sizes == record.noise:
        return record
    scale = {name: new / old for name, new, old in zip(record.measured.names, sizes, record.noise, strict=True)}
    harmonics = tuple(replace(one, std=one.std * scale[one.signal]) for one in record.harmonics)
    return replace(record, noise=sizes, harmonics=harmonics)


def _simulated(
    problem: Problem,
    x: Array,
    simulation: Simulation,
    known: Mapping[int, Array | None],
    given: Mapping[int, Simulated],
) -> list[tuple[Observation, tuple[Simulated, ...], Failure | None]]:
    """Simulate the observations that are not in `given`, all at once; if that fails, one by one."""

    def answers(observations: Sequence[Observation]) -> tuple[list[Simulated], Failure | None]:
        runs = [run for one in observations for run in one.runs]
        guesses = [known.get(id(run)) for run in runs]
        answer = simulate_runs(problem.model, problem.space, runs, x, guesses, simulation, slopes=False, initial=False)
        return list(answer.simulated), answer.failure

    left = [one for one in problem.observations if not all(_is_whole(given.get(id(run))) for run in one.runs)]
    everything, failure = answers(left) if left else ([], None)
    found = []
    for one in problem.observations:
        why: Failure | None = None
        if not any(one is other for other in left):
            own = [Simulated(given[id(run)].values, given[id(run)].slopes[..., :0]) for run in one.runs]
        elif failure is None:
            own, everything = everything[: len(one.runs)], everything[len(one.runs) :]
        else:
            own, why = answers([one])
        found.append((one, tuple(own), why))
    return found


def _is_whole(simulated: Simulated | None) -> bool:
    """Whether a run was simulated and its rows were not reduced."""
    return simulated is not None and simulated.reduction is None
