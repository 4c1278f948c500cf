"""Fit the parameters of a model to measurements (thesis Section 2.6)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.comparison import compared
from pysim.identify.greybox.evaluation import Evaluation, evaluator
from pysim.identify.greybox.gauss_newton import GaussNewton
from pysim.identify.greybox.interior_point import InteriorPoint
from pysim.identify.greybox.journal import Journal
from pysim.identify.greybox.objective import NOISE, Objective
from pysim.identify.greybox.optimiser import Optimiser, State
from pysim.identify.greybox.problem import Problem
from pysim.identify.greybox.search import Progress, search
from pysim.identify.greybox.simulation import Simulation
from pysim.identify.greybox.starts import starts
from pysim.identify.greybox.uncertainty import misfit, uncertainty, untold
from pysim.types import BadInput, Fit, FitOutcome, Start

Array = NDArray[np.float64]

# Standard deviation of the median of normal errors over that of their mean: what sums of sizes cost.
_SIZES = math.sqrt(math.pi / 2)


@dataclass(frozen=True)
class Effort:
    """How hard a fit tries, and where it writes its log.

    Args:
        starts: searches from starts drawn at random, besides the given and the nominal one.
        seed: of the draw.
        nominal: search from the model's own values too, where the given start is another. A fit that starts from a
            bent optimum may never leave it; leave this out only where the start is trusted.
        log: folder for a log per search; None keeps none.
        resume: go on where the log of a killed fit ends.
    """

    starts: int = 0
    seed: int | None = None
    nominal: bool = True
    log: Path | None = None
    resume: bool = False

    def __post_init__(self) -> None:
        if self.starts < 0:
            raise BadInput(f"fit: starts must not be negative, got {self.starts}")
        if self.resume and self.log is None:
            raise BadInput("fit: there is nothing to resume without a log; name its folder")


def fit(
    problem: Problem,
    *,
    objective: Objective = NOISE,
    optimiser: Optimiser | None = None,
    simulation: Simulation | None = None,
    effort: Effort | None = None,
    progress: Progress | None = None,
) -> Fit:
    """Find the parameters with which the model is nearest to its measurements, and say how well they are known.

    Args:
        problem: model, measurements, parameters.
        objective: what is minimised.
        optimiser: Gauss-Newton for sums of squares, the interior-point method for sums of sizes, where None.
        simulation: solver and where the runs go.
        effort: how many starts; log and resume.
        progress: called after every point; what it raises ends the fit, which can be resumed from its log.
    Returns:
        the best of all searches. Records held out are compared, never fitted.
    Raises:
        BadInput: nothing to fit for this objective, an optimiser that cannot minimise it, or a model that could not
            be simulated at any start.
    """
    simulation, effort = simulation or Simulation(), effort or Effort()
    optimiser = optimiser or (GaussNewton() if objective.squares else InteriorPoint())
    if optimiser.smooth_only and not objective.squares:
        raise BadInput(
            f"fit: {optimiser.name} needs a sum of squares, and the objective {objective.name!r} sums up absolute "
            "values; choose the interior-point optimiser"
        )
    begun = starts(problem.model, problem.space, effort.starts, effort.seed, nominal=effort.nominal)
    states = _searched(problem, objective, optimiser, simulation, effort, begun, progress)
    good = {name: state for name, state in states.items() if state.best.good}
    if not good:
        reasons = "; ".join(f"{name}: {state.message}" for name, state in states.items())
        raise BadInput(f"fit: the model could not be simulated at any start ({reasons}); give other start values")
    name = min(good, key=lambda key: good[key].best.cost)
    return _result(problem, objective, optimiser, simulation, states, name, begun)


def _searched(
    problem: Problem,
    objective: Objective,
    optimiser: Optimiser,
    simulation: Simulation,
    effort: Effort,
    begun: Mapping[str, Array],
    progress: Progress | None,
) -> Mapping[str, State]:
    """A search from every start, one after the other: each uses all cores itself."""
    evaluate = evaluator(problem, objective, simulation)
    states = {}
    for name, x in begun.items():
        identity = repr((problem.model.token, problem.space, objective.name, optimiser, simulation.solver, x.tolist()))
        states[name] = search(
            evaluate,
            optimiser,
            problem.space,
            x,
            squares=objective.squares,
            name=name,
            journal=None if effort.log is None else Journal(effort.log / name, identity),
            resume=effort.resume,
            progress=progress,
        )
    return states


def _result(
    problem: Problem,
    objective: Objective,
    optimiser: Optimiser,
    simulation: Simulation,
    states: Mapping[str, State],
    winner: str,
    begun: Mapping[str, Array],
) -> Fit:
    state, space = states[winner], problem.space
    point = _in_noise(problem, objective, simulation, state.best)
    told = not untold(problem.notes)
    size = misfit(point)
    scale = (max(size, 1.0) if told else size) * (1.0 if objective.squares else _SIZES)
    doubt = uncertainty(space, point, scale=scale, told=told)
    beside = compared(problem, state.best.x, simulation)
    return Fit(
        model=problem.model.name,
        objective=objective.words,
        optimiser=optimiser.name,
        estimates=doubt.estimates,
        covariance=doubt.covariance,
        values=space.values(state.best.x),
        undetermined=doubt.known.directions,
        combinations=doubt.combinations,
        records=beside.records,
        responses=beside.responses,
        cost=state.best.cost,
        start_cost=state.first_cost,
        misfit=size,
        outcome=_outcome(state),
        message=state.message,
        iterations=state.tried,
        starts=tuple(
            Start(name, space.values(x), states[name].first_cost, states[name].best.cost, _outcome(states[name]))
            for name, x in begun.items()
        ),
        notes=(*problem.notes, *beside.notes),
        experiments=beside.experiments,
    )


def _outcome(state: State) -> FitOutcome:
    assert state.outcome is not None  # searches end with one
    return state.outcome


def _in_noise(problem: Problem, objective: Objective, simulation: Simulation, best: Evaluation) -> Evaluation:
    """The optimum's residuals in standard deviations, where the objective counts them in another way."""
    if objective.weighted:
        return best
    weighted = replace(NOISE, domains=objective.domains)
    return evaluator(problem, weighted, simulation)(best.x, best.states)
