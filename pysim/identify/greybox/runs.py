"""Simulate the model for every observation at one point of the search, with derivatives (sensitivities)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.observation import Run, Simulated
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.reduction import Reduction
from pysim.identify.greybox.settings import FitSettings
from pysim.identify.greybox.workers import Job, Result, Threads, Workers
from pysim.simulate import Esdirk, Orbit, Orbits, Periodic, Sensitivities
from pysim.types import Experiment, Model, Outcome

Array = NDArray[np.float64]

_NONE = np.zeros(0, dtype=np.intp)


@dataclass(frozen=True)
class Simulation:
    """Settings of the runs.

    Args:
        solver: of pysim.simulate, for runs over time and periodic ones.
        workers: where the runs are simulated; on all cores of this machine by default.
        mismatch: largest last correction of an orbit, as a share of its amplitude, that is made to first order only.
            It is the relative error of the derivatives, and has to be small to detect undetermined directions.
    """

    solver: Esdirk = field(default_factory=lambda: Esdirk(rtol=1e-5, atol=1e-5))
    workers: Workers = field(default_factory=Threads)
    mismatch: float = 1e-5

    def rough(self, tolerance: float = FitSettings().rough) -> Simulation:
        """Settings with larger tolerances for the way to the optimum."""
        solver = replace(self.solver, rtol=max(self.solver.rtol, tolerance), atol=max(self.solver.atol, tolerance))
        return replace(self, solver=solver).searching()

    def finer(self, factor: float = 0.1) -> Simulation:
        """Settings with smaller tolerances, for comparisons that integration errors must not decide."""
        solver = replace(self.solver, rtol=factor * self.solver.rtol, atol=factor * self.solver.atol)
        return replace(self, solver=solver, mismatch=factor * self.mismatch)

    def as_fine_as(self, tolerance: float) -> Simulation:
        """Settings with at most this relative tolerance."""
        return self.finer(min(tolerance / self.solver.rtol, 1.0))

    def searching(self) -> Simulation:
        """Settings for points on the way to the optimum, with less accurate orbits.

        The error of an orbit is the square of `mismatch`, which may be as large as the solver's tolerance. Only
        intervals need more accurate derivatives.
        """
        return replace(self, mismatch=max(self.mismatch, math.sqrt(self.solver.rtol)))


@dataclass(frozen=True)
class Failure:
    """Why a run failed.

    Args:
        record: record of the run.
        outcome: how the run ended; DONE if a value was not finite.
        message: message of the run.
    """

    record: str
    outcome: Outcome
    message: str

    def __str__(self) -> str:
        return f"{self.record}: {self.outcome.value}. {self.message}".strip()


@dataclass(frozen=True)
class Answer:
    """Results of all runs at one point.

    Args:
        simulated: one per run, in the order of the runs; empty if one failed.
        orbits: per run, the orbit's state (n_states,) and its derivatives by x (n_states, n), or None.
        failure: the run that failed; None if all succeeded.
    """

    simulated: tuple[Simulated, ...]
    orbits: tuple[tuple[Array, Array] | None, ...] = ()
    failure: Failure | None = None


def simulate_runs(
    model: Model,
    space: ParameterSpace,
    runs: Sequence[Run],
    x: Array,
    guesses: Sequence[Array | None],
    simulation: Simulation,
    *,
    slopes: bool = True,
    initial: bool = True,
    reductions: Sequence[Reduction | None] = (),
) -> Answer:
    """Simulate every run at x (n,).

    A stepped sine is simulated as a periodic orbit; if no orbit is found, over time as a transient. If any run over
    time fails, the answer is that failure alone.

    Args:
        guesses: per run, a first guess of an orbit's state, the offset of a log's free initial states from rest, or
            None.
        slopes: whether to compute derivatives by x.
        initial: whether to compute derivatives by the free initial states.
        reductions: per run, what reduces its rows during the run, or None; empty if none does.
    """
    settings = _Settings(space, x, slopes, initial, simulation.mismatch)
    jobs = [settings.job(run, place, guess) for place, (run, guess) in enumerate(zip(runs, guesses, strict=True))]
    orbits: list[tuple[Array, Array] | None] = [None] * len(runs)
    answers: dict[int, Simulated] = {}
    missing: list[int] = []
    unsure = set(range(len(runs)))  # whether every number is finite
    for own, results in _results(model, [job for job in jobs if isinstance(job.run, Periodic)], simulation):
        missing += _take_orbits(own, results, answers, orbits, unsure)
    over_time = [_reduced(job, runs, reductions) for job in jobs if isinstance(job.run, Experiment)]
    over_time += [settings.job(replace(runs[place], orbit=None), place, None) for place in sorted(missing)]
    for own, results in _results(model, over_time, simulation):
        for job, run in zip(own, results, strict=True):
            if not isinstance(run, Sensitivities) or run.record.outcome is not Outcome.DONE:
                return Answer((), failure=Failure(runs[job.place].record, run.record.outcome, run.record.message))
            reduction = reductions[job.place] if reductions else None
            answers[job.place] = _simulated(run, job, runs[job.place].free, reduction)
    for place in sorted(unsure):
        answer = answers[place]
        arrays = answer.reduction.arrays if answer.reduction else (answer.values, answer.slopes, answer.by_initial)
        if not all(math.isfinite(a.sum()) for a in arrays):
            return Answer((), failure=Failure(runs[place].record, Outcome.DONE, "a value or a slope is not finite"))
    return Answer(tuple(answers[i] for i in range(len(runs))), tuple(orbits))


def _reduced(job: Job, runs: Sequence[Run], reductions: Sequence[Reduction | None]) -> Job:
    """The job, set to pass its rows to the run's reduction, if there is one."""
    reduction = reductions[job.place] if reductions else None
    if reduction is None:
        return job
    reduction.begin(job.slopes, runs[job.place].free if job.offset else _NONE)
    return replace(job, take=reduction.take)


def _simulated(run: Sensitivities, job: Job, free: NDArray[np.intp], reduction: Reduction | None) -> Simulated:
    """A run over time with derivatives by the search coordinates; rows not reduced during the run are reduced now."""
    if reduction is None:
        by_initial = run.by_offset[:, :, free if job.offset else _NONE]
        return Simulated(run.record.values, run.by_parameter @ job.slopes, by_initial)
    if len(run.record.values):
        reduction.take(0, run.record.values, np.concatenate([run.by_offset, run.by_parameter], axis=2))
    return Simulated(np.zeros((0, 0)), np.zeros((0, 0, 0)), reduction=reduction)


def _take_orbits(
    jobs: Sequence[Job],
    results: Sequence[Result],
    answers: dict[int, Simulated],
    orbits: list[tuple[Array, Array] | None],
    unsure: set[int],
) -> list[int]:
    """Fill `answers` and `orbits`, remove finite results from `unsure`, and return the places of orbits not found."""
    left = dict(enumerate(jobs))
    for stack in results.stacks() if isinstance(results, Orbits) else ():
        chains = [jobs[number].slopes for number in stack.numbers]
        slopes, moved = _chained(stack.by_parameter, chains), _chained(stack.state_by_parameter, chains)
        for k, number in enumerate(stack.numbers):
            place = left.pop(number).place
            answers[place] = Simulated(stack.values[k], slopes[k])
            orbits[place] = stack.state[k], moved[k]
        if math.isfinite(stack.values.sum()) and math.isfinite(slopes.sum()):
            unsure.difference_update(jobs[number].place for number in stack.numbers)
    for number, job in list(left.items()):
        orbit = results[number]
        if isinstance(orbit, Orbit) and orbit.outcome is Outcome.DONE:
            answers[job.place] = Simulated(orbit.record.values, orbit.by_parameter @ job.slopes)
            if orbit.state.size:
                orbits[job.place] = orbit.state, orbit.state_by_parameter @ job.slopes
            del left[number]
    return [job.place for job in left.values()]


def _chained(by_variables: Array, chains: Sequence[Array]) -> Array:
    """Derivatives by variables (n, ..., n_v) -> by search coordinates (n, ..., n_x), with chains (n_v, n_x)."""
    if all(chain is chains[0] for chain in chains):
        outer, (n_v, n_x) = by_variables.shape[:-1], chains[0].shape
        return (by_variables.reshape(math.prod(outer), n_v) @ chains[0]).reshape(*outer, n_x)
    return np.array([by @ chain for by, chain in zip(by_variables, chains, strict=True)])


def _results(model: Model, jobs: list[Job], simulation: Simulation) -> Iterator[tuple[Sequence[Job], Sequence[Result]]]:
    """Results of the jobs, which are run in groups with the same variables."""
    groups: dict[tuple[tuple[str, ...], bool], list[Job]] = {}
    for job in jobs:
        groups.setdefault((job.names, job.offset), []).append(job)
    for own in groups.values():
        yield own, simulation.workers.run(model, own, simulation.solver)


@dataclass(frozen=True)
class _Settings:
    """Common input of all runs at one point x (n,), with a cache, as most logs have no parameters of their own."""

    space: ParameterSpace
    x: Array
    slopes: bool
    initial: bool
    mismatch: float
    _known: dict[str | None, tuple[dict[str, float], tuple[str, ...], Array]] = field(default_factory=dict)

    def of(self, record: str) -> tuple[dict[str, float], tuple[str, ...], Array]:
        """Parameters of a log's run; names (n_v) of its free and tied variables; their derivatives by x (n_v, n)."""
        key = record if record in self.space.records else None
        if key not in self._known:
            names, chain = self.space.chain(self.x, record) if self.slopes else ((), np.zeros((0, 0)))
            self._known[key] = self.space.overrides(self.x, record), names, chain
        return self._known[key]

    def job(self, run: Run, place: int, guess: Array | None) -> Job:
        """The job of one run, with the guess of its orbit's state or the offset of its initial states."""
        overrides, names, chain = self.of(run.record)
        if run.orbit is not None:
            return Job(place, run.orbit.override(**overrides), names, chain, guess, self.mismatch)
        by_initial = bool(run.free.size) and self.initial
        guess = np.zeros(run.free.size) if guess is None and by_initial else guess
        experiment = run.over_time(overrides, guess)
        return Job(place, experiment, names, chain, None, self.mismatch, offset=by_initial)
