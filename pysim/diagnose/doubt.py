"""Intervals of a fitted model."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from pysim.diagnose import decide
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.subject import Subject
from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.uncertainty import Uncertainty, uncertainty, untold
from pysim.types import Direction, Estimate


def doubt(subject: Subject, fitted: Fitted) -> Uncertainty:
    """Intervals, widened where more than noise is left."""
    point, size = _short(fitted)
    return uncertainty(fitted.what.space, point, scale=size, told=not untold(subject.notes))


def held_still(subject: Subject, fitted: Fitted) -> tuple[tuple[Estimate, ...], tuple[Direction, ...]]:
    """Estimates with one parameter of each exactly undetermined direction held where it stands, and those directions.

    A direction that scales every force leaves no force an interval of its own, though an effect is there for certain.
    """
    found, (point, scale) = doubt(subject, fitted), _short(fitted)
    space, slopes, held = fitted.what.space, point.jacobian.copy(), []
    for direction in found.known.directions:
        name = next((name for name in subject.free if name in direction.exponents), "")
        if math.isinf(direction.spread) and name:
            slopes[:, space.keys.index(name)] = 0.0
            order = dict(sorted(direction.exponents.items(), key=lambda item: item[0] != name))
            held.append(replace(direction, exponents=order))
    if not held:
        return found.estimates, ()
    again = uncertainty(space, replace(point, jacobian=slopes), scale=scale, told=not untold(subject.notes))
    return again.estimates, tuple(held)


def _short(fitted: Fitted) -> tuple[Evaluation, float]:
    """The point with the same information in n rows, and by what the noise is widened.

    Where the smallest change moves the residuals by a length d, their sum of squares differs by some 2d from point to
    point, and the least of it may lie where the smooth part is higher by as much.
    """
    point = fitted.point
    slopes = np.asarray(np.linalg.qr(point.jacobian, mode="r"))
    return replace(point, jacobian=slopes), math.sqrt(decide.inflation(point) * (1 + 2 * fitted.rough))
