"""The thesis' interior-point method: a logarithmic barrier at every bound, slack variables for absolute values."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.optimiser import Bounds, Proposal, State
from pysim.identify.greybox.residuals import Point
from pysim.types import BadInput, FitOutcome

Array = NDArray[np.float64]

# Share of the distance between its bounds by which a start is moved inside.
_INSIDE = 1e-3
_NEWTON_STEPS = 60
_NEWTON_END = 1e-10


@dataclass(frozen=True)
class InteriorPoint:
    """Minimises f(x) - mu (sum ln(U - x) + sum ln(x - L)) for decreasing mu, with bounds L and U.

    A sum of absolute values |r_i| is the smallest sum of slacks s_i with -s_i <= r_i <= s_i. Their barrier
    s_i - mu (ln(s_i - r_i) + ln(s_i + r_i)) is minimal at s_i = mu + sqrt(mu^2 + r_i^2). This eliminates the slacks,
    and a smooth problem in the parameters alone remains. Each step minimises the barrier function with linearised
    residuals, which costs no simulation, and is limited by damping.

    Args:
        max_iterations: points to try.
        tolerance: largest relative excess of the cost over the optimum; the duality gap at the end is 2 n_r mu.
        reduction: factor on mu, each time its problem is solved.
    Raises:
        BadInput: a setting out of range.
    Source: thesis Eq. 2.22 and 2.23, in search coordinates. Damping: Nielsen 1999, Damping parameter in Marquardt's
    method, IMM-REP-1999-05.
    """

    max_iterations: int = 200
    tolerance: float = 1e-4
    reduction: float = 0.2
    name: str = "interior-point"
    smooth_only: bool = False

    def __post_init__(self) -> None:
        if self.max_iterations < 1 or not 0 < self.tolerance < 1 or not 0 < self.reduction < 1:
            raise BadInput(
                "interior-point: max_iterations must be positive, tolerance and reduction between 0 and 1, got "
                f"{self.max_iterations}, {self.tolerance} and {self.reduction}"
            )

    def rough(self) -> None:
        """None: a second search would have to start far from the bounds again."""

    def finer(self, end: State) -> InteriorPoint:
        """Never called, since there is no rough search."""
        return self

    def first(self, x: Array, bounds: Bounds) -> Array:
        """The start, moved off the bounds, where the barrier is infinite."""
        width = bounds.upper - bounds.lower
        gap = _INSIDE * np.where(np.isfinite(width), width, 1.0)
        return np.clip(x, bounds.lower + gap, bounds.upper - gap)

    def begin(self, start: Point, bounds: Bounds, squares: bool) -> State:
        """See Optimiser."""
        mean = _measure(start, squares) / start.residual.size
        memory = {"squares": float(squares), "mu": 0.1 * mean, "damping": 0.0, "growth": 2.0}
        return self._examined(State(start, memory=memory), bounds)

    def propose(self, state: State, bounds: Bounds) -> Proposal:
        """See Optimiser."""
        barrier = _Barrier(bounds, state.memory["mu"], state.memory["squares"] > 0)
        p = barrier.step(state.best, state.memory["damping"])
        change = barrier.linear(state.best, p) - barrier.value(state.best)
        return Proposal(state.best.x + p, max(-change, 0.0))

    def tell(self, state: State, proposal: Proposal, trial: Point, bounds: Bounds) -> State:
        """See Optimiser."""
        barrier = _Barrier(bounds, state.memory["mu"], state.memory["squares"] > 0)
        actual = barrier.value(state.best) - barrier.value(trial) if trial.good else -math.inf
        ratio = actual / proposal.predicted if proposal.predicted > 0 else -1.0
        state = replace(state, tried=state.tried + 1)
        if ratio > 1e-4:
            damping = state.memory["damping"] * max(0.1, 1 - (2 * min(ratio, 1.0) - 1) ** 3)
            damping = 0.0 if ratio > 0.9 and damping < 1e-6 * _size(trial) else damping
            state = replace(state, best=trial, memory={**state.memory, "damping": damping, "growth": 2.0})
            return self._examined(state, bounds)
        if trial.good and proposal.predicted < self.tolerance * _measure(state.best, state.memory["squares"] > 0):
            return self._examined(state, bounds, solved=True)
        damping = max(state.memory["damping"] * state.memory["growth"], 1e-3 * _size(state.best))
        growth = min(2 * state.memory["growth"], 1e4)
        if damping > 1e12 * _size(state.best):
            return replace(
                state, outcome=FitOutcome.STALLED, message=str(trial.failure or "no step lowers the barrier")
            )
        return self._counted(replace(state, memory={**state.memory, "damping": damping, "growth": growth}))

    def _examined(self, state: State, bounds: Bounds, *, solved: bool = False) -> State:
        """Reduce mu while its problem is solved accurately enough; converged if the last mu's problem is solved too."""
        squares = state.memory["squares"] > 0
        cost, n = max(_measure(state.best, squares), np.finfo(float).tiny), state.best.residual.size
        last = self.tolerance * cost / (2 * n)
        last = min(last, self.tolerance / n) if squares else last
        for _ in range(200):
            mu = state.memory["mu"]
            barrier = _Barrier(bounds, mu, squares)
            p = barrier.step(state.best, state.memory["damping"])
            gain = barrier.value(state.best) - barrier.linear(state.best, p)
            enough = self.tolerance * cost * (0.1 if mu <= last else 1.0)
            if not solved and gain > max(enough, 0.5 * mu * n):
                return self._counted(state)
            if mu <= last:
                if not solved and gain > enough:
                    return self._counted(state)
                gap = 2 * n * mu / cost
                message = f"the cost is within about {gap:.1g} of its value at the optimum nearby"
                return replace(state, outcome=FitOutcome.CONVERGED, message=message)
            state = replace(state, memory={**state.memory, "mu": max(self.reduction * mu, 0.99 * last)})
            solved = False
        return state

    def _counted(self, state: State) -> State:
        if state.tried < self.max_iterations:
            return state
        return replace(state, outcome=FitOutcome.ITERATION_LIMIT, message=f"{state.tried} points were tried")


def _measure(point: Point, squares: bool) -> float:
    """The sum that is minimised, with constant levels of the residuals."""
    return 0.5 * point.square if squares else point.cost


def _size(point: Point) -> float:
    """Scale of the damping: the largest curvature of the sum of absolute values, to order of magnitude."""
    spread = float(np.mean(np.abs(point.residual))) or 1.0
    return float(np.max(np.sum(point.jacobian**2, axis=0))) / spread


@dataclass(frozen=True)
class _Barrier:
    """The barrier function for one mu, in terms of residuals and search coordinates."""

    bounds: Bounds
    mu: float
    squares: bool

    def value(self, point: Point) -> float:
        """Its value at a simulated point."""
        return (point.cost if self.squares else self._sum(point.residual)) + self._walls(point.x)

    def linear(self, point: Point, p: Array) -> float:
        """Its value after a step p (n,) from the point, with linearised residuals."""
        ahead = self._sum(point.residual + point.jacobian @ p)
        if self.squares:
            ahead += point.cost - self._sum(point.residual)
        return ahead + self._walls(point.x + p)

    def step(self, point: Point, damping: float) -> Array:
        """The step p (n,) that minimises `linear` + damping/2 |p|^2, a convex function, by Newton's method."""
        p = np.zeros(point.x.size)
        value = self.value(point)
        for _ in range(_NEWTON_STEPS):
            gradient, curvature = self._slopes(point, p, damping)
            d = np.asarray(-np.linalg.lstsq(curvature, gradient, rcond=1e-14)[0], dtype=np.float64)
            share, decrease = self._share(point.x + p, d), float(-gradient @ d)
            while share > 1e-10:
                trial = p + share * d
                new = self.linear(point, trial) + 0.5 * damping * float(trial @ trial)
                if new <= value - 1e-4 * share * decrease:
                    break
                share *= 0.5
            else:
                return p
            p, value = trial, new
            if decrease <= _NEWTON_END * abs(value):
                return p
        return p

    def _slopes(self, point: Point, p: Array, damping: float) -> tuple[Array, Array]:
        """Gradient (n,) and Hessian (n, n) of the function that `step` minimises."""
        r, x = point.residual + point.jacobian @ p, point.x + p
        first, second = self._weights(r)
        below, above = x - self.bounds.lower, self.bounds.upper - x
        gradient = point.jacobian.T @ first + damping * p + self.mu * (1 / above - 1 / below)
        walls = self.mu * (1 / above**2 + 1 / below**2) + damping
        return gradient, (point.jacobian.T * second) @ point.jacobian + np.diag(walls)

    def _weights(self, r: Array) -> tuple[Array, Array]:
        """First and second derivative of each residual's term by the residual, (n_r,)."""
        if self.squares:
            return r, np.ones_like(r)
        root = np.sqrt(self.mu**2 + r**2)
        slack = self.mu + root
        return r / slack, self.mu / (slack * root)

    def _sum(self, r: Array) -> float:
        if self.squares:
            return float(0.5 * r @ r)
        slack = self.mu + np.sqrt(self.mu**2 + r**2)
        return float(np.sum(slack - self.mu * np.log(2 * self.mu * slack)))

    def _walls(self, x: Array) -> float:
        below, above = x - self.bounds.lower, self.bounds.upper - x
        if np.any(below <= 0) or np.any(above <= 0):
            return math.inf
        ends = np.concatenate([below[np.isfinite(below)], above[np.isfinite(above)]])
        return float(-self.mu * np.sum(np.log(ends)))

    def _share(self, x: Array, d: Array) -> float:
        """The largest share (at most 1) of a step d (n,) that stays inside the bounds."""
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            room = np.where(d < 0, (self.bounds.lower - x) / d, (self.bounds.upper - x) / d)
        room = room[(d != 0) & np.isfinite(room)]
        return min(1.0, 0.99 * float(np.min(room))) if room.size else 1.0
