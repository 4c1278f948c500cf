"""A sum of squares brought down with slopes that each step corrects: one run of the tests a step."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.least_squares import damped_step
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# First radius of a step, in natural logarithms or shares of the scale.
RADIUS = 0.5
# Least damping, as a share of the largest slope: what the data determine less than that stays where it is.
_FLOOR = 1e-5
# And as the reciprocal variance of the numbers that noise of unit size would have to leave for them to be known.
_WEAK = 10.0
# A step may promise less than the best by this share.
_SPARE = 0.03
# Range of damping above its least, and how well it is found, in natural logarithms.
_WIDE, _CLOSE = 40.0, 0.2
# Share that matters of a sum of squares, as far as it is above so many times that of the noise.
_SHARE, _OFF = 0.01, 2.0


@dataclass(frozen=True)
class Bowl:
    """The linearised sum of squares around a point, in n numbers however many residuals there are.

    Args:
        triangle: (n, n) with the same products as the slopes.
        right: (n,) of that system, the step that would end it all solves triangle p = right.
        low, high: (n,) room to the bounds.
        unit: the mean square residual, where that is above one.
    """

    triangle: Array
    right: Array
    low: Array
    high: Array
    unit: float = 1.0

    @classmethod
    def around(cls, point: Point, bounds: Bounds) -> Bowl:
        """From products of the slopes; their roundings stay far below the floor of the damping."""
        values, vectors = np.linalg.eigh(point.jacobian.T @ point.jacobian)
        roots = np.sqrt(np.clip(values, 0.0, None))
        known = roots > 1e-7 * max(float(roots.max(initial=0.0)), np.finfo(float).tiny)
        slope = vectors.T @ (point.jacobian.T @ point.residual)
        right = np.where(known, -slope / np.where(known, roots, 1.0), 0.0)
        low, high = np.minimum(bounds.lower - point.x, 0.0), np.maximum(bounds.upper - point.x, 0.0)
        return cls(np.where(known, roots, 0.0)[:, None] * vectors.T, right, low, high, mean_square(point))

    def step(self, radius: float, *, spare: float = _SPARE) -> Array:
        """A step (n,) no longer than radius within the bounds: the shortest that promises nearly what the best does.

        What is nearly tied costs length, where the straight line fails, and gains next to nothing.

        Args:
            spare: share of the promise that may be missing.
        """
        size = max(float(np.linalg.norm(self.triangle, 2)), np.finfo(float).tiny)
        damping = math.log(max((_FLOOR * size) ** 2, _WEAK * self.unit))
        best = self._damped(math.exp(damping))
        if np.linalg.norm(best) > radius:
            steepest = float(np.linalg.norm(self.triangle.T @ self.right)) / radius
            damping, best = self._bisected(damping, math.log(steepest), lambda p: bool(np.linalg.norm(p) > radius))
        if not spare:
            return best
        enough = (1 - spare) * self.gain(best)
        return self._bisected(damping, damping + _WIDE, lambda p: self.gain(p) >= enough, keep=True)[1]

    def _bisected(
        self, low: float, high: float, more: Callable[[Array], bool], *, keep: bool = False
    ) -> tuple[float, Array]:
        """The damping's logarithm where `more` ends, and its step: on the far side, or with `keep` on the near one."""
        found = low if keep else high
        p = self._damped(math.exp(found))
        while high - low > _CLOSE:
            middle = 0.5 * (low + high)
            tried = self._damped(math.exp(middle))
            on = more(tried)
            low, high = (middle, high) if on else (low, middle)
            if on == keep:
                found, p = middle, tried
        return found, p

    def gain(self, p: Array) -> float:
        """By how much the sum of squares falls over a step p (n,), were it linear."""
        return float(self.right @ self.right - np.sum((self.right - self.triangle @ p) ** 2))

    def _damped(self, damping: float) -> Array:
        room = np.maximum(self.high - self.low, 1e-300)
        return damped_step(self.triangle, self.right, damping, self.low, self.low + room)


def descend(
    at: Callable[[Array], Array | None],
    first: Point,
    bounds: Bounds,
    *,
    steps: int,
    tolerance: float = 0.1,
    radius: float = RADIUS,
) -> Point:
    """Gauss-Newton steps within the bounds and a radius of trust; slopes are corrected by what each step shows.

    Args:
        at: the residuals (n_r,) at a point (n,), None where the model could not be simulated.
        first: a point with slopes, which may be those of a neighbour.
        steps: points to try at most.
        tolerance: ends it once a step promises or gains less, in units of what is worth another look.
        radius: of the first step.
    Returns:
        the best point; its slopes are good enough to step by.
    Source: Broyden 1965, Mathematics of Computation 19:577, applied to the residuals.
    """
    best = first
    for _ in range(steps):
        bowl, small = Bowl.around(best, bounds), tolerance * worth(best)
        p = bowl.step(radius)
        promised = bowl.gain(p)
        if promised < small:
            break
        x = np.clip(best.x + p, bounds.lower, bounds.upper)
        length = float(np.linalg.norm(x - best.x))
        if not length:
            break
        residual = at(x)
        if residual is None:
            radius = 0.25 * length
            continue
        slopes = _corrected(best, x, residual)
        fall = best.cost - float(residual @ residual)
        if fall < 0.25 * promised:
            radius = 0.4 * length
        elif fall > 0.75 * promised and length > 0.8 * radius:
            radius *= 2
        if fall > 0:
            best = Point(x, best.cost - fall, residual, slopes)
        else:
            best = Point(best.x, best.cost, best.residual, slopes)
    return best


def mean_square(point: Point) -> float:
    """Of the residuals, or 1 where it is below."""
    return max(1.0, point.cost / max(point.residual.size, 1))


def worth(point: Point) -> float:
    """The fall of a sum of squares that is worth new slopes: the mean square, and a share of what is beyond the noise.

    A model that leaves many times the noise lacks something, and what its parameters make of the rest to the last digit
    tells nobody anything.
    """
    return mean_square(point) + _SHARE * max(0.0, point.cost - _OFF * point.residual.size)


def _corrected(best: Point, x: Array, residual: Array) -> Array:
    """Slopes (n_r, n) that agree with what the step to x showed and with the former ones across it."""
    step = x - best.x
    length = float(step @ step)
    if not length:
        return best.jacobian
    change = residual - best.residual - best.jacobian @ step
    return np.asarray(best.jacobian + np.outer(change / length, step))
