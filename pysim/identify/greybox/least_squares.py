"""Least squares within bounds, the one loop of this project: Gauss-Newton steps that damping holds in."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.optimiser import Bounds, Proposal, State
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.settings import FitSettings
from pysim.types import BadInput, FitOutcome

Array = NDArray[np.float64]

# Actual over predicted gain below which the radius shrinks, above which it doubles, and below which a step is not
# taken. Source: Nocedal and Wright 2006, Algorithm 4.1. After a step that failed it grows up to the second of these
# times that one's length, forgotten by as much each time: in a curved valley every second step would be too long.
_POOR, _GOOD, _NONE = 0.25, 0.75, 1e-4
_SHORTEST = 1e-9  # radius below which a search has stalled
_BISECTIONS = 20
# Exchanges of all numbers that bounds hold wrongly. If so many in a row leave no fewer of these, one number
# at a time is exchanged. Source: Judice and Pires 1994.
_PATIENCE = 3
_ROUNDING = 1e-12  # of a slope, over the sizes it is made of
_SETTINGS = FitSettings()


@dataclass(frozen=True)
class GaussNewton:
    """Levenberg-Marquardt steps inside a trust radius; bounds are kept exactly, by an active set.

    Each step minimises |r + J p|^2 + damping |p|^2 within the bounds, with the smallest damping that keeps |p| inside
    the radius. A direction the data do not determine has no slope, so the damping keeps the search from drifting along.
    Initial states and nuisances take steps of their own, inside a radius of their own, where these promise more than
    the parameters; else they only follow the parameters. So it is known whose step was too long. The levels of the
    residuals are held within a step and follow between steps.

    Args:
        max_iterations: points to try.
        tolerance: nats; ends the search once a full step would lower the objective by less.
        radius: of the first step, in natural logarithms or shares of the scale.
        share: ends the search too where a full step would lower the sum of squares by less than this share of it.
    Raises:
        BadInput: a setting that is not positive.
    Source: Nocedal and Wright 2006, Numerical Optimization, algorithm 4.1 and Section 10.3.
    """

    max_iterations: int = _SETTINGS.max_iterations
    tolerance: float = _SETTINGS.tolerance
    radius: float = _SETTINGS.first_radius
    share: float = 0.0
    name: str = "gauss-newton"
    smooth_only: bool = True

    def __post_init__(self) -> None:
        for setting in ("max_iterations", "tolerance", "radius"):
            if not getattr(self, setting) > 0:
                raise BadInput(f"gauss-newton: {setting} must be positive, got {getattr(self, setting)}")

    def rough(self) -> GaussNewton:
        """Ends where rough simulations tell no better."""
        return replace(self, share=max(self.share, _SETTINGS.near))

    def finer(self, end: State) -> GaussNewton:
        """Begins with a step that is no longer than those that the end was reached by."""
        return replace(self, radius=min(self.radius, 2 * end.memory.get("length", self.radius)))

    def first(self, x: Array, bounds: Bounds) -> Array:
        """Any point within the bounds will do."""
        return np.clip(x, bounds.lower, bounds.upper)

    def begin(self, start: Point, bounds: Bounds, squares: bool) -> State:
        """See Optimiser."""
        return self._examined(State(start, memory={"radius": self.radius, "turned": 0.0}), bounds)

    def propose(self, state: State, bounds: Bounds) -> Proposal:
        """See Optimiser."""
        step = _Step.at(state.best, bounds)
        p = step.within(state.memory["radius"], _SETTINGS.spare)
        damping, promised = _own_damping(state), step.predicted(p)
        own = state.best.own_gain(damping)
        if promised > own:
            damping, own = math.inf, 0.0
        return Proposal(np.clip(state.best.x + p, bounds.lower, bounds.upper), promised + own, damping)

    def tell(self, state: State, proposal: Proposal, trial: Point, bounds: Bounds) -> State:
        """See Optimiser."""
        radius, blur = state.memory["radius"], blur_of(state.best)
        length = float(np.linalg.norm(proposal.x - state.best.x)) or radius  # 0 where initial states alone move
        actual = state.best.cost - trial.cost if trial.good else -math.inf
        ratio = actual / proposal.predicted if proposal.predicted > 0 else -math.inf
        if proposal.predicted < blur and ratio <= _NONE and actual > -blur:
            memory = {**state.memory, "radius": _POOR * length}
            return self._lost(replace(state, best=trial, tried=state.tried + 1, memory=memory), bounds)
        memory, failed = dict(state.memory), state.memory.get("failed", math.inf)
        own = state.best.own_length(proposal.damping)
        if ratio < _POOR:
            shorter = _best_share(state.best, trial, proposal) if trial.good else _POOR
            memory |= {"own": own * shorter} if own else {"radius": length * shorter, "failed": length}
        elif ratio > _GOOD:
            if length > 0.8 * radius:
                memory |= {"radius": max(radius, min(2 * radius, _GOOD * failed)), "failed": failed / _GOOD}
            if own > 0.8 * memory.get("own", math.inf):
                memory["own"] = 2 * memory["own"]
        radius = memory["radius"]
        state = replace(state, tried=state.tried + 1, memory=memory)
        if ratio > _NONE:
            taken = replace(state, best=trial, memory={**state.memory, "length": length})
            return self._examined(taken, bounds)
        if trial.good and _turned(trial, proposal.x - state.best.x):
            state = replace(state, memory={**state.memory, "turned": 1.0})
        if trial.good and self._bends(state, bounds):
            return self._lost(state, bounds)
        if radius < _SHORTEST and state.best.own_gain(_own_damping(state)) < self.tolerance:
            return _ended(state, FitOutcome.STALLED, str(trial.failure or f"the last step was {length:.1g} long"))
        return self._counted(state)

    def _bends(self, state: State, bounds: Bounds) -> bool:
        """Whether what is promised up to where steps were seen to fail is nothing, or as good as nothing."""
        step, small = _Step.at(state.best, bounds), self._small(state.best)
        promised = step.predicted(step.within(state.memory["radius"])) + state.best.own_gain(_own_damping(state))
        return promised < max(small, min(blur_of(state.best), _SETTINGS.close * small))

    def _lost(self, state: State, bounds: Bounds) -> State:
        """The end where the slope promises something that cannot be seen any more."""
        step = _Step.at(state.best, bounds)
        radius = state.memory["radius"] if state.memory.get("turned") else math.inf
        if step.predicted(step.within(radius)) < _SETTINGS.close * self._small(state.best):
            return _ended(state, FitOutcome.CONVERGED, "to within the rounding of the simulation")
        promised = f"a full step promises {step.full_gain:.3g} nats, and short ones gain nothing"
        return _ended(state, FitOutcome.STALLED, promised)

    def _examined(self, state: State, bounds: Bounds) -> State:
        """Whether a full step from here would still gain something, or one as far as steps were seen to do so."""
        gain = _Step.at(state.best, bounds).full_gain + state.best.own_gain()
        if gain <= self._small(state.best):
            return _ended(state, FitOutcome.CONVERGED, f"a full step would lower the objective by {gain:.2g} nats")
        if state.memory.get("turned") and self._bends(state, bounds):
            return _ended(state, FitOutcome.CONVERGED, "no more is to be gained as far as steps gain what they promise")
        return self._counted(state)

    def _small(self, best: Point) -> float:
        return max(self.tolerance, 0.5 * self.share * best.square)

    def _counted(self, state: State) -> State:
        if state.tried < self.max_iterations:
            return state
        return _ended(state, FitOutcome.ITERATION_LIMIT, f"{state.tried} points were tried")


def _own_damping(state: State) -> float:
    """The least damping with which the own steps of initial states and nuisances stay inside their radius."""
    return state.best.own_damping(state.memory.get("own", math.inf))


def blur_of(point: Point) -> float:
    """nats by which the costs of two points nearby may differ because the integration took other steps."""
    return _SETTINGS.blur * point.square


def _turned(there: Point, way: Array) -> bool:
    """Whether the cost rises at a point that was too far, on along the way (n,) to it: so its least lies before."""
    return float(there.residual @ (there.jacobian @ way)) > 0


def _best_share(here: Point, there: Point, proposal: Proposal) -> float:
    """Where on the way to a point that was too far the cost is least: a cubic through both costs and slopes."""
    way = proposal.x - here.x
    slopes = [float(point.residual @ (point.jacobian @ way)) for point in (here, there)]
    slopes[0] -= 2 * here.own_gain(proposal.damping)
    s = np.linspace(0.0, 1.0, 41)[2:37]
    rise = there.cost - here.cost
    cost = (3 - 2 * s) * s**2 * rise + s * (1 - s) ** 2 * slopes[0] + s**2 * (s - 1) * slopes[1]
    return float(s[np.argmin(cost)])


def _ended(state: State, outcome: FitOutcome, message: str) -> State:
    return replace(state, outcome=outcome, message=message)


@dataclass(frozen=True)
class _Step:
    """The linearised problem at one point: triangle (n, n) and right side (n,) of its QR, and room to both bounds."""

    triangle: Array
    right: Array
    low: Array
    high: Array

    @classmethod
    def at(cls, point: Point, bounds: Bounds) -> _Step:
        n, r = point.x.size, point.triangle
        low, high = np.minimum(bounds.lower - point.x, 0.0), np.maximum(bounds.upper - point.x, 0.0)
        return cls(r[:n, :n], -r[:n, n], low, high)

    @property
    def full_gain(self) -> float:
        """By how many nats the objective falls over the step that nothing but the bounds holds in."""
        return self.predicted(self.within(math.inf))

    def within(self, radius: float, spare: float = 0.0) -> Array:
        """The best step (n,) no longer than radius; with `spare`, the shortest that promises all but that share."""
        damping, p = self._held_in(radius)
        if spare == 0:
            return p
        enough = (1 - spare) * self.predicted(p)
        low, high = math.log(damping), math.log(damping) + 60.0
        for _ in range(_BISECTIONS):  # the promise falls as the damping grows
            middle = 0.5 * (low + high)
            shorter = self._damped(math.exp(middle))
            if self.predicted(shorter) >= enough:
                low, p = middle, shorter
            else:
                high = middle
        return p

    def _held_in(self, radius: float) -> tuple[float, Array]:
        """The least damping with which a step is no longer than radius, and that step."""
        floor = max(float((EXACT * np.linalg.norm(self.triangle, 2)) ** 2), float(np.finfo(float).tiny))
        p = self._damped(floor)
        if np.linalg.norm(p) <= radius:
            return floor, p
        low, high = math.log(floor), math.log(np.linalg.norm(self.triangle.T @ self.right) / radius + floor)
        for _ in range(2 * _BISECTIONS):  # the length falls as the damping grows
            middle = 0.5 * (low + high)
            p = self._damped(math.exp(middle))
            low, high = (middle, high) if np.linalg.norm(p) > radius else (low, middle)
            if 0.9 * radius <= np.linalg.norm(p) <= radius:
                break
        return math.exp(middle), p

    def _damped(self, damping: float) -> Array:
        return damped_step(self.triangle, self.right, damping, self.low, self.high)

    def predicted(self, p: Array) -> float:
        """By how much half the sum of squares falls over a step p (n,) if the model were linear."""
        return float(0.5 * (self.right @ self.right - np.sum((self.right - self.triangle @ p) ** 2)))


def damped_step(triangle: Array, right: Array, damping: float, low: Array, high: Array) -> Array:
    """The p (n,) within low ... high with the least |right - triangle p|^2 + damping |p|^2.

    Args:
        triangle: (n, n); right: (n,).
        low, high: (n,), each low below its high.
    Source: Nocedal and Wright 2006, Numerical Optimization, Section 10.3. Bounds: block pivots, Judice and Pires 1994,
    Computers and Operations Research 21:587. They end, since in the end they follow Murty's rule.
    """
    n = right.size
    matrix = np.vstack([triangle, math.sqrt(damping) * np.eye(n)])
    longer = np.concatenate([right, np.zeros(n)])
    still = _ROUNDING * np.linalg.norm(matrix, axis=0) * np.linalg.norm(longer)
    held, fewest, patience = np.zeros(n), n + 1, _PATIENCE  # held: at which bound, -1 or 1, or 0
    while True:
        p, free = np.choose((held + 1).astype(int), (low, np.zeros(n), high)), held == 0
        p[free] = np.linalg.lstsq(matrix[:, free], longer - matrix @ p, rcond=None)[0]
        pulled = held * ((matrix @ p - longer) @ matrix) <= still  # against its bound
        after = np.where(free, (p > high) * 1.0 - (p < low), held * pulled)
        wrong = np.flatnonzero(after != held)
        if not wrong.size:
            return p
        patience = _PATIENCE if wrong.size < fewest else patience - 1
        fewest = min(fewest, wrong.size)
        exchanged = wrong if patience >= 0 else wrong[-1:]
        held[exchanged] = after[exchanged]
