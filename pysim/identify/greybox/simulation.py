"""Run the model for every target at one point of the search, with slopes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.target import Run, Simulated
from pysim.identify.greybox.workers import Job, Result, Threads, Workers
from pysim.simulate import Esdirk, Orbit, Periodic, Sensitivities
from pysim.types import Experiment, Model, Outcome

Array = NDArray[np.float64]


# On the way to the optimum: what this leaves open is well below the noise.
_ROUGH = 1e-4


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

    def rough(self) -> Simulation:
        """Settings for the way to the optimum: good enough to come within a fraction of the noise's uncertainty."""
        solver = replace(self.solver, rtol=max(self.solver.rtol, _ROUGH), atol=max(self.solver.atol, _ROUGH))
        return replace(self, solver=solver).searching()

    def searching(self) -> Simulation:
        """Settings for points that are only passed.

        A sample of an orbit is wrong by the square of what is left to first order, which need not be less than the
        error of the integration; only intervals ask for slopes better than that.
        """
        return replace(self, mismatch=max(self.mismatch, math.sqrt(self.solver.rtol)))


@dataclass(frozen=True)
class Answer:
    """All runs at one point.

    Args:
        simulated: per run, in the order asked for; empty where one failed.
        states: per run, the orbit's state (n_states,) to start the next search from, or None.
        state_slopes: per run, that state's by x, (n_states, n), or None.
        trouble: why a run failed; empty where all ran.
    """

    simulated: tuple[Simulated, ...]
    states: tuple[Array | None, ...] = ()
    state_slopes: tuple[Array | None, ...] = ()
    trouble: str = ""


def simulate_runs(
    model: Model,
    space: ParameterSpace,
    runs: Sequence[Run],
    x: Array,
    guesses: Sequence[Array | None],
    simulation: Simulation,
    *,
    slopes: bool = True,
) -> Answer:
    """Simulate every run at x (n,).

    A stepped sine's orbit is sought first; where none is found the transient test takes its place. Any other run that
    fails makes the whole point a bad one.

    Args:
        guesses: per run, a state to start an orbit's search from, or None.
        slopes: whether those by x are wanted; they are zero where not.
    """
    make = partial(_job, _Settings(space, x, slopes), simulation.mismatch)
    jobs = [make(run, place, guess) for place, (run, guess) in enumerate(zip(runs, guesses, strict=True))]
    states: list[Array | None] = [None] * len(runs)
    state_slopes: list[Array | None] = [None] * len(runs)
    answers: dict[int, Simulated] = {}
    again: list[Job] = []
    for job, orbit in _results(model, [job for job in jobs if isinstance(job.run, Periodic)], simulation):
        if isinstance(orbit, Orbit) and orbit.outcome is Outcome.DONE:
            answers[job.place] = Simulated(orbit.record.values, orbit.by_parameter @ job.slopes)
            if orbit.state.size:
                states[job.place], state_slopes[job.place] = orbit.state, orbit.state_by_parameter @ job.slopes
        else:
            again.append(make(replace(runs[job.place], orbit=None), job.place, None))
    for job, run in _results(model, [job for job in jobs if isinstance(job.run, Experiment)] + again, simulation):
        if not isinstance(run, Sensitivities) or run.record.outcome is not Outcome.DONE:
            trouble = f"{runs[job.place].record}: {run.record.outcome.value}. {run.record.message}"
            return Answer((), trouble=trouble.strip())
        answers[job.place] = Simulated(run.record.values, run.by_parameter @ job.slopes)
    for job in jobs:
        answer = answers[job.place]
        if not (np.isfinite(answer.values).all() and np.isfinite(answer.slopes).all()):
            return Answer((), trouble=f"{runs[job.place].record}: a value or a slope is not finite")
    return Answer(tuple(answers[i] for i in range(len(runs))), tuple(states), tuple(state_slopes))


def _results(model: Model, jobs: list[Job], simulation: Simulation) -> Iterator[tuple[Job, Result]]:
    return zip(jobs, simulation.workers.run(model, jobs, simulation.solver), strict=True) if jobs else iter(())


@dataclass(frozen=True)
class _Settings:
    """What all runs at one point x (n,) have in common, worked out once: most logs have no parameters of their own."""

    space: ParameterSpace
    x: Array
    slopes: bool
    _known: dict[str | None, tuple[dict[str, float], tuple[str, ...], Array]] = field(default_factory=dict)

    def of(self, record: str) -> tuple[dict[str, float], tuple[str, ...], Array]:
        """Parameters of the run of a log, and by which variables it is differentiated: names (n_v), slopes (n_v, n)."""
        key = record if record in self.space.records else None
        if key not in self._known:
            names, chain = self.space.chain(self.x, record) if self.slopes else ((), np.zeros((0, self.space.size)))
            self._known[key] = self.space.overrides(self.x, record), names, chain
        return self._known[key]


def _job(settings: _Settings, mismatch: float, run: Run, place: int, guess: Array | None) -> Job:
    overrides, names, chain = settings.of(run.record)
    wanted = run.experiment if run.orbit is None else run.orbit
    return Job(place, wanted.override(**overrides), names, chain, guess, mismatch)
