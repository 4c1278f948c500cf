"""Fit the parameters of a model to measurements (thesis Section 2.6)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.beginning import first_point, settled_initial_states
from pysim.identify.greybox.checkpoint import Checkpoint, digest
from pysim.identify.greybox.comparison import compared
from pysim.identify.greybox.initial_states import initial_states
from pysim.identify.greybox.interior_point import InteriorPoint
from pysim.identify.greybox.least_squares import GaussNewton, blur_of
from pysim.identify.greybox.objective import NOISE, Objective
from pysim.identify.greybox.observation import Measure, Simulated
from pysim.identify.greybox.optimiser import Bounds, Optimiser, State
from pysim.identify.greybox.problem import Problem
from pysim.identify.greybox.residuals import Carried, Point, WeightedResiduals
from pysim.identify.greybox.runs import Simulation
from pysim.identify.greybox.search import Progress, search
from pysim.identify.greybox.settings import FitSettings
from pysim.identify.greybox.starts import starts
from pysim.identify.greybox.trust import not_at_rest
from pysim.identify.greybox.uncertainty import Uncertainty, uncertainty
from pysim.simulate import one_blas_thread
from pysim.types import BadInput, Estimate, Fit, FitOutcome, Note, NoteCode, Start

Array = NDArray[np.float64]

# Standard deviation of the median of normal errors over that of their mean: what a sum of absolute values loses.
_SIZES = math.sqrt(math.pi / 2)


@dataclass(frozen=True)
class Effort:
    """Number and kind of the searches of a fit, and their checkpoints.

    Args:
        starts: number of searches from random starts, besides the given and the nominal one.
        seed: seed of the random starts.
        nominal: also search from the nominal values if the given start differs from them. A fit that starts in a
            biased optimum may never leave it, so turn this off only if the start is trusted.
        rough: search with rough simulations first; turn this off if their errors are known to matter.
        log: folder with a checkpoint for each search; None keeps none.
        resume: go on from the checkpoints of a killed fit, which must have had exactly the same input.
    """

    starts: int = 0
    seed: int | None = None
    nominal: bool = True
    rough: bool = True
    log: Path | None = None
    resume: bool = False

    def __post_init__(self) -> None:
        if self.starts < 0:
            raise BadInput(f"fit: starts must not be negative, got {self.starts}")
        if self.resume and self.log is None:
            raise BadInput("fit: nothing to resume without a log; give the folder of the fit that was stopped")


def fit(
    problem: Problem,
    *,
    objective: Objective = NOISE,
    optimiser: Optimiser | None = None,
    simulation: Simulation | None = None,
    effort: Effort | None = None,
    progress: Progress | None = None,
) -> Fit:
    """Estimate the parameters that minimise the objective, and their intervals.

    Args:
        problem: model, measurements, parameters.
        objective: what is minimised.
        optimiser: None takes Gauss-Newton for sums of squares, the interior-point method for sums of absolute values.
        simulation: solver settings, and the workers that simulate.
        effort: number of starts; checkpoints and resume.
        progress: called after every point; an exception in it ends the fit, which can be resumed from its checkpoint.
    Returns:
        the best of all searches. Records with another use than "fit" are compared with the model, but never fitted.
    Raises:
        BadInput: nothing free, nothing to fit for this objective, an optimiser that cannot minimise it, a model that
            could not be simulated at any start, or a checkpoint of another fit to resume.
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
    objective.chosen(problem.observations)  # raises before the checkpoints of an earlier fit are deleted
    _forget_earlier(effort, begun)
    searches = _Searches(problem, objective, optimiser, simulation, effort, progress)
    with one_blas_thread():
        states = searches.rough(begun)
        good = {name: state for name, state in states.items() if state.best.good}
        if not good:
            reasons = "; ".join(f"{name}: {state.message}" for name, state in states.items())
            raise BadInput(f"fit: the model could not be simulated at any start ({reasons}); give other start values")
        best = min(good, key=lambda name: good[name].best.cost)
        polished = [searches.polished(name, good[name]) for name in _worth_polishing(good, best)]
        state = min(polished, key=lambda one: one.best.cost)
        return _result(problem, objective, optimiser, simulation, states, state, begun)


def fit_at(problem: Problem, values: Mapping[str, float], simulation: Simulation | None = None) -> Fit:
    """The fit with given values of the free parameters, without a search; only initial states are estimated.

    Raises:
        BadInput: the model cannot be simulated there.
    """
    simulation = simulation or Simulation()
    x = problem.space.to_search(np.array([values[key] for key in problem.space.keys]))
    with one_blas_thread():
        point = settled_initial_states(problem.residuals(NOISE, simulation), problem.model, problem.space, x)
        if not point.good:
            raise BadInput(f"fit: the model could not be simulated where it ended ({point.failure}); fit it again")
        state = State(point, first_cost=point.cost, memory={"turned": 1.0}, outcome=FitOutcome.CONVERGED)
        return _result(problem, NOISE, GaussNewton(), simulation, {"end": state}, state, {"end": x})


def _forget_earlier(effort: Effort, begun: Mapping[str, Array]) -> None:
    """Delete the states of an earlier fit: resuming this one must not find them in searches it had not reached."""
    if effort.log is None or effort.resume:
        return
    for name in begun:
        for one in (name, _polish_of(name)):
            Checkpoint(effort.log / one, "").forget()


def _polish_of(name: str) -> str:
    """Name of the search with fine simulations that goes on from the end of this one."""
    return f"{name}-polished"


def _worth_polishing(good: Mapping[str, State], best: str) -> list[str]:
    """The best search, and those that ended at other parameters with a cost too close to rank by rough simulations."""
    chosen, alike = [best], FitSettings().alike
    for name, state in good.items():
        here, there = state.best, good[best].best
        near = here.cost - there.cost <= 0.5 * alike * there.square
        ways = [good[key].best.x - here.x for key in chosen]
        if near and all(np.sum((here.jacobian @ way) ** 2) > alike * here.square for way in ways):
            chosen.append(name)
    return chosen


@dataclass(frozen=True)
class _Searches:
    """The common input of all searches of a fit."""

    problem: Problem
    objective: Objective
    optimiser: Optimiser
    simulation: Simulation
    effort: Effort
    progress: Progress | None

    def rough(self, begun: Mapping[str, Array]) -> Mapping[str, State]:
        """A search with rough simulations from every start, one after another, since each search uses all cores."""
        optimiser, simulation = self.optimiser.rough() if self.effort.rough else None, self.simulation.rough()
        if optimiser is None:
            optimiser, simulation = self.optimiser, self.simulation
        return {name: self._search(optimiser, simulation, name, x) for name, x in begun.items()}

    def polished(self, name: str, best: State) -> State:
        """Continue a rough search with fine simulations, from the point that its next step leads to."""
        if self.optimiser.rough() is None or not self.effort.rough:
            return best
        optimiser, simulation, problem = self.optimiser.finer(best), self.simulation.searching(), self.problem
        residuals, bounds = problem.residuals(self.objective, simulation), Bounds(*problem.space.bounds())

        def first() -> Point:
            """The end of that step, or the end of the rough search if its cost is lower."""
            step = optimiser.propose(optimiser.begin(best.best, bounds, self.objective.squares), bounds)
            carried = best.best.carried_to(step.x, step.damping)
            ahead = residuals.evaluate(problem.model, problem.space, step.x, carried)
            if ahead.good and ahead.cost < best.best.cost:
                return ahead
            return residuals.evaluate(problem.model, problem.space, best.best.x, best.best.carried)

        fine = self._search(optimiser, simulation, _polish_of(name), best.best.x, first)
        if not fine.best.good:
            return replace(best, outcome=FitOutcome.STALLED, message=f"the optimum is a rough one: {fine.message}")
        return replace(fine, tried=best.tried + 1 + fine.tried, first_cost=best.first_cost)

    def _search(
        self,
        optimiser: Optimiser,
        simulation: Simulation,
        name: str,
        x: Array,
        first: Callable[[], Point] | None = None,
    ) -> State:
        problem, objective = self.problem, self.objective
        residuals, bounds = problem.residuals(objective, simulation), Bounds(*problem.space.bounds())

        def evaluate(x: Array, carried: Carried) -> Point:
            return residuals.evaluate(problem.model, problem.space, x, carried)

        return search(
            evaluate,
            optimiser,
            problem.space,
            first or (lambda: first_point(residuals, problem.model, problem.space, optimiser.first(x, bounds))),
            squares=objective.squares,
            name=name,
            checkpoint=self._checkpoint(optimiser, simulation, name, x),
            resume=self.effort.resume,
            progress=self.progress,
        )

    def _checkpoint(self, optimiser: Optimiser, simulation: Simulation, name: str, start: Array) -> Checkpoint | None:
        """The checkpoint of this search; its identity holds all input, data included, to the last bit."""
        if self.effort.log is None:
            return None
        problem = self.problem
        contents = digest((problem.space, problem.observations, problem.floors, problem.settings))
        settings = (simulation.solver, simulation.mismatch)
        own = (problem.model.token, contents, self.objective.name, optimiser, settings, start.tolist())
        return Checkpoint(self.effort.log / name, repr(own))


def _result(
    problem: Problem,
    objective: Objective,
    optimiser: Optimiser,
    simulation: Simulation,
    states: Mapping[str, State],
    state: State,
    begun: Mapping[str, Array],
) -> Fit:
    space, best = problem.space, state.best
    residuals = problem.residuals(replace(NOISE, domains=objective.domains), simulation)
    point, simulated = _at_levels(residuals, problem, objective, optimiser, state)
    doubt = uncertainty(space, point)
    if not objective.squares:
        doubt = _of_sizes(doubt)
    carried = dict(zip(map(id, residuals.runs), point.carried.states, strict=True))
    given = dict(zip(map(id, residuals.runs), simulated, strict=False))
    beside = compared(problem, point.x, simulation, carried, given)
    noise = problem.noise
    begun_at: tuple[Estimate, ...] = ()
    if objective.squares:
        slope, levels = space.slope(point.x), dict(zip(residuals.channels, point.levels.tolist(), strict=True))
        spread = np.nan_to_num(doubt.covariance) / np.outer(slope, slope)
        doubts = spread, spread * np.outer(doubt.half, doubt.half)
        begun_at = initial_states(problem, point.x, doubts, {**noise, **levels}, beside.states, simulation)
    return Fit(
        model=problem.model.name,
        objective=objective.words,
        optimiser=optimiser.name,
        estimates=doubt.estimates,
        covariance=doubt.covariance,
        values=space.values(point.x),
        undetermined=doubt.known.directions,
        combinations=doubt.combinations,
        records=beside.records,
        responses=beside.responses,
        cost=point.cost if objective.measure is Measure.SIGNAL else best.cost,
        start_cost=state.first_cost,
        misfit=residuals.misfit(point, noise) if point.good else math.nan,
        outcome=_outcome(state),
        message=state.message,
        iterations=state.tried,
        starts=tuple(
            Start(name, space.values(x), states[name].first_cost, states[name].best.cost, _outcome(states[name]))
            for name, x in begun.items()
        ),
        notes=(
            *problem.notes,
            *_interval_notes(doubt),
            *beside.notes,
            *not_at_rest(residuals, problem.model, space, point),
        ),
        experiments=beside.experiments,
        initial=begun_at,
        tolerance=simulation.solver.rtol,
    )


def _of_sizes(doubt: Uncertainty) -> Uncertainty:
    """Intervals for a least sum of absolute values, which are wider than those of least squares."""
    estimates = []
    for one in doubt.estimates:
        low, high = (one.value + _SIZES * (end - one.value) for end in one.interval)
        interval = (max(low, one.lower), min(high, one.upper))
        estimates.append(replace(one, std=_SIZES * one.std, interval=interval))
    return replace(doubt, estimates=tuple(estimates), covariance=_SIZES**2 * doubt.covariance)


def _interval_notes(doubt: Uncertainty) -> list[Note]:
    """Notes: intervals from blocks and from white noise that differ much, and too few blocks for intervals."""
    settings, notes = FitSettings(), []
    widths = {one.name: ratio for one, ratio in zip(doubt.estimates, doubt.ratio.tolist(), strict=True)}
    apart = {n: r for n, r in widths.items() if math.isfinite(r) and not 1 / settings.apart <= r <= settings.apart}
    if apart:
        notes.append(Note(NoteCode.INTERVAL_WIDTHS, apart))
    if not doubt.blocks:
        notes.append(Note(NoteCode.FEW_BLOCKS, {"fewest": settings.fewest_blocks}))
    return notes


def _outcome(state: State) -> FitOutcome:
    assert state.outcome is not None  # searches end with one
    return state.outcome


def _at_levels(
    residuals: WeightedResiduals, problem: Problem, objective: Objective, optimiser: Optimiser, state: State
) -> tuple[Point, tuple[Simulated, ...]]:
    """The optimum, simulated again as accurately as intervals need it, with its residuals over their levels; and the
    simulated signals, none if the model could not be simulated.

    For a smooth objective the point is where the next step leads, since this costs no further simulation. The end of
    the search is taken if that point is worse, or if steps from the end have failed before; its initial states and
    nuisances take their own step, if that is not worse.
    """
    best, model, space = state.best, problem.model, problem.space
    places = list[tuple[Array, Carried]]()
    if optimiser.smooth_only and objective.measure is Measure.SIGNAL and not state.memory.get("turned"):
        x = optimiser.propose(state, Bounds(*space.bounds())).x
        places.append((x, best.carried_to(x)))
    if best.own_gain() > 0:
        places.append((best.x, best.carried_to(best.x)))
    places.append((best.x, best.carried))
    for x, carried in places:
        answer = residuals.simulate(model, space, x, carried)
        point = residuals.with_priors(residuals.weigh(x, answer, carried, x.size), space)
        if point.good and point.cost < best.cost + blur_of(best):
            return point, answer.simulated
    if point.good:
        return point, answer.simulated
    return (point if objective.measure is not Measure.SIGNAL else best), ()
