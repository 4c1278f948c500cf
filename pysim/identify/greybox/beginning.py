"""Where logs began: their initial states, found on a short stretch first, then on longer and longer ones.

Over a short stretch any model is nearly linear in the state that it begins at. Over a long one a swing that begins
wrong ends up out of step, and a search cannot find its way back. Multiple shooting (Bock 1983) cures the same with more
unknowns.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.least_squares import GaussNewton
from pysim.identify.greybox.observation import Measure
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import Carried, Point, WeightedResiduals
from pysim.identify.greybox.search import search
from pysim.identify.greybox.settings import BeginningSettings
from pysim.types import Model

Array = NDArray[np.float64]

_SETTINGS = BeginningSettings()


def first_point(residuals: WeightedResiduals, model: Model, space: ParameterSpace, x: Array) -> Point:
    """Where a search begins: at x (n,), or where it came on longer and longer stretches of logs that begin anywhere."""
    first = residuals.evaluate(model, space, x)
    carried = Carried()
    for head in _heads(residuals):

        def evaluate(x: Array, carried: Carried, head: WeightedResiduals = head) -> Point:
            return head.evaluate(model, space, x, carried)

        start = partial(evaluate, x, carried)
        end = search(evaluate, GaussNewton(max_iterations=_SETTINGS.points), space, start, squares=True).best
        if end.good:
            x, carried = end.x, replace(end.carried, pieces=())
    if not carried.states:
        return first
    found = residuals.evaluate(model, space, x, carried)
    return found if found.cost < first.cost else first


def settled_initial_states(residuals: WeightedResiduals, model: Model, space: ParameterSpace, x: Array) -> Point:
    """The point at x (n,) with the initial states of its logs estimated, the parameters held.

    Nothing but its own measurements moves the state at which a log begins, so that each log is settled by itself.
    """
    ends = [_settled(replace(residuals, observations=(one,)), model, space, x) for one in residuals.observations]
    if len(ends) == 1 or not all(end.good for end in ends):
        return next((end for end in ends if not end.good), ends[0])
    carried = Carried(tuple(state for end in ends for state in end.carried.states))
    return residuals.evaluate(model, space, x, carried, jacobian=False)


def _settled(residuals: WeightedResiduals, model: Model, space: ParameterSpace, x: Array) -> Point:
    carried = Carried()
    for head in _heads(residuals):
        end = _settle(head, model, space, x, carried)
        carried = replace(end.carried, pieces=()) if end.good else carried
    found = _settle(residuals, model, space, x, carried)
    return found if found.good or not carried.states else _settle(residuals, model, space, x, Carried())


def _settle(residuals: WeightedResiduals, model: Model, space: ParameterSpace, x: Array, carried: Carried) -> Point:
    best = residuals.evaluate(model, space, x, carried, jacobian=False)
    share = 1.0
    for _ in range(_SETTINGS.rounds):
        if not best.good or share * (2 - share) * best.gain < _SETTINGS.settled:
            break
        trial = residuals.evaluate(model, space, x, best.carried_to(x, share), jacobian=False)
        if trial.cost < best.cost:
            best, share = trial, min(1.0, 2 * share)
        else:
            share *= 0.25
    return best


def _heads(residuals: WeightedResiduals) -> Iterator[WeightedResiduals]:
    """The same with logs that begin anywhere cut to longer and longer stretches; none where no log does."""
    anywhere = any(run.begins_anywhere for run in residuals.runs)
    if residuals.absolute or residuals.measure is not Measure.SIGNAL or not anywhere:
        return
    for k in range(_SETTINGS.heads, 0, -1):
        yield replace(residuals, observations=tuple(one.head(0.5**k) for one in residuals.observations))
