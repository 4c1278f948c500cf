"""Profile likelihood: the interval of one parameter without linearisation."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtri

from pysim.identify.greybox.least_squares import GaussNewton
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.problem import Problem
from pysim.identify.greybox.residuals import Carried, Point
from pysim.identify.greybox.runs import Simulation
from pysim.identify.greybox.search import Evaluate, search
from pysim.identify.greybox.settings import FitSettings
from pysim.simulate import one_blas_thread
from pysim.types import BadInput, Fit

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Profile:
    """The profile of one parameter.

    Args:
        name: name of the parameter.
        points: (n, 2) its value, increasing, and the minimum of the objective over all other parameters, nats.
        interval: where the profile has risen by half the chi-squared quantile; a bound if the profile never does.
    """

    name: str
    points: Array
    interval: tuple[float, float]


def profile(
    problem: Problem,
    fit: Fit,
    name: str,
    *,
    simulation: Simulation | None = None,
    level: float = FitSettings().level,
    steps: int = 12,
) -> Profile:
    """Step away from the optimum on both sides, and refit all other parameters at every step.

    Args:
        problem: the problem that was fitted by least squares.
        fit: its optimum.
        name: a free parameter; one of a single log, "x@log.txt", is held in that log only.
        level: confidence level of the interval.
        steps: largest number of outward steps on either side.
    Raises:
        BadInput: not a free parameter, or the only one.
    """
    place = _place(problem.space, name)
    limit = 0.5 * float(chdtri(1, 1 - level))
    walker = _Walker(problem, fit, place, (simulation or Simulation()).as_fine_as(fit.tolerance))
    rows = {fit[name].value: walker.best}
    with one_blas_thread():
        ends = tuple(_end(walker, fit, name, side, limit, steps, rows) for side in (-1, 1))
    return Profile(name, np.array(sorted(rows.items())), (ends[0], ends[1]))


def _place(space: ParameterSpace, name: str) -> int:
    if name not in space.keys:
        raise BadInput(f"profile: {name} is not free; free are {', '.join(space.keys)}")
    if space.size < 2:
        raise BadInput(f"profile: {name} is the only free parameter; its interval needs no profile")
    return space.keys.index(name)


_REFINEMENTS = 8
_NAMES = ("keys", "variables", "records", "units")
_ARRAYS = ("lower", "upper", "scale", "log")


@dataclass
class _Walker:
    """Refits all other parameters with one held; each refit starts where the last one ended."""

    problem: Problem
    fit: Fit
    place: int
    simulation: Simulation

    def __post_init__(self) -> None:
        space = self.problem.space
        self.best = self.fit.cost
        self.others = np.array([self.fit.values[key] for i, key in enumerate(space.keys) if i != self.place])

    def cost(self, value: float) -> float:
        """The minimum of the objective with the parameter held at a value, nats."""
        rest = self._rest()
        everywhere = self.problem.space.records[self.place] is None
        evaluate = self._fixed(rest, value) if everywhere else self._held(value)
        state = search(evaluate, GaussNewton(), rest, rest.to_search(self.others), squares=True)
        if state.best.good:
            self.others = rest.to_model(state.best.x)
        known = self.problem.space.priors.get(self.problem.space.keys[self.place]) if everywhere else None
        return state.best.cost + (0.5 * ((value - known[0]) / known[1]) ** 2 if known else 0.0)

    def _rest(self) -> ParameterSpace:
        """The space of all other parameters."""
        space, keep = self.problem.space, [i for i in range(self.problem.space.size) if i != self.place]
        kept: dict[str, Any] = {name: tuple(getattr(space, name)[i] for i in keep) for name in _NAMES}
        kept |= {name: getattr(space, name)[keep] for name in _ARRAYS}
        ties = tuple(tie for tie in space.ties if tie.of != space.keys[self.place])
        return replace(space, **kept, start=self.others, ties=ties)

    def _fixed(self, rest: ParameterSpace, value: float) -> Evaluate:
        """The objective with the parameter, and those tied to it, fixed in all logs."""
        space = self.problem.space
        tied = {tie.name: tie.factor * value for tie in space.ties if tie.of == space.keys[self.place]}
        fixed = {**space.fixed, space.variables[self.place]: value, **tied}
        return self._evaluate(replace(rest, fixed=fixed))

    def _evaluate(self, space: ParameterSpace) -> Evaluate:
        residuals, model = self.problem.residuals(simulation=self.simulation), self.problem.model
        return lambda x, carried: residuals.evaluate(model, space, x, carried)

    def _held(self, value: float) -> Evaluate:
        """The objective with a parameter of a single log held in that log.

        A fixed parameter would be fixed in all logs, so it stays in the space and only its derivatives are left out.
        """
        space, place = self.problem.space, self.place
        whole = self._evaluate(space)
        held = space.to_search(np.insert(self.others, place, value))[place]

        def evaluate(x: Array, carried: Carried) -> Point:
            point = whole(np.insert(x, place, held), carried)
            steps = tuple(s and s._replace(by=np.delete(s.by, place, axis=1)) for s in point.steps)
            return replace(point, x=x, jacobian=np.delete(point.jacobian, place, axis=1), steps=steps)

        return evaluate


def _end(walker: _Walker, fit: Fit, name: str, side: int, limit: float, steps: int, rows: dict[float, float]) -> float:
    """Value where the cost has risen by the limit, or the bound: growing steps outwards, then interpolation."""
    estimate = fit[name]
    bound = estimate.lower if side < 0 else estimate.upper
    start = walker.others.copy()
    reach = estimate.std if math.isfinite(estimate.std) else 0.25 * abs(bound - estimate.value)
    inside, low, end = estimate.value, 0.0, bound
    for _ in range(steps):
        value = inside + side * reach
        value = max(value, bound) if side < 0 else min(value, bound)
        if value == inside:
            break
        rise = walker.cost(value) - fit.cost
        rows[value] = rise + fit.cost
        if rise >= limit:
            end = _refined(walker, (inside, low), (value, rise), limit, rows)
            break
        inside, low, reach = value, max(rise, 0.0), 1.5 * reach
        if value == bound:
            break
    walker.others = start
    return end


def _refined(
    walker: _Walker, inside: tuple[float, float], outside: tuple[float, float], limit: float, rows: dict[float, float]
) -> float:
    """Value where the rise meets the limit, between two pairs (value, rise): interpolation in turn with bisection."""
    cost = walker.fit.cost
    for attempt in range(_REFINEMENTS):
        if abs(outside[1] - limit) < 0.1 * limit:
            break
        value = 0.5 * (inside[0] + outside[0]) if attempt % 2 else _between(inside, outside, limit)
        rise = walker.cost(value) - cost
        rows[value] = rise + cost
        inside, outside = ((value, max(rise, 0.0)), outside) if rise < limit else (inside, (value, rise))
    return _between(inside, outside, limit)


def _between(inside: tuple[float, float], outside: tuple[float, float], limit: float) -> float:
    """Value where a straight line through the square roots of both rises meets the square root of the limit."""
    if not math.isfinite(outside[1]):
        return 0.5 * (inside[0] + outside[0])
    a, b = math.sqrt(inside[1]), math.sqrt(outside[1])
    return inside[0] + (outside[0] - inside[0]) * (math.sqrt(limit) - a) / (b - a)
