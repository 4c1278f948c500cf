"""Refits: few, cheap steps for a candidate on probation, exact ones for those that remain."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.identify.greybox import GaussNewton
from pysim.identify.greybox.evaluation import Evaluation, bad_point
from pysim.identify.greybox.optimiser import Bounds

Array = NDArray[np.float64]


def refit(
    ruler: Ruler, what: Extended, start: Array, *, rounds: int = 4, steps: int = 5, tolerance: float = 0.5
) -> Evaluation:
    """Gauss-Newton within the bounds; slopes by differences once a round, corrected by each step in between.

    Args:
        start: (n,) of the space.
        rounds: how often the slopes may be run again.
        steps: points to try at most in each round.
        tolerance: ends it once a round lowers the sum of squares by less, in units of the mean square.
    Returns:
        the best point, its slopes run at that point; one that is not good where the start could not be simulated.
    """
    best = ruler.evaluation(what, start)
    for _ in range(rounds):
        if not best.good:
            return best
        end = chord_refit(ruler, what, best, steps=steps)
        if best.cost - end.cost <= tolerance * max(1.0, best.cost / best.residual.size):
            return best
        best = ruler.evaluation(what, end.x)
    return best


def chord_refit(ruler: Ruler, what: Extended, first: Evaluation, *, steps: int = 6) -> Evaluation:
    """The same with slopes that are not run again but corrected by what each step shows.

    A step costs one run of the tests instead of one per parameter. The slopes at the end are good enough to step by,
    not to give intervals.

    Args:
        first: a point with slopes, which may be those of a neighbour.
        steps: points to try at most.
    Source: Broyden 1965, Mathematics of Computation 19:577, applied to the residuals.
    """
    bounds, optimiser = Bounds(*what.space.bounds()), GaussNewton(max_iterations=steps, tolerance=0.05)
    state = optimiser.begin(first, bounds, True)
    while state.outcome is None:
        proposal = optimiser.propose(state, bounds)
        trial = _broyden(state.best, proposal.x, ruler.at(what, proposal.x))
        tried = state
        state = optimiser.tell(state, proposal, trial, bounds)
        if state.best is tried.best and trial.good and state.outcome is None:
            state = replace(state, best=_corrected(state.best, trial))
    return state.best


def _broyden(best: Evaluation, x: Array, residual: Array | None) -> Evaluation:
    """A point whose slopes are those of the best one, corrected along the step."""
    if residual is None:
        return bad_point(x, "the model could not be simulated")
    step = x - best.x
    length = float(step @ step)
    change = residual - best.residual - best.jacobian @ step
    slopes = best.jacobian + np.outer(change, step) / length if length else best.jacobian
    return Evaluation(x, float(residual @ residual), residual, slopes)


def _corrected(best: Evaluation, trial: Evaluation) -> Evaluation:
    """The point that was kept, with the slopes the refused one has taught."""
    return replace(best, jacobian=trial.jacobian)
