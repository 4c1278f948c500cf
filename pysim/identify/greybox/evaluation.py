"""The objective at one point, with all that an optimiser wants to know of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.objective import Objective
from pysim.identify.greybox.problem import Problem
from pysim.identify.greybox.simulation import Answer, Simulation, simulate_runs
from pysim.identify.greybox.target import Simulated, Target, stacked

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Evaluation:
    """One point.

    Args:
        x: (n,) in the search's numbers.
        cost: of the objective; infinite where the model could not be simulated.
        residual: (n_r,) what is summed up, its squares or its sizes.
        jacobian: (n_r, n) of the residual by x.
        states: per run, an orbit's state (n_states,), or None.
        state_slopes: per run, that state's by x, (n_states, n), or None.
        trouble: why the point is a bad one; empty where it is not.
    """

    x: Array
    cost: float
    residual: Array
    jacobian: Array
    states: tuple[Array | None, ...] = ()
    state_slopes: tuple[Array | None, ...] = ()
    trouble: str = ""

    def guesses(self, x: Array) -> tuple[Array | None, ...]:
        """Where the orbits at another point x (n,) may be, to first order from here."""
        pairs = zip(self.states, self.state_slopes, strict=True)
        return tuple(None if s is None or by is None else s + by @ (x - self.x) for s, by in pairs)

    @property
    def good(self) -> bool:
        """Whether the model could be simulated."""
        return math.isfinite(self.cost)


# A point and where its orbits may start -> the objective there.
Evaluate = Callable[[Array, tuple[Array | None, ...]], Evaluation]


def evaluator(problem: Problem, objective: Objective, simulation: Simulation) -> Evaluate:
    """The objective as a function; never raises for what a model does at some point.

    Raises:
        BadInput: nothing counts for this objective.
    """
    targets = objective.chosen(problem.targets)
    runs = [run for target in targets for run in target.runs]

    def evaluate(x: Array, states: tuple[Array | None, ...] = ()) -> Evaluation:
        answer = simulate_runs(problem.model, problem.space, runs, x, states or (None,) * len(runs), simulation)
        return _summed(x, answer, targets, objective)

    return evaluate


@dataclass(frozen=True)
class LastLook:
    """A point simulated once more, as finely as intervals need it.

    Args:
        point: residuals and slopes there.
        simulated: id of a run -> its answer; empty where the model could not be simulated.
    """

    point: Evaluation
    simulated: Mapping[int, Simulated]


def last_look(problem: Problem, objective: Objective, simulation: Simulation, best: Evaluation) -> LastLook:
    """Simulate everything that counts for an objective at the end of a search.

    Args:
        best: the end, of an objective over the same domains: its orbits are where these are sought.
    """
    targets = objective.chosen(problem.targets)
    runs = [run for target in targets for run in target.runs]
    answer = simulate_runs(problem.model, problem.space, runs, best.x, best.guesses(best.x), simulation)
    simulated = {} if answer.trouble else dict(zip(map(id, runs), answer.simulated, strict=True))
    return LastLook(_summed(best.x, answer, targets, objective), simulated)


def _summed(x: Array, answer: Answer, targets: tuple[Target, ...], objective: Objective) -> Evaluation:
    if answer.trouble:
        return bad_point(x, answer.trouble)
    rest, parts = list(answer.simulated), []
    for target in targets:
        own, rest = rest[: len(target.runs)], rest[len(target.runs) :]
        parts.append(objective.residual(target, own))
    residual = stacked(parts, x.size)
    if not (np.isfinite(residual.values).all() and np.isfinite(residual.slopes).all()):
        return bad_point(x, "a residual is not finite; an output may not move at all")
    return Evaluation(
        x, objective.cost(residual.values), residual.values, residual.slopes, answer.states, answer.state_slopes
    )


def bad_point(x: Array, trouble: str) -> Evaluation:
    """A point where the model could not be simulated."""
    return Evaluation(x, math.inf, np.zeros(0), np.zeros((0, x.size)), trouble=trouble)
