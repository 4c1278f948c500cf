"""Run the model for every observation at one point of the search, with slopes."""

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
        workers: where the runs go; all cores of this machine by default.
        mismatch: what of an orbit's correction is left to first order, in amplitudes. It is the relative error of the
            slopes: small enough to see that a direction does nothing at all.
    """

    solver: Esdirk = field(default_factory=lambda: Esdirk(rtol=1e-5, atol=1e-5))
    workers: Workers = field(default_factory=Threads)
    mismatch: float = 1e-5

    def rough(self, tolerance: float = FitSettings().rough) -> Simulation:
        """Settings for the way to the optimum: good enough to come within a fraction of the noise's uncertainty."""
        solver = replace(self.solver, rtol=max(self.solver.rtol, tolerance), atol=max(self.solver.atol, tolerance))
        return replace(self, solver=solver).searching()

    def finer(self, factor: float = 0.1) -> Simulation:
        """Settings for a last look, where what is compared must not be the error of the integration."""
        solver = replace(self.solver, rtol=factor * self.solver.rtol, atol=factor * self.solver.atol)
        return replace(self, solver=solver, mismatch=factor * self.mismatch)

    def as_fine_as(self, tolerance: float) -> Simulation:
        """Settings with this relative tolerance, where theirs is larger."""
        return self.finer(min(tolerance / self.solver.rtol, 1.0))

    def searching(self) -> Simulation:
        """Settings for points that are only passed.

        A sample of an orbit is wrong by the square of what is left to first order, which need not be less than the
        error of the integration; only intervals ask for slopes better than that.
        """
        return replace(self, mismatch=max(self.mismatch, math.sqrt(self.solver.rtol)))


@dataclass(frozen=True)
class Failure:
    """Why there is no answer.

    Args:
        record: whose run failed.
        outcome: how; DONE where a value was not finite.
        message: what the run said.
    """

    record: str
    outcome: Outcome
    message: str

    def __str__(self) -> str:
        return f"{self.record}: {self.outcome.value}. {self.message}".strip()


@dataclass(frozen=True)
class Answer:
    """All runs at one point.

    Args:
        simulated: per run, in the order asked for; empty where one failed.
        orbits: per run, the orbit's state (n_states,) and its slopes by x (n_states, n), or None.
        failure: which run failed; None where all ran.
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

    A stepped sine's orbit is sought first; where none is found the transient test takes its place. Any other run that
    fails makes the whole point a bad one.

    Args:
        guesses: per run, a state to start an orbit's search from, the offset from rest of the free states at a log's
            start, or None.
        slopes: whether those by x are wanted; there are none where not.
        initial: whether those by the free states are wanted.
        reductions: per run what its rows are to become at once, or None; all None where empty.
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
    """The job with its rows handed to their reduction, if there is one."""
    reduction = reductions[job.place] if reductions else None
    if reduction is None:
        return job
    reduction.begin(job.slopes, runs[job.place].free if job.offset else _NONE)
    return replace(job, take=reduction.take)


def _simulated(run: Sensitivities, job: Job, free: NDArray[np.intp], reduction: Reduction | None) -> Simulated:
    """A run over time by the search's numbers; rows that could not be taken while it went on are taken now."""
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
    """Put orbits in their places; the places of those that were not found. Finite ones are no longer unsure."""
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
    """Slopes of orbits (n, ..., n_v) by the search's numbers (n, ..., n_x); most logs share one chain (n_v, n_x)."""
    if all(chain is chains[0] for chain in chains):
        outer, (n_v, n_x) = by_variables.shape[:-1], chains[0].shape
        return (by_variables.reshape(math.prod(outer), n_v) @ chains[0]).reshape(*outer, n_x)
    return np.array([by @ chain for by, chain in zip(by_variables, chains, strict=True)])


def _results(model: Model, jobs: list[Job], simulation: Simulation) -> Iterator[tuple[Sequence[Job], Sequence[Result]]]:
    """Jobs with the same variables go together."""
    groups: dict[tuple[tuple[str, ...], bool], list[Job]] = {}
    for job in jobs:
        groups.setdefault((job.names, job.offset), []).append(job)
    for own in groups.values():
        yield own, simulation.workers.run(model, own, simulation.solver)


@dataclass(frozen=True)
class _Settings:
    """What all runs at one point x (n,) have in common, worked out once: most logs have no parameters of their own."""

    space: ParameterSpace
    x: Array
    slopes: bool
    initial: bool
    mismatch: float
    _known: dict[str | None, tuple[dict[str, float], tuple[str, ...], Array]] = field(default_factory=dict)

    def of(self, record: str) -> tuple[dict[str, float], tuple[str, ...], Array]:
        """Parameters of the run of a log, and by which variables it is differentiated: names (n_v), slopes (n_v, n)."""
        key = record if record in self.space.records else None
        if key not in self._known:
            names, chain = self.space.chain(self.x, record) if self.slopes else ((), np.zeros((0, 0)))
            self._known[key] = self.space.overrides(self.x, record), names, chain
        return self._known[key]

    def job(self, run: Run, place: int, guess: Array | None) -> Job:
        """One run at the point, from the state or with the offset that is guessed."""
        overrides, names, chain = self.of(run.record)
        if run.orbit is not None:
            return Job(place, run.orbit.override(**overrides), names, chain, guess, self.mismatch)
        by_initial = bool(run.free.size) and self.initial
        guess = np.zeros(run.free.size) if guess is None and by_initial else guess
        experiment = run.over_time(overrides, guess)
        return Job(place, experiment, names, chain, None, self.mismatch, offset=by_initial)
