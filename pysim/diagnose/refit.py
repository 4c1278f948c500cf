"""Refits of a model with all its free numbers: exact slopes seldom, corrected ones between."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.descent import Bowl, descend, mean_square, worth
from pysim.diagnose.graduated import WIDTHS, graduated, is_far
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# A round that lowers the sum of squares by less, in units of what is worth it, needs no other slopes.
_NEAR = 1.0
# By so much, in the same unit, the error of the integration may raise the sum of squares over a last short step.
_BLUR = 0.5


def refit(ruler: Ruler, what: Extended, first: Point, *, rounds: int = 4, steps: int = 6) -> Point:
    """Gauss-Newton within the bounds; slopes are run once a round and corrected by each step in between.

    Where that ends far from the measurements, what is slow is fitted first; the better end counts.

    Args:
        first: a good point with its slopes.
        rounds: how often the slopes may be run again.
        steps: points to try at most in each round.
    Returns:
        the best point, with slopes that were run there or so near that the sum of squares has not moved since.
    """
    return refit_from(ruler, what, first, rounds=rounds, steps=steps)[0]


def refit_from(
    ruler: Ruler, what: Extended, first: Point, *, rounds: int = 4, steps: int = 6, slow_first: bool = True
) -> tuple[Point, Array]:
    """The same, and where the slopes were run, (n,).

    Args:
        slow_first: whether what is slow is fitted first where the end is far off.
    """
    best, slopes_at = _rounds(ruler, what, first, rounds, steps)
    if not slow_first or not is_far(ruler, best):
        return best, slopes_at
    other = graduated(ruler, what, first)
    if other is None:
        return best, slopes_at
    again, again_at = _rounds(ruler, what, other, rounds, steps)
    return (again, again_at) if again.cost < best.cost else (best, slopes_at)


def _rounds(ruler: Ruler, what: Extended, first: Point, rounds: int, steps: int) -> tuple[Point, Array]:
    best = first
    for _ in range(rounds):
        end = _chord(ruler, what, best, steps)
        if best.cost - end.cost < _NEAR * worth(best):
            return _polished(ruler, what, best, end), best.x
        again = ruler.evaluation(what, end.x)
        if not again.good:
            break
        best = again
    return best, best.x


def chord_refit(ruler: Ruler, what: Extended, first: Point, *, steps: int = 6, slow_first: bool = True) -> Point:
    """The same with slopes that are not run again: a step costs one run of the tests instead of one per parameter.

    Args:
        first: a point with slopes, which may be those of a neighbour.
        steps: points to try at most.
        slow_first: whether what is slow is fitted first where the end is far off.
    Returns:
        the best point; its slopes are good enough to step by, not to give intervals.
    """
    end = _chord(ruler, what, first, steps)
    if not slow_first or not is_far(ruler, end):
        return end
    other = graduated(ruler, what, first, widths=WIDTHS[:1], rounds=2)
    return end if other is None or other.cost > end.cost else other


def _chord(ruler: Ruler, what: Extended, first: Point, steps: int) -> Point:
    return descend(partial(ruler.at, what), first, Bounds(*what.space.bounds()), steps=steps)


def _polished(ruler: Ruler, what: Extended, best: Point, end: Point) -> Point:
    """The point where exact slopes see the least, unless it is seen to be worse; with those slopes.

    So near the end the error of the integration hides what a step gains, and the slopes are the better guide.
    """
    bounds = Bounds(*what.space.bounds())
    p = Bowl.around(best, bounds).step(np.inf, spare=0.0)
    x = np.clip(best.x + p, *bounds)
    residual = ruler.at(what, x)
    if residual is not None and float(residual @ residual) < end.cost + _BLUR * mean_square(best):
        return replace(best, x=x, cost=float(residual @ residual), residual=residual)
    return replace(best, x=end.x, cost=end.cost, residual=end.residual)
