"""Fit the parameters of a model to measurements (thesis Section 2.6)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.comparison import compared
from pysim.identify.greybox.digest import digest
from pysim.identify.greybox.evaluation import Evaluation, LastLook, evaluator, last_look
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

# Share of the cost by which rough searches differ that may end at one optimum.
_ALIKE = 0.02


@dataclass(frozen=True)
class Effort:
    """How hard a fit tries, and where it writes its log.

    Args:
        starts: searches from starts drawn at random, besides the given and the nominal one.
        seed: of the draw.
        nominal: search from the model's own values too, where the given start is another. A fit that starts from a
            bent optimum may never leave it; leave this out only where the start is trusted.
        log: folder for a log per search; None keeps none.
        resume: go on where the log of a killed fit ends; it has to be one of the same problem, to the last bit.
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
            raise BadInput("fit: nothing to resume without a log; give the --output of the fit that was stopped")


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
        BadInput: nothing free, nothing to fit for this objective, an optimiser that cannot minimise it, a model that
            could not be simulated at any start, or the log of another fit to resume.
    """
    if not problem.space.size:
        raise BadInput("fit: name at least one free parameter")
    simulation, effort = simulation or Simulation(), effort or Effort()
    optimiser = optimiser or (GaussNewton() if objective.squares else InteriorPoint())
    if optimiser.smooth_only and not objective.squares:
        raise BadInput(
            f"fit: {optimiser.name} needs a sum of squares, and the objective {objective.name!r} sums up absolute "
            "values; choose the interior-point optimiser"
        )
    begun = starts(problem.model, problem.space, effort.starts, effort.seed, nominal=effort.nominal)
    objective.chosen(problem.targets)  # what it refuses is refused before an earlier log is given up
    _forget_earlier(effort, begun)
    states = _searched(problem, objective, optimiser, simulation, effort, begun, progress)
    good = {name: state for name, state in states.items() if state.best.good}
    if not good:
        reasons = "; ".join(f"{name}: {state.message}" for name, state in states.items())
        raise BadInput(f"fit: the model could not be simulated at any start ({reasons}); give other start values")
    name = min(good, key=lambda key: good[key].best.cost)
    polished = [
        _polished(problem, objective, optimiser, simulation, effort, key, good[key], progress)
        for key in _worth_polishing(good, name)
    ]
    state = min(polished, key=lambda one: one.best.cost)
    return _result(problem, objective, optimiser, simulation, states, state, begun)


def _forget_earlier(effort: Effort, begun: Mapping[str, Array]) -> None:
    """A fit that begins anew and is killed is not to meet, in searches it never came to, what an earlier one left."""
    if effort.log is None or effort.resume:
        return
    for name in begun:
        for one in (name, _polish_of(name)):
            Journal(effort.log / one, "").forget()


def _polish_of(name: str) -> str:
    """What the search is called that goes on from the end of this one."""
    return f"{name}-polished"


def _searched(
    problem: Problem,
    objective: Objective,
    optimiser: Optimiser,
    simulation: Simulation,
    effort: Effort,
    begun: Mapping[str, Array],
    progress: Progress | None,
) -> Mapping[str, State]:
    """A rough search from every start, one after the other: each uses all cores itself."""
    rough = optimiser.rough()
    if rough is not None:
        optimiser, simulation = rough, simulation.rough()
    return {
        name: _one_search(problem, objective, optimiser, simulation, effort, name, x, progress)
        for name, x in begun.items()
    }


def _worth_polishing(good: Mapping[str, State], best: str) -> list[str]:
    """The best search, and those that ended elsewhere at a cost that rough simulations do not tell from its own."""
    chosen = [best]
    for name, state in good.items():
        cost, others = state.best.cost, [good[key].best.residual for key in chosen]
        near = cost <= (1 + _ALIKE) * good[best].best.cost
        if near and all(np.sum((state.best.residual - r) ** 2) > _ALIKE * cost for r in others):
            chosen.append(name)
    return chosen


def _polished(
    problem: Problem,
    objective: Objective,
    optimiser: Optimiser,
    simulation: Simulation,
    effort: Effort,
    name: str,
    best: State,
    progress: Progress | None,
) -> State:
    """The end of a rough search, gone on with by fine simulations."""
    if optimiser.rough() is None:
        return best
    fine = _one_search(
        problem, objective, optimiser, simulation.searching(), effort, _polish_of(name), best.best, progress
    )
    if not fine.best.good:
        return replace(best, outcome=FitOutcome.STALLED, message=f"the optimum is a rough one: {fine.message}")
    return replace(fine, tried=best.tried + 1 + fine.tried, first_cost=best.first_cost)


def _one_search(
    problem: Problem,
    objective: Objective,
    optimiser: Optimiser,
    simulation: Simulation,
    effort: Effort,
    name: str,
    start: Array | Evaluation,
    progress: Progress | None,
) -> State:
    x = start.x if isinstance(start, Evaluation) else start
    folder = None if effort.log is None else effort.log / name
    return search(
        evaluator(problem, objective, simulation),
        optimiser,
        problem.space,
        start,
        squares=objective.squares,
        name=name,
        journal=None if folder is None else _journal(problem, objective, optimiser, simulation, folder, x),
        resume=effort.resume,
        progress=progress,
    )


def _journal(
    problem: Problem, objective: Objective, optimiser: Optimiser, simulation: Simulation, folder: Path, start: Array
) -> Journal:
    """Of this search only: of no other data, however little they differ."""
    contents = digest((problem.space, problem.targets))
    settings = (simulation.solver, simulation.mismatch)
    identity = repr((problem.model.token, contents, objective.name, optimiser, settings, start.tolist()))
    return Journal(folder, identity)


def _result(
    problem: Problem,
    objective: Objective,
    optimiser: Optimiser,
    simulation: Simulation,
    states: Mapping[str, State],
    state: State,
    begun: Mapping[str, Array],
) -> Fit:
    space = problem.space
    look = _in_noise(problem, objective, simulation, state.best)
    point = look.point
    told = not untold(problem.notes)
    size = misfit(point)
    scale = (max(size, 1.0) if told else size) * (1.0 if objective.squares else _SIZES)
    doubt = uncertainty(space, point, scale=scale, told=told)
    beside = compared(problem, state.best.x, simulation, look.simulated)
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
        cost=point.cost if objective.weighted else state.best.cost,
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


def _in_noise(problem: Problem, objective: Objective, simulation: Simulation, best: Evaluation) -> LastLook:
    """The optimum's residuals in standard deviations, which the objective may count in another way."""
    look = last_look(problem, replace(NOISE, domains=objective.domains), simulation, best)
    return look if look.point.good or not objective.weighted else replace(look, point=best)
