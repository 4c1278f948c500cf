"""Gauss-Newton within bounds, its steps held in by damping: for sums of squares."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.damped import damped_step
from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.optimiser import Bounds, Proposal, State
from pysim.types import BadInput, FitOutcome

Array = NDArray[np.float64]

# Share of the cost within which two simulated costs cannot be told apart: step control jumps from point to point.
_BLUR = 5e-5
# So many steps are taken inside the blur, where the slope is the better guide, before the search ends.
_BLIND = 3
# A step is as short as it can be while it promises all but this share of what the best one does: what is nearly tied
# costs length and gains next to nothing.
_SPARE = 0.02
# With half the sum of squares so much above its least, in mean squares, the best step is short enough in itself.
_FINAL = 1.0
# Such a share ends a search that only has to come near, where the simulation is rough.
_NEARLY = 4e-3
# It is a good end where a step inside the radius would gain no more than so many times the tolerance: in the blur, and
# where a curved valley turns up.
_NEAR, _LITTLE = 200.0, 10.0
# After a step that could not be simulated, or whose gain could not be seen, the radius is so much of its length.
_SHORTER = 0.25
_BISECTIONS = 20


@dataclass(frozen=True)
class GaussNewton:
    """Levenberg-Marquardt steps inside a trust radius; bounds are kept exactly, by an active set.

    Each step minimises |r + J p|^2 + damping |p|^2 within the bounds, with the smallest damping that keeps |p| inside
    the radius. A direction the data do not determine has no slope, so the damping keeps the search from drifting along.

    Args:
        max_iterations: points to try.
        tolerance: ends the search once a full step would lower half the sum of squares by less than this, times the
            mean square residual where that is above one. With residuals in standard deviations 5e-3 is 0.1 of them,
            for the worst combination of parameters.
        radius: of the first step, in natural logarithms or shares of the scale.
        share: ends the search too where a full step would lower the sum of squares by less than this share of it.
    Raises:
        BadInput: a setting that is not positive.
    Source: Nocedal and Wright 2006, Numerical Optimization, algorithm 4.1 and Section 10.3.
    """

    max_iterations: int = 100
    tolerance: float = 5e-3
    radius: float = 0.5
    share: float = 0.0
    name: str = "gauss-newton"
    smooth_only: bool = True

    def __post_init__(self) -> None:
        for setting in ("max_iterations", "tolerance", "radius"):
            if not getattr(self, setting) > 0:
                raise BadInput(f"gauss-newton: {setting} must be positive, got {getattr(self, setting)}")

    def rough(self) -> GaussNewton:
        """Ends where rough simulations tell no better."""
        return replace(self, share=max(self.share, _NEARLY))

    def first(self, x: Array, bounds: Bounds) -> Array:
        """Any point within the bounds will do."""
        return np.clip(x, bounds.lower, bounds.upper)

    def begin(self, start: Evaluation, bounds: Bounds, squares: bool) -> State:
        """See Optimiser."""
        return self._examined(State(start, memory={"radius": self.radius, "blind": 0.0, "turned": 0.0}), bounds)

    def propose(self, state: State, bounds: Bounds) -> Proposal:
        """See Optimiser."""
        step = _Step.at(state.best, bounds)
        mean_square = max(1.0, state.best.cost / state.best.residual.size)
        p = step.within(state.memory["radius"])
        if step.predicted(p) > _FINAL * mean_square:
            p = step.within(state.memory["radius"], _SPARE)
        return Proposal(np.clip(state.best.x + p, bounds.lower, bounds.upper), step.predicted(p))

    def tell(self, state: State, proposal: Proposal, trial: Evaluation, bounds: Bounds) -> State:
        """See Optimiser."""
        length = float(np.linalg.norm(proposal.x - state.best.x))
        actual = 0.5 * (state.best.cost - trial.cost) if trial.good else -math.inf
        ratio = actual / proposal.predicted
        radius, blur = state.memory["radius"], _BLUR * state.best.cost
        blind = proposal.predicted < blur and ratio <= 1e-4
        if blind and actual > -blur:
            steps = state.memory["blind"] + 1
            memory = {**state.memory, "blind": steps, "radius": _SHORTER * length}
            state = replace(state, best=trial, tried=state.tried + 1, memory=memory)
            return self._examined(state, bounds) if steps < _BLIND else self._lost(state, bounds)
        if ratio < 0.25:
            radius = length * (_best_share(state.best, trial, proposal.x) if trial.good else _SHORTER)
        elif ratio > 0.75 and length > 0.8 * radius:
            radius = 2 * radius
        state = replace(state, tried=state.tried + 1, memory={**state.memory, "radius": radius})
        if ratio > 1e-4:
            return self._examined(replace(state, best=trial), bounds)
        turned = trial.good and _turned(trial, proposal.x - state.best.x)
        if turned:
            state = replace(state, memory={**state.memory, "turned": 1.0})
        if turned and self._bends(state, bounds):
            bent = "the sum of squares rises again beyond the last step, and within it no more is to be gained"
            return _ended(state, FitOutcome.CONVERGED, bent)
        if radius < 1e-9:
            return _ended(state, FitOutcome.STALLED, trial.trouble or f"the last step was {length:.1g} long")
        return self._counted(state)

    def _bends(self, state: State, bounds: Bounds) -> bool:
        """Whether what is promised up to where steps were seen to fail is next to nothing."""
        step = _Step.at(state.best, bounds)
        return step.predicted(step.within(state.memory["radius"])) < _LITTLE * self._small(state.best)

    def _lost(self, state: State, bounds: Bounds) -> State:
        """The end where the slope promises something that cannot be seen any more."""
        step = _Step.at(state.best, bounds)
        gain = step.full_gain
        radius = state.memory["radius"] if state.memory.get("turned") else math.inf
        if step.predicted(step.within(radius)) < _NEAR * self._small(state.best):
            return _ended(state, FitOutcome.CONVERGED, "to within the rounding of the simulation")
        promised = f"a full step promises {2 * gain:.3g} off the sum of squares, and short ones gain nothing"
        return _ended(state, FitOutcome.STALLED, promised)

    def _examined(self, state: State, bounds: Bounds) -> State:
        """Whether a full step from here would still gain something, or one as far as steps were seen to do so."""
        gain = _Step.at(state.best, bounds).full_gain
        if gain <= self._small(state.best):
            return _ended(state, FitOutcome.CONVERGED, f"a full step would lower the sum of squares by {2 * gain:.2g}")
        turned = state.memory.get("turned") or (state.memory.get("blind") and gain < _NEAR * self._small(state.best))
        if turned and self._bends(state, bounds):
            return _ended(state, FitOutcome.CONVERGED, "no more is to be gained as far as steps gain what they promise")
        return self._counted(state)

    def _small(self, best: Evaluation) -> float:
        return max(self.tolerance * max(1.0, best.cost / best.residual.size), 0.5 * self.share * best.cost)

    def _counted(self, state: State) -> State:
        if state.tried < self.max_iterations:
            return state
        return _ended(state, FitOutcome.ITERATION_LIMIT, f"{state.tried} points were tried")


def _turned(there: Evaluation, way: Array) -> bool:
    """Whether the cost rises at a point that was too far, on along the way (n,) to it: so its least lies before."""
    return float(there.residual @ (there.jacobian @ way)) > 0


def _best_share(here: Evaluation, there: Evaluation, x: Array) -> float:
    """Where on the way to a point that was too far the cost is least: residuals as cubics through values and slopes."""
    s = np.linspace(0.0, 1.0, 41)[2:37, None]
    p = x - here.x
    at = (2 * s**3 - 3 * s**2 + 1) * here.residual + (s**3 - 2 * s**2 + s) * (here.jacobian @ p)
    at += (3 * s**2 - 2 * s**3) * there.residual + (s**3 - s**2) * (there.jacobian @ p)
    return float(s[np.argmin(np.sum(at**2, axis=1)), 0])


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
    def at(cls, point: Evaluation, bounds: Bounds) -> _Step:
        rows = max(point.x.size - point.residual.size, 0)  # fewer residuals than parameters: add empty ones
        q, r = np.linalg.qr(np.vstack([point.jacobian, np.zeros((rows, point.x.size))]))
        residual = np.concatenate([point.residual, np.zeros(rows)])
        low, high = np.minimum(bounds.lower - point.x, 0.0), np.maximum(bounds.upper - point.x, 0.0)
        return cls(r, -q.T @ residual, low, high)

    @property
    def full_gain(self) -> float:
        """By how much half the sum of squares falls over the step that nothing but the bounds holds in."""
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
