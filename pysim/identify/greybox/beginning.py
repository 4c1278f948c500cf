"""Estimation of unknown initial states of logs: on a short first stretch of each log, then on longer and longer ones.

Over a short stretch any model is nearly linear in its initial state. Over a long one an oscillation with a wrong
initial state drifts out of phase, and the cost has local minima. Multiple shooting (Bock 1983) avoids these as well,
with more unknowns. Logs whose initial states are known, or near rest, are not shortened.
"""

from __future__ import annotations

import math
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
    """First point of a search: at x (n,), or where fits of growing stretches of the logs end, if the cost is lower."""
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
    """The point at x (n,) with estimated initial states and fixed parameters, without a Jacobian.

    Initial states of a log depend on that log alone, so each log is treated by itself. If one cannot be simulated, its
    failed point is returned."""
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
    radius = math.inf
    for _ in range(_SETTINGS.rounds):
        damping = best.own_damping(radius)
        if not best.good or best.own_gain(damping) < _SETTINGS.settled:
            break
        trial = residuals.evaluate(model, space, x, best.carried_to(x, damping), jacobian=False)
        if trial.cost < best.cost:
            best, radius = trial, 2 * radius
        else:
            radius = 0.25 * best.own_length(damping)
    return best


def _heads(residuals: WeightedResiduals) -> Iterator[WeightedResiduals]:
    """Residuals of growing first stretches of logs with unknown initial states; none if there is no such log."""
    anywhere = any(run.begins_anywhere for run in residuals.runs)
    if residuals.absolute or residuals.measure is not Measure.SIGNAL or not anywhere:
        return
    for k in range(_SETTINGS.heads, 0, -1):
        yield replace(residuals, observations=tuple(one.head(0.5**k) for one in residuals.observations))
