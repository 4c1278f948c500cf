"""Refits of candidates: a few iterations each, then the promising ones to convergence.

A point is one evaluation of the objective by the optimiser. Costs are negative log-likelihoods, in nats.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field, replace
from itertools import compress

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.candidate import Candidate, Key, Values
from pysim.diagnosis.secants import Secants
from pysim.diagnosis.settings import Settings
from pysim.identify.greybox import GaussNewton, Nuisance, Point, Simulation
from pysim.identify.greybox.beginning import first_point
from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.least_squares import damped_step
from pysim.identify.greybox.optimiser import Bounds, State
from pysim.identify.greybox.residuals import Carried
from pysim.identify.greybox.triangle import triangle
from pysim.identify.greybox.uncertainty import at_bounds
from pysim.types import FitOutcome

Array = NDArray[np.float64]

# Pairs of a smaller and a larger model.
Pairs = Sequence[tuple["FinalFit", "FinalFit"]]
# Search variables (n,), initial states and sensor errors -> objective and Jacobian there.
Evaluate = Callable[[Array, Carried], Point]


@dataclass(frozen=True)
class FinalFit:
    """The refit of a candidate, ended or not.

    Args:
        state: of the optimiser: its best point so far, and how the search ended.
        simulation: solver settings of all runs.
        evaluate: computes the objective at another point.
    """

    candidate: Candidate
    state: State = field(repr=False)
    simulation: Simulation = field(repr=False)
    evaluate: Evaluate = field(repr=False)

    @property
    def point(self) -> Point:
        """The best point so far."""
        return self.state.best

    @property
    def good(self) -> bool:
        """Whether the model could be simulated."""
        return self.point.good

    @property
    def ended(self) -> bool:
        """Whether the search has converged; only then the candidate counts as refitted."""
        return self.state.outcome is FitOutcome.CONVERGED

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects and sensor errors that were added to the base model."""
        return self.candidate.names

    @property
    def values(self) -> Values:
        """Key -> value of each free parameter at the best point."""
        return self.candidate.values(self.point.x)

    @property
    def sensor_errors(self) -> tuple[tuple[Nuisance, float], ...]:
        """How large each of the candidate's sensor errors is."""
        return tuple(zip(self.candidate.nuisances, self.point.carried.nuisances.tolist(), strict=True))

    def believable(self, label: str, settings: Settings) -> bool:
        """Whether the fitted size of an effect or sensor error is plausible.
        An effect must not press against its bound, and a sensor error be within `settings.believable` prior sds."""
        own = [(e.name, p) for e in self.candidate.effects if e.name == label for p in e.strengths]
        if any(self._is_beyond((name, p.name), p.off or 0.0, settings.beyond) for name, p in own):
            return False
        labels = self.candidate.labels[len(self.candidate.effects) :]
        sizes = zip(labels, self.sensor_errors, strict=True)
        return all(abs(size) <= settings.believable * error.prior_sd for name, (error, size) in sizes if name == label)

    def _is_beyond(self, key: Key, off: float, share: float) -> bool:
        """Whether a strength presses against its bound on the side away from off.
        That is: without the bound, a Gauss-Newton step would increase it by more than `share` of itself."""
        x, own = self.point.x, self.candidate.keys.index(key)
        size = float(x[own] - self.candidate.at({**self.values, key: off})[own])
        lower, upper = self.candidate.space.bounds()
        left = float((upper if size > 0 else lower)[own] - x[own])
        if abs(left) > share * abs(size):
            return False
        ends = at_bounds(self.candidate.space, self.point)
        free = [k for k, end in enumerate(ends) if k == own or not end]
        step = np.linalg.lstsq(self.point.jacobian[:, free], -self.point.residual, rcond=None)[0]
        return (float(step[free.index(own)]) - left) * math.copysign(1.0, size) > share * abs(size)

    @property
    def expected(self) -> float:
        """Cost that a full Gauss-Newton step from here promises, nats; the cost itself once converged."""
        return self.point.cost - (self.state.memory.get("expected", 0.0) if not self.ended else 0.0)


def begin(candidate: Candidate, values: Values, simulation: Simulation, present: FinalFit | None = None) -> FinalFit:
    """The first state of a refit from given values; not `good` if the candidate cannot be simulated there.

    Args:
        present: the model that the candidate extends. It gives the initial states of the logs, and the first Jacobian
            of a candidate with events.
    """
    x = candidate.at(values)
    carried = Carried() if present is None else candidate.carried(present.candidate, present.point)
    evaluate = exact(candidate, simulation)
    if candidate.has_events:
        known = None if present is None else present.candidate.slopes(present.simulation, present.point)
        evaluate = Secants(candidate, simulation, known).evaluate
    return begun(candidate, evaluate(x, carried), simulation, evaluate)


def begin_anywhere(candidate: Candidate, values: Values, simulation: Simulation) -> FinalFit:
    """Begin at values, else at the candidate's own; or where a search on longer and longer stretches of logs ended."""
    residuals = candidate.residuals(simulation)
    point = first_point(residuals, candidate.model, candidate.space, candidate.at(values))
    return begun(candidate, point, simulation, exact(candidate, simulation))


def begun(candidate: Candidate, point: Point, simulation: Simulation, evaluate: Evaluate) -> FinalFit:
    """The first state of a search at a point that was evaluated already; not `good` if that failed."""
    if not point.good:
        return FinalFit(candidate, State(point, outcome=FitOutcome.NO_START), simulation, evaluate)
    bounds = _bounds(candidate)
    state = replace(_optimiser().begin(point, bounds, squares=True), first_cost=point.cost)
    return _watched(FinalFit(candidate, _expecting(state, bounds), simulation, evaluate))


def left_out(fit: FinalFit, sources: Collection[str]) -> FinalFit:
    """Begin to refit a model, from its best point, without the observations of these sources; they may validate it."""
    candidate, known, simulation = fit.candidate, fit.point.carried, fit.simulation
    observations = candidate.residuals(simulation).observations
    kept = [not set(one.sources) <= set(sources) for one in observations for _ in one.runs]
    candidate = replace(candidate, problem=candidate.problem.without(sources), watch=None)
    carried = replace(known, states=tuple(compress(known.states, kept)), pieces=tuple(compress(known.pieces, kept)))
    evaluate = Secants(candidate, simulation, None).evaluate if candidate.has_events else exact(candidate, simulation)
    return begun(candidate, evaluate(fit.point.x, carried), simulation, evaluate)


def cost_at(candidate: Candidate, values: Values, simulation: Simulation, present: FinalFit) -> float:
    """Cost in nats of starting values beside the present model, without a Jacobian; infinite if the run fails."""
    x, carried = candidate.at(values), candidate.carried(present.candidate, present.point)
    residuals = candidate.residuals(simulation)
    return residuals.evaluate(candidate.model, candidate.space, x, carried, jacobian=False, states=False).cost


def again(candidate: Candidate, x: Array, carried: Carried, simulation: Simulation) -> FinalFit:
    """A refit read from a checkpoint, simulated once at its end; how far its search was is for the caller to say."""
    evaluate = Secants(candidate, simulation, None).evaluate if candidate.has_events else exact(candidate, simulation)
    point = evaluate(x, carried)
    return FinalFit(candidate, State(point, first_cost=point.cost), simulation, evaluate)


def exact(candidate: Candidate, simulation: Simulation) -> Evaluate:
    """The objective with its Jacobian from the sensitivities that the runs compute along."""
    residuals = candidate.residuals(simulation)

    def evaluate(x: Array, carried: Carried) -> Point:
        return residuals.evaluate(candidate.model, candidate.space, x, carried)

    return evaluate


def advance(fit: FinalFit, points: int, enough: float = 0.0) -> FinalFit:
    """Continue the refit by at most `points` iterations, until a full step promises less than `enough` nats."""
    candidate, state = fit.candidate, fit.state
    bounds, optimiser = _bounds(candidate), replace(_optimiser(), tolerance=max(enough, _optimiser().tolerance))
    for _ in range(points):
        if state.outcome is None and state.memory.get("expected", math.inf) < enough:
            state = replace(state, outcome=FitOutcome.CONVERGED)
        if state.outcome is not None:
            break
        proposal = optimiser.propose(state, bounds)
        carried = state.best.carried_to(proposal.x, proposal.damping)
        trial = fit.evaluate(proposal.x, carried)
        state = optimiser.tell(state, proposal, trial, bounds)
        _watched(replace(fit, state=state))
    return replace(fit, state=_expecting(state, bounds))


def _watched(fit: FinalFit) -> FinalFit:
    """Call the candidate's `watch` with the refit."""
    if fit.candidate.watch is not None:
        fit.candidate.watch(fit)
    return fit


def _expecting(state: State, bounds: Bounds) -> State:
    """The state with the gain that a full Gauss-Newton step promises, in nats, as `memory["expected"]`."""
    if state.outcome is not None:
        return state
    far = replace(state, memory={**state.memory, "radius": 1e6})
    return replace(state, memory={**state.memory, "expected": _optimiser().propose(far, bounds).predicted})


def converged(fit: FinalFit, simulation: Simulation | None = None, enough: float = 0.0) -> FinalFit:
    """Run the search to its end, with finer simulations from there on if they are given.

    Args:
        enough: nats; the search ends where a full step promises less.
    """
    most = _optimiser().max_iterations
    fit = advance(fit, most, enough)
    if simulation is not None and simulation != fit.simulation and fit.good:
        finer = begin(fit.candidate, fit.values, simulation, fit)
        fit = advance(finer, most, enough) if finer.good else fit
    return fit


def finest(*simulations: Simulation) -> Simulation:
    """The simulation settings with the smallest tolerance."""
    return min(simulations, key=lambda one: one.solver.rtol)


def integrated(fit: FinalFit, refinements: int) -> FinalFit:
    """Continue a refit with ten times finer integration, until that gains less than the search's tolerance.

    Integration errors are small beside the noise, but they are systematic, so that they add up over the samples.
    """
    for _ in range(refinements):
        start = begin(fit.candidate, fit.values, fit.simulation.finer(), fit)
        if not start.good:
            break
        fit = advance(start, _optimiser().max_iterations)
        if start.point.cost - fit.point.cost < _optimiser().tolerance:
            break
    return fit


def brought_near(fit: FinalFit, other: Point) -> Point:
    """A point on other measurements than the fitted ones, with the parameters moved within the fit's uncertainty.

    The move minimises the linearised cost on both; its cost on the fitted logs is added. A learned curve stays as it
    was fitted, since it could bend where the fitted logs have no data. Source: Rasmussen and Williams 2006, Gaussian
    Processes for Machine Learning, Eq. 2.9: the predictive density without its normalisation.
    """
    n, bounds = fit.point.x.size, _bounds(fit.candidate)
    own = np.column_stack([fit.point.triangle[:n, :n], np.zeros(min(n, len(fit.point.triangle)))])
    both = triangle([own, np.column_stack([other.jacobian, other.residual])])
    low, high = np.minimum(bounds.lower - other.x, 0.0), np.maximum(bounds.upper - other.x, 0.0)
    if fit.candidate.precision is not None:
        curve = fit.candidate.precision.any(axis=0)
        low[curve] = high[curve] = 0.0
    p = damped_step(both[:n, :n], -both[:n, n], EXACT, low, high)
    residual = other.residual + other.jacobian @ p
    squares = float(residual @ residual + np.sum((own[:, :n] @ p) ** 2))
    return replace(other, residual=residual, cost=other.cost + 0.5 * (squares - other.square))


@dataclass(frozen=True)
class Runner:
    """A candidate that competes in `race`.

    Args:
        start: returns the first state of its refit.
        before: cost of the present model, simulated in the same way.
        most: largest gain that is possible, nats; infinite if unknown.
        beside: whether its start is evaluated already, and practically the present model (the effect nearly off). The
            Jacobian there predicts its gain, within orders of magnitude.
    """

    start: Callable[[], FinalFit]
    before: float
    most: float = math.inf
    beside: bool = False


def race(
    runners: Sequence[Runner], settings: Settings, finish: Callable[[FinalFit], FinalFit] = converged
) -> list[FinalFit]:
    """Refit rivals in rounds of a few iterations; drop those that promise too little; return the largest gain first.

    A rival that can gain too little compared with the others does not start, or stays where it is. Of several starts of
    one candidate the most promising goes on. The last `settings.finalists` are refitted to the end.

    Args:
        runners: the most promising first.
    """
    running, resting, gained = list[tuple[FinalFit, float]](), list[tuple[FinalFit, float]](), 0.0
    beside = [(runner.start(), runner.before) for runner in runners if runner.beside]
    promised = max([0.0, *(-_promise(one) for one in beside if one[0].good)])
    for runner in runners:
        fit = runner.start() if runner.most >= settings.promising * gained else None
        if fit is None or not fit.good:
            continue
        if runner.beside and -_promise((fit, runner.before)) < settings.small * max(promised, gained):
            resting.append((fit, runner.before))
            continue
        running.append((advance(fit, 1), runner.before))
        gained = max(gained, runner.before - running[-1][0].point.cost)
    points, least = settings.heat - 1, 0.0
    while running:
        running = _best_starts([(advance(fit, points), before) for fit, before in running])
        points = settings.heat
        least = settings.promising * max(0.0, *(-_promise(one) for one in (*running, *resting)))
        going = [one for one in running if one[0].state.outcome is None and -_promise(one) >= least]
        if len(going) <= settings.finalists:
            break
        resting += [one for one in running if not any(one is other for other in going)]
        running = going
    ended: list[tuple[FinalFit, float]] = []
    for k, (fit, before) in enumerate(sorted(_best_starts([*running, *resting]), key=_promise)):
        ends = k < settings.finalists and before - fit.expected >= least
        ended.append((finish(fit) if ends else fit, before))
    return [fit for fit, before in sorted(ended, key=lambda one: one[0].point.cost - one[1])]


def _promise(one: tuple[FinalFit, float]) -> float:
    """Expected final cost of a refit minus the cost of the present model, nats; negative for a gain."""
    return one[0].expected - one[1]


def _best_starts(running: Sequence[tuple[FinalFit, float]]) -> list[tuple[FinalFit, float]]:
    best: dict[tuple[str, ...], tuple[FinalFit, float]] = {}
    for fit, before in running:
        other = best.get(fit.candidate.labels)
        if other is None or fit.expected < other[0].expected:
            best[fit.candidate.labels] = fit, before
    return list(best.values())


def _optimiser() -> GaussNewton:
    return GaussNewton()


def _bounds(candidate: Candidate) -> Bounds:
    return Bounds(*candidate.space.bounds())
