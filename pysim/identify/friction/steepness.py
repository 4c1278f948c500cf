"""Profile-likelihood interval of the steepness r, which is one-sided or open without slow speeds in the data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtri

Array = NDArray[np.float64]
Solution = tuple[Array, float]  # parameters (4,), r first, and their sum of squares

_FACTORS = (1.02, 1.1, 1.3, 1.7)  # factors of the first steps away from the estimate; the last one is repeated
_FAR = 200.0  # rise of the profile at which the walk ends
_CLAIM = float(chdtri(1, 0.001))  # smallest rise at a bound with which r counts as limited on that side
_TWO_ENDS, _ONE_END = float(chdtri(1, 0.05)), float(chdtri(1, 0.10))
_SAME = 0.01  # rise that counts as none


@dataclass(frozen=True)
class Steepness:
    """interval: 95 percent; two-sided, or one-sided if an end is open (0 or infinite); solution: the best fit, or, if
    an end is open, the first one towards it from which on the fit does not change any more."""

    interval: tuple[float, float]
    solution: Solution

    @property
    def is_open(self) -> bool:
        """Whether the data determine one end of the interval at most."""
        return self.interval[0] == 0.0 or bool(np.isinf(self.interval[1]))


def steepness(
    best: Solution, solve: Callable[[Array, float], Solution], limits: tuple[float, float], variance: float
) -> Steepness:
    """Step away from the estimate on both sides, and refit the other parameters at each r.

    Args:
        best: the fit with r free.
        solve: start (4,) and r -> the best fit with that r.
        limits: bounds of r.
        variance: variance of the residuals times their correlation length; the rise of the sum of squares over it is
            taken as chi-squared with one degree of freedom.
    """
    sides = [_walk(best, solve, limit, variance) for limit in limits]
    best = min((solution for side in sides for solution in side), key=lambda solution: solution[1])
    below, above = ([(s[0][0], (s[1] - best[1]) / variance) for s in side] for side in sides)
    open_below, open_above = below[-1][1] < _CLAIM, above[-1][1] < _CLAIM
    limit = _ONE_END if open_below != open_above else _TWO_ENDS
    low = 0.0 if open_below else _crossing(below, limit)
    high = np.inf if open_above else _crossing(above, limit)
    if open_above or open_below:
        best = _nearest_to_the_end(sides[1] if open_above else sides[0], variance)
    return Steepness((low, high), best)


def _walk(best: Solution, solve: Callable[[Array, float], Solution], limit: float, variance: float) -> list[Solution]:
    """Solutions from the estimate towards the limit of r, until they are far worse or the limit is reached."""
    found, step = [best], 0
    while found[-1][0][0] != limit and (found[-1][1] - best[1]) / variance < _FAR:
        factor = _FACTORS[min(step, len(_FACTORS) - 1)]
        r = found[-1][0][0]
        r = max(r / factor, limit) if limit < best[0][0] else min(r * factor, limit)
        found.append(solve(found[-1][0], float(r)))
        step += 1
    return found


def _crossing(side: list[tuple[float, float]], limit: float) -> float:
    """The r from which on the rise exceeds the limit; its square root is interpolated linearly over ln(r)."""
    r, rise = (np.array(column) for column in zip(*side, strict=True))
    k = int(np.flatnonzero(rise <= limit)[-1]) if np.any(rise <= limit) else 0
    a, b = (np.sqrt(max(float(value), 0.0)) for value in rise[k : k + 2])
    share = float(np.clip((np.sqrt(limit) - a) / (b - a), 0.0, 1.0))
    return float(np.exp(np.log(r[k]) + share * (np.log(r[k + 1]) - np.log(r[k]))))


def _nearest_to_the_end(side: list[Solution], variance: float) -> Solution:
    """The first solution towards an open end from which on the sum of squares does not change any more."""
    changes = np.flatnonzero([abs(s[1] - side[-1][1]) / variance >= _SAME for s in side])
    return side[int(changes[-1]) + 1] if changes.size else side[0]
